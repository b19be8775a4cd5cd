#include <gtest/gtest.h>

#include "widgets/application.h"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const auto application = pneuma::makeApplication(argc, argv);
  return RUN_ALL_TESTS();
}
