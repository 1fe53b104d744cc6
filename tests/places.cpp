#include "tests/places.hpp"

// The only file of the tests with absolute paths compiled in: the others' objects are the same in
// every checkout, for the compiler's cache.
namespace dipper::test {

std::filesystem::path source() { return DIPPER_SOURCE; }
std::filesystem::path dem_tests() { return source() / "tests" / "dem"; }
std::filesystem::path liggghts() { return LIGGGHTS_BINARY; }
std::filesystem::path dipper_liggghts() { return DIPPER_LIGGGHTS; }
std::filesystem::path bench_cut() { return BENCH_CUT; }

}  // namespace dipper::test
