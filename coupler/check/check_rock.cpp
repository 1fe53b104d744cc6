#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/input_error.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/deck_names.hpp"
#include "coupler/deck/rock_kinds.hpp"
#include "coupler/deck/shape_library.hpp"
#include "coupler/deck/stable_timestep.hpp"

namespace fs = std::filesystem;

namespace dipper::check {
namespace {

bool is_mixed(const cases::SizeClass& size) {
  const auto spheres = std::count(size.shapes.begin(), size.shapes.end(), "sphere");
  return spheres > 0 && spheres < static_cast<std::ptrdiff_t>(size.shapes.size());
}

// A scan may have thousands of faults; the first few show what is wrong with it.
void check_shape(const cases::Case& c, const std::string& shape, Findings& findings) {
  constexpr std::size_t shown = 10;
  const fs::path stl = deck::shape_mesh(c.rock.shape_folder, shape);
  const std::string key = "rock.shape_folder";
  try {
    if (!deck::is_made_from_mesh(c.rock.shape_folder, shape)) {
      deck::read_rock_shape(c.rock.shape_folder / (shape + ".yaml"));
      return;
    }
    const auto faults = deck::rock_faults(mesh::read_stl(stl));
    for (std::size_t i = 0; i < faults.size() && i < shown; ++i)
      findings.push_back({stl, 0, key, faults[i]});
    if (faults.size() > shown)
      findings.push_back({stl, 0, key, fmt::format("and {} more faults", faults.size() - shown)});
  } catch (const InputError& e) {
    cases::add_file_findings(c, key, e, findings);
  }
}

void check_shapes(const cases::Case& c, Findings& findings) {
  if (!fs::is_directory(c.rock.shape_folder)) {
    findings.push_back(cases::finding_at(c, "rock.shape_folder",
                                         "no such folder: " + c.rock.shape_folder.string()));
    return;
  }
  std::set<std::string> known = deck::shape_names(c.rock.shape_folder);
  known.insert("sphere");
  std::set<std::string> looked_at;
  for (std::size_t i = 0; i < c.rock.classes.size(); ++i) {
    const cases::SizeClass& size = c.rock.classes[i];
    for (std::size_t j = 0; j < size.shapes.size(); ++j) {
      const std::string& shape = size.shapes[j];
      if (shape == "sphere") continue;
      if (!known.count(shape)) {
        findings.push_back(cases::finding_at(
            c, fmt::format("rock.classes.{}.shapes.{}", i, j),
            fmt::format("no shape '{}'; choose from {}", shape, fmt::join(known, ", "))));
        continue;
      }
      if (looked_at.insert(shape).second) check_shape(c, shape, findings);
    }
    if (is_mixed(size)) {
      findings.push_back(
          cases::finding_at(c, fmt::format("rock.classes.{}.shapes", i),
                            "mixes spheres and other shapes, whose friction differs; make "
                            "two classes"));
    }
  }
}

// LIGGGHTS lets a template replace another of the same name, and the grading is then wrong.
void check_kind_names(const cases::Case& c, Findings& findings) {
  std::map<std::string, std::string> seen;  // name of a template -> class and shape
  for (std::size_t i = 0; i < c.rock.classes.size(); ++i) {
    const cases::SizeClass& size = c.rock.classes[i];
    for (std::size_t j = 0; j < size.shapes.size(); ++j) {
      const std::string name = deck::kind_name(size, size.shapes[j]);
      const std::string what = fmt::format("shape {} of class {}", size.shapes[j], size.name);
      const auto [other, is_new] = seen.emplace(name, what);
      const std::string key = fmt::format("rock.classes.{}", i);
      if (deck::is_deck_name(name)) {
        findings.push_back(cases::finding_at(
            c, key + ".name",
            fmt::format("{} is {} in the input scripts, which use this name for something else; "
                        "rename the class",
                        what, name)));
      } else if (!is_new && other->second == what) {
        findings.push_back(
            cases::finding_at(c, fmt::format("{}.shapes.{}", key, j),
                              fmt::format("'{}' stands twice; write it once", size.shapes[j])));
      } else if (!is_new) {
        findings.push_back(cases::finding_at(
            c, key + ".name",
            fmt::format("{} and {} are both {} in the input scripts; rename the class", what,
                        other->second, name)));
      }
    }
  }
}

}  // namespace

cases::Case without_mixed_classes(cases::Case c) {
  for (cases::SizeClass& size : c.rock.classes)
    if (is_mixed(size)) size.shapes.resize(1);
  return c;
}

void check_rock(const cases::Case& c, Findings& findings) {
  check_shapes(c, findings);
  check_kind_names(c, findings);
  const cases::Case unmixed = without_mixed_classes(c);
  const std::vector<deck::ClassCount> counts = deck::rock_counts(unmixed);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].rocks >= 1) continue;
    if (!c.rock.sieve.file.empty()) {
      findings.push_back(cases::finding_at(
          c, "rock.sieve.file",
          fmt::format("the pile holds only {:.2g} rocks of the {:.3g} m that stand for {:.2g} % of "
                      "the curve; sizes in mm or cm, perhaps? Else a rock.sieve.max_size_m, fewer "
                      "rock.sieve.classes, or a larger pile",
                      counts[i].rocks, c.rock.classes[i].size_m, c.rock.classes[i].mass_percent)));
      continue;
    }
    // The number is proportional to the share and to one over the cube of the size.
    const double percent = c.rock.classes[i].mass_percent / counts[i].rocks;
    findings.push_back(cases::finding_at(
        c, fmt::format("rock.classes.{}.mass_percent", i),
        fmt::format(
            "the pile holds only {:.2g} rocks of {}; write {}a size_m below {:.2g}, or a larger "
            "pile",
            counts[i].rocks, counts[i].name,
            percent < 100 ? fmt::format("at least {:.2g} percent, ", percent) : "",
            c.rock.classes[i].size_m * std::cbrt(counts[i].rocks))));
  }

  const bool needs_voids =
      c.rock.fines_fraction > 0 || c.contact.cohesion_Pa > 0 || c.contact.adhesion_Pa > 0;
  if (needs_voids && deck::porosity(c) <= 0) {
    findings.push_back(cases::finding_at(
        c, "rock.bulk_density_kg_m3",
        fmt::format("{:g} leaves no voids in rock of {:g} kg/m3, but fines and moisture need some",
                    c.rock.bulk_density_kg_m3, c.rock.density_kg_m3)));
  }

  const double limit_s = deck::stable_timestep(unmixed);
  if (c.dem.timestep_s > limit_s) {
    findings.push_back(cases::finding_at(
        c, "dem.timestep_s",
        fmt::format("{:g} s is above the stability limit of {:.3g} s for this rock and contact",
                    c.dem.timestep_s, limit_s)));
  }
}

}  // namespace dipper::check
