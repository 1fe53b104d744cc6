// rock-shape FILE.stl [SPHERES]: mass properties and a sphere fit of a closed mesh, as YAML.
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>

#include "coupler/deck/rock_shape.hpp"
#include "coupler/mesh/stl.hpp"

int main(int argc, char** argv) {
  constexpr int kSpheres = 6;
  if (argc != 2 && argc != 3) {
    std::cerr << "usage: rock-shape FILE.stl [SPHERES]\n";
    return 2;
  }
  try {
    const std::filesystem::path stl = argv[1];
    const int spheres = argc == 3 ? std::atoi(argv[2]) : kSpheres;
    std::cout << dipper::to_yaml(
        dipper::make_rock_shape(stl.stem().string(), dipper::read_stl(stl), spheres));
  } catch (const std::exception& e) {
    std::cerr << "rock-shape: " << e.what() << '\n';
    return 2;
  }
}
