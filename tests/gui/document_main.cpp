#include <QCoreApplication>
#include <clocale>

#include <gtest/gtest.h>

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  // The queue's timer needs an event loop; nothing here needs a display.
  const QCoreApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");  // as the window has it
  return RUN_ALL_TESTS();
}
