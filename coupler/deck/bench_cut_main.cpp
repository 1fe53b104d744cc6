// bench-cut PILE.dump OUTLINE.csv|SURFACE.stl: reads the spheres of a pile (id, id_multisphere, x,
// y, z, radius) and prints the LIGGGHTS commands that group the rocks over the outline or surface.
// dem_in/settle.in calls it.
#include <exception>
#include <iostream>

#include "analysis/dump_reader.hpp"
#include "coupler/deck/bench_cut.hpp"
#include "coupler/deck/bench_surface.hpp"
#include "coupler/deck/outline_file.hpp"
#include "coupler/mesh/stl.hpp"

int main(int argc, char** argv) {
  using namespace dipper;
  if (argc != 3) {
    std::cerr << "usage: bench-cut PILE.dump OUTLINE.csv|SURFACE.stl\n";
    return 2;
  }
  try {
    std::vector<PileSphere> spheres;
    const DumpReader reader({argv[1]});
    DumpReader::read(reader.frames().front(), {"id", "id_multisphere", "x", "y", "z", "radius"},
                     [&](const ParticleChunk& chunk) {
                       const auto& k = chunk.columns;
                       for (std::size_t i = 0; i < chunk.rows; ++i)
                         spheres.push_back({static_cast<long>(k[0][i]),
                                            static_cast<long>(k[1][i]),
                                            {k[2][i], k[3][i], k[4][i]},
                                            k[5][i]});
                     });
    std::function<double(double, double)> height;
    if (is_stl(argv[2])) {
      height = [surface = BenchSurface(read_stl(argv[2]))](double x, double y) {
        return surface.height(x, y);
      };
    } else {
      height = [outline = read_outline(argv[2])](double x, double) {
        return outline_height(outline, x);
      };
    }
    std::cout << waste_group(over_surface(spheres, height));
  } catch (const std::exception& e) {
    std::cerr << "bench-cut: " << e.what() << '\n';
    return 2;
  }
}
