#include "coupler/case/pile_profile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "common/input_error.hpp"
#include "common/mesh/other_format.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/outline_file.hpp"

namespace dipper::cases {
namespace {

constexpr std::size_t kHead = 4096;  // bytes in which a mesh of another format shows itself

void refuse_other_meshes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const std::string format = mesh::other_format(head);
  for (const char* meshes : {"PLY", "OBJ", "OFF", "VTK", "STEP", "glTF", "DXF", "IGES"})
    if (format == meshes)
      throw InputError({{file, 0, "",
                         fmt::format("begins as {}; an STL file, or a CSV x_m,z_m. dipper survey "
                                     "makes both of a point cloud (PLY, LAS, text)",
                                     format)}});
}

}  // namespace

bool is_replaced_by_profile(const Case& c, const std::string& key) {
  return !c.pile.profile.empty() && std::find(kReplacedByProfile.begin(), kReplacedByProfile.end(),
                                              key) != kReplacedByProfile.end();
}

void read_pile_profile(Case& c, std::vector<Finding>& findings) {
  if (c.pile.profile.empty()) return;
  for (const std::string& key : kReplacedByProfile)
    if (c.origins.count(key) != 0)
      findings.push_back(finding_at(
          c, key,
          fmt::format("pile.profile is given as well and replaces {}; leave out the one or the "
                      "others",
                      fmt::join(kReplacedByProfile, ", "))));
  try {
    if (mesh::is_stl(c.pile.profile)) {
      c.pile.surface = std::make_shared<BenchSurface>(mesh::read_stl(c.pile.profile));
      c.pile.outline_m = c.pile.surface->section(c.pile.width_m / 2, 1);
    } else {
      refuse_other_meshes(c.pile.profile);
      c.pile.outline_m = read_outline(c.pile.profile);
    }
  } catch (const InputError& e) {
    add_file_findings(c, "pile.profile", e, findings);
    return;
  }
  const auto& points = c.pile.outline_m;
  double top = 0;
  for (const auto& p : points) top = std::max(top, p.y());
  if (top <= 0 || points.back().x() <= points.front().x())
    findings.push_back(finding_at(
        c, "pile.profile",
        fmt::format("{}: no rock is under a profile of {:g} m length and {:g} m height; x rises "
                    "from the toe to the rear wall, z is over the ground",
                    c.pile.profile.string(), points.back().x() - points.front().x(), top)));
}

}  // namespace dipper::cases
