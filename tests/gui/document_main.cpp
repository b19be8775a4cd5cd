#include <QCoreApplication>

#include <gtest/gtest.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  // The queue's timer needs an event loop; nothing here needs a display.
  const QCoreApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
