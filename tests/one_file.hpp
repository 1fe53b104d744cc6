// The tests of a folder are one program; CTest runs it once for each file.
#pragma once

namespace dipper::test {

/// Starts GoogleTest. `PROGRAM NAME` runs the tests of NAME_test.cpp, `PROGRAM NAME KIND` those of
/// them that are made for the parameter KIND; without a name all are run, or what --gtest_filter
/// says. Exits with status 2 where there is no such test.
void start_tests(int& argc, char** argv);

}  // namespace dipper::test
