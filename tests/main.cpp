#include <gtest/gtest.h>

#include "tests/one_file.hpp"

int main(int argc, char** argv) {
  dipper::test::start_tests(argc, argv);
  return RUN_ALL_TESTS();
}
