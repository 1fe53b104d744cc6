#include "analysis/rock/rock_tags.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/io/line_reader.hpp"
#include "common/numbers.hpp"

namespace dipper::analysis::rock {
namespace {

namespace fs = std::filesystem;

ShapeRadii shares_of_largest(ShapeRadii radii) {
  std::sort(radii.begin(), radii.end(), std::greater<>());
  for (std::size_t k = radii.size(); k-- > 0;) radii[k] /= radii[0];
  return radii;
}

int shape_of(ShapeRadii radii, const std::vector<ShapeRadii>& shapes) {
  radii = shares_of_largest(std::move(radii));
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (shapes[s].size() != radii.size()) continue;
    double apart = 0;
    for (std::size_t k = 0; k < radii.size(); ++k) apart += std::pow(shapes[s][k] - radii[k], 2);
    if (apart >= least) continue;
    least = apart;
    best = static_cast<int>(s) + 1;
  }
  return best;
}

}  // namespace

std::vector<ShapeRadii> read_shapes(const fs::path& deck) {
  std::vector<fs::path> files;
  for (const auto& f : fs::directory_iterator(deck))
    if (f.path().extension() == ".spheres") files.push_back(f.path());
  std::sort(files.begin(), files.end());
  std::vector<ShapeRadii> shapes;
  for (const fs::path& file : files) {
    ShapeRadii radii;
    io::LineReader in(file);
    std::string_view text;
    while (in.next(text)) {
      if (text.empty() || text.front() == '#') continue;
      double radius = 0;
      for (int k = 0; k < 4; ++k)  // x y z radius
        if (!parse_number(io::take_word(text), radius))
          throw io::input_error(file, in.line(), "expected x y z radius");
      if (!(radius > 0)) throw io::input_error(file, in.line(), "a radius must be larger than 0");
      radii.push_back(radius);
    }
    if (!radii.empty()) shapes.push_back(shares_of_largest(std::move(radii)));
  }
  return shapes;
}

std::unordered_map<std::int64_t, RockTag> tag_rocks(const io::DumpFrame& frame,
                                                    const ClumpMasses& clumps,
                                                    const std::vector<ShapeRadii>& shapes,
                                                    const LoadRegions& regions, const Pose& X_WB) {
  std::unordered_map<std::int64_t, RockTag> tags;
  for_each_fragment(frame, clumps, [&](const Fragment& rock) {
    RockTag& tag = tags[rock.key];
    if (rock.density_kg_m3 > 0)
      tag.size_m = std::cbrt(6 / M_PI * rock.mass_kg / rock.density_kg_m3);
    tag.in_dipper = location_of(regions, X_WB, rock.p_W) == Location::dipper;
  });
  if (shapes.empty() || !frame.has("id_multisphere")) return tags;
  std::unordered_map<std::int64_t, ShapeRadii> radii;
  io::DumpReader::read(frame, {"id_multisphere", "radius"}, [&](const io::ParticleChunk& chunk) {
    for (std::size_t i = 0; i < chunk.rows; ++i) {
      const auto clump = static_cast<std::int64_t>(chunk.columns[0][i]);
      if (clump >= 0) radii[clump].push_back(chunk.columns[1][i]);
    }
  });
  for (auto& [clump, r] : radii) tags[rock_key(0, clump)].shape = shape_of(std::move(r), shapes);
  return tags;
}

}  // namespace dipper::analysis::rock
