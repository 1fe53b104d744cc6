// bench-cut PILE.dump OUTLINE.csv|SURFACE.stl: reads the spheres of a pile (id, id_multisphere, x,
// y, z, radius) and prints the LIGGGHTS commands that group the rocks over the outline or surface.
// dem_in/settle.in calls it.
#include <exception>
#include <iostream>

#include "analysis/io/dump_reader.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/deck/bench_cut.hpp"

int main(int argc, char** argv) {
  using namespace dipper;
  if (argc != 3) {
    std::cerr << "usage: bench-cut PILE.dump OUTLINE.csv|SURFACE.stl\n";
    return 2;
  }
  try {
    std::vector<deck::PileSphere> spheres;
    const analysis::io::DumpReader reader({argv[1]});
    analysis::io::DumpReader::read(reader.frames().front(),
                                   {"id", "id_multisphere", "x", "y", "z", "radius"},
                                   [&](const analysis::io::ParticleChunk& chunk) {
                                     const auto& k = chunk.columns;
                                     for (std::size_t i = 0; i < chunk.rows; ++i)
                                       spheres.push_back({static_cast<long>(k[0][i]),
                                                          static_cast<long>(k[1][i]),
                                                          {k[2][i], k[3][i], k[4][i]},
                                                          k[5][i]});
                                   });
    std::function<double(double, double)> height;
    if (mesh::is_stl(argv[2])) {
      height = [surface = cases::BenchSurface(mesh::read_stl(argv[2]))](double x, double y) {
        return surface.height(x, y);
      };
    } else {
      height = [outline = cases::read_outline(argv[2])](double x, double) {
        return cases::outline_height(outline, x);
      };
    }
    std::cout << deck::waste_group(deck::over_surface(spheres, height));
  } catch (const std::exception& e) {
    std::cerr << "bench-cut: " << e.what() << '\n';
    return 2;
  }
}
