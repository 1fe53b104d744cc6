// bench-cut: reads the spheres of a pile (id, id_multisphere, x, y, z, radius) and writes the
// LIGGGHTS commands that group the rocks over an outline (CSV) or surface (STL). Either by hand,
//
//   bench-cut PILE.dump OUTLINE.csv|SURFACE.stl      prints the commands
//
// or as dem_in/settle.in calls it, without arguments: $BENCH_FOLDER/bench.dump and $BENCH_OUTLINE
// give $BENCH_FOLDER/waste.in. A deck can run a program only through a shell, which would read a
// path in its command, but not the environment.
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include "analysis/io/dump_reader.hpp"
#include "common/mesh/stl.hpp"
#include "common/text_file.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/deck/bench_cut.hpp"

namespace dipper::deck {
namespace {

std::string commands(const std::filesystem::path& dump, const std::filesystem::path& bench) {
  std::vector<PileSphere> spheres;
  const analysis::io::DumpReader reader({dump});
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
  if (mesh::is_stl(bench)) {
    height = [surface = cases::BenchSurface(mesh::read_stl(bench))](double x, double y) {
      return surface.height(x, y);
    };
  } else {
    height = [outline = cases::read_outline(bench)](double x, double) {
      return cases::outline_height(outline, x);
    };
  }
  return waste_group(over_surface(spheres, height));
}

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) throw std::runtime_error(std::string(name) + " is not set");
  return value;
}

void cut_for_deck() {
  const std::filesystem::path folder = from_environment("BENCH_FOLDER");
  write_text(folder / "waste.in",
             commands(folder / "bench.dump", from_environment("BENCH_OUTLINE")));
}

}  // namespace
}  // namespace dipper::deck

int main(int argc, char** argv) {
  if (argc != 1 && argc != 3) {
    std::cerr << "usage: bench-cut PILE.dump OUTLINE.csv|SURFACE.stl\n";
    return 2;
  }
  try {
    if (argc == 1) {
      dipper::deck::cut_for_deck();
    } else {
      std::cout << dipper::deck::commands(argv[1], argv[2]);
    }
  } catch (const std::exception& e) {
    std::cerr << "bench-cut: " << e.what() << '\n';
    return 2;
  }
}
