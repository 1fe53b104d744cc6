// The readers of dumps against damaged files; meant for the asan preset, by scripts/bench/fuzz:
//   fuzz_dumps INPUTS [SEED]
// Prints the number of files tried, by sample. Exit status 1: one ended otherwise than read or
// refused; it is left beside, and the seed and number that make it are printed.
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "tests/analysis/io/damage.hpp"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  using namespace dipper::analysis::io;
  if (argc < 2) {
    std::cerr << "usage: fuzz_dumps INPUTS [SEED]\n";
    return 2;
  }
  const long inputs = std::atol(argv[1]);
  const unsigned long seed = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1;
  const fs::path folder = fs::temp_directory_path() / ("fuzz_dumps_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::vector<Sample> all = samples(folder);
  std::vector<long> tried(all.size(), 0);
  long rounds = 0, sum = 0;
  while (sum < inputs) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const fs::path room = folder / all[k].name;
      fs::create_directories(room);
      std::mt19937_64 random(seed + 1'000'003UL * static_cast<unsigned long>(rounds) + k);
      for (int i = 0; i < 100; ++i, ++tried[k], ++sum) {
        const std::string wrong = try_damage(all[k], room, random);
        if (wrong.empty()) continue;
        std::cerr << (room / all[k].name).string() << ": " << wrong << " (seed " << seed
                  << ", round " << rounds << ", change " << i << ")\n";
        return 1;
      }
    }
    ++rounds;
  }
  for (std::size_t k = 0; k < all.size(); ++k) std::cout << all[k].name << ": " << tried[k] << '\n';
  std::cout << "all: " << sum << " files, none read wrongly or crashed\n";
  fs::remove_all(folder);
  return 0;
}
