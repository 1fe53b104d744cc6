// rock-shape FILE.stl [COARSE MEDIUM FINE]: mass properties of a closed mesh and three sphere fits,
// as YAML. A case uses it as NAME.yaml beside NAME.stl in its shape folder; without it, `dipper
// run` makes it.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>

#include "common/numbers.hpp"
#include "coupler/deck/shape_library.hpp"

int main(int argc, char** argv) {
  if (argc != 2 && argc != 5) {
    std::cerr
        << "usage: rock-shape FILE.stl [COARSE MEDIUM FINE]   (numbers of spheres: 6 12 24)\n";
    return 2;
  }
  try {
    std::vector<dipper::deck::ShapeResolution> resolutions(dipper::deck::kShapeResolutions.begin(),
                                                           dipper::deck::kShapeResolutions.end());
    for (int i = 2; i < argc; ++i) {
      std::int64_t n = 0;
      if (!dipper::parse_number(argv[i], n) || n < 1 || n > 200) {
        std::cerr << "rock-shape: " << argv[i] << ": write a number of spheres, 1 ... 200\n";
        return 2;
      }
      resolutions[static_cast<std::size_t>(i - 2)].spheres = static_cast<int>(n);
    }
    std::cout << dipper::deck::to_yaml(dipper::deck::fit_rock_shape(argv[1], resolutions));
  } catch (const std::exception& e) {
    std::cerr << "rock-shape: " << e.what() << '\n';
    return 2;
  }
}
