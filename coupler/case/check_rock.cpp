#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "coupler/case/check_parts.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/rock_shape.hpp"
#include "coupler/deck/stable_timestep.hpp"

namespace fs = std::filesystem;

namespace dipper::check {
namespace {

// A shape is a NAME.yaml with its mass properties and spheres.
std::set<std::string> shapes_in(const fs::path& folder) {
  std::set<std::string> names{"sphere"};
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  }
  return names;
}

bool is_mixed(const SizeClass& size) {
  const auto spheres = std::count(size.shapes.begin(), size.shapes.end(), "sphere");
  return spheres > 0 && spheres < static_cast<std::ptrdiff_t>(size.shapes.size());
}

void check_shapes(const Case& c, Findings& findings) {
  if (!fs::is_directory(c.rock.shape_folder)) {
    findings.push_back(
        finding_at(c, "rock.shape_folder", "no such folder: " + c.rock.shape_folder.string()));
    return;
  }
  const std::set<std::string> known = shapes_in(c.rock.shape_folder);
  std::set<std::string> unreadable;
  for (std::size_t i = 0; i < c.rock.classes.size(); ++i) {
    const SizeClass& size = c.rock.classes[i];
    for (std::size_t j = 0; j < size.shapes.size(); ++j) {
      const std::string& shape = size.shapes[j];
      if (shape == "sphere") continue;
      if (!known.count(shape)) {
        findings.push_back(
            finding_at(c, fmt::format("rock.classes.{}.shapes.{}", i, j),
                       fmt::format("no shape '{}'; there are {}", shape, fmt::join(known, ", "))));
        continue;
      }
      const fs::path file = c.rock.shape_folder / (shape + ".yaml");
      try {
        read_rock_shape(file);
      } catch (const std::exception& e) {
        if (!unreadable.insert(shape).second) continue;
        findings.push_back({file, 0, "rock.shape_folder", e.what()});
      }
    }
    if (is_mixed(size)) {
      findings.push_back(finding_at(c, fmt::format("rock.classes.{}.shapes", i),
                                    "mixes spheres and other shapes, whose friction differs; make "
                                    "two classes of it"));
    }
  }
}

}  // namespace

void check_rock(const Case& c, Findings& findings) {
  check_shapes(c, findings);
  // The deck refuses a mixed class, which is reported above; with one shape it counts the rest.
  Case unmixed = c;
  for (SizeClass& size : unmixed.rock.classes) {
    if (is_mixed(size)) size.shapes.resize(1);
  }

  const std::vector<ClassCount> counts = rock_counts(unmixed);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].rocks >= 1) continue;
    // The number goes with the share and with one over the cube of the size.
    const double percent = c.rock.classes[i].mass_percent / counts[i].rocks;
    findings.push_back(finding_at(
        c, fmt::format("rock.classes.{}.mass_percent", i),
        fmt::format("the pile holds {:.2g} rocks of {}; for one write {}a size_m below {:.2g}, or "
                    "a larger pile",
                    counts[i].rocks, counts[i].name,
                    percent < 100 ? fmt::format("at least {:.2g} percent, ", percent) : "",
                    c.rock.classes[i].size_m * std::cbrt(counts[i].rocks))));
  }

  const double limit_s = stable_timestep(unmixed);
  if (c.dem.timestep_s > limit_s) {
    findings.push_back(finding_at(
        c, "dem.timestep_s",
        fmt::format("{:g} s is above the stability limit of {:.3g} s for this rock and contact",
                    c.dem.timestep_s, limit_s)));
  }
}

}  // namespace dipper::check
