// Where the tests find the repository, and the programs they start.
#pragma once

#include <filesystem>

namespace dipper::test {

std::filesystem::path source();           ///< the repository
std::filesystem::path dem_tests();        ///< its tests/dem
std::filesystem::path liggghts();         ///< Debian's plain binary
std::filesystem::path dipper_liggghts();  ///< ours
std::filesystem::path bench_cut();

}  // namespace dipper::test
