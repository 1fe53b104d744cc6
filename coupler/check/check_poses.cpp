#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/input_error.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/deck/deck_names.hpp"
#include "machine/pose_table.hpp"

namespace dipper::check {

namespace {

// So many times the domain's own size off it, positions are in another unit.
constexpr double kFarOff = 5;

/// The unit in which all positions are in the domain, if as they are they go far beyond it; else
/// nothing.
std::string unit_of_positions(const cases::Case& c, const machine::PoseTable& table) {
  Vector3d low = Vector3d::Constant(INFINITY), high = -low;
  for (const std::string& name : table.bodies())
    for (const machine::PoseTable::Row& row : table.rows(name)) {
      low = low.cwiseMin(row.X_WB.p);
      high = high.cwiseMax(row.X_WB.p);
    }
  const double size = (c.domain.max_m - c.domain.min_m).maxCoeff();
  const double beyond =
      std::max((c.domain.min_m - low).maxCoeff(), (high - c.domain.max_m).maxCoeff());
  if (beyond < kFarOff * size) return "";
  for (const auto& [unit, scale] : {std::pair{"cm", 0.01}, std::pair{"mm", 0.001}})
    if (((scale * low - c.domain.min_m).array() >= 0).all() &&
        ((c.domain.max_m - scale * high).array() >= 0).all())
      return unit;
  return "";
}

}  // namespace

void check_poses(const cases::Case& c, const std::map<std::string, mesh::TriangleMesh>& bodies,
                 Findings& findings) {
  if (!file_exists(c, "machine.poses", c.machine.poses, findings)) return;
  std::optional<machine::PoseTable> table;
  try {
    table = machine::PoseTable::load(c.machine.poses);
  } catch (const InputError& e) {
    return cases::add_file_findings(c, "machine.poses", e, findings);
  }
  for (const auto& body : c.bodies)
    if (!table->has(body.first))
      findings.push_back(cases::finding_at(c, "bodies." + body.first,
                                           "has no row in machine.poses; write one or more"));
  for (const std::string& name : table->bodies())
    if (c.bodies.count(name) == 0)
      findings.push_back({c.machine.poses, 0, "body",
                          name + " is not under bodies in the case; name its mesh there"});
  for (const auto& body : c.bodies)
    if (deck::is_deck_name(body.first))
      findings.push_back(cases::finding_at(c, "bodies." + body.first,
                                           "the rock's scripts use this name; choose another"));
  if (table->end_ns() <= 0 && c.end_s <= 0) {
    findings.push_back({c.machine.poses, 0, "machine.poses",
                        "has no row after 0 s, where the run begins; write later rows, or end_s"});
    return;
  }
  if (const std::string unit = unit_of_positions(c, *table); !unit.empty()) {
    findings.push_back({c.machine.poses, 0, "machine.poses",
                        fmt::format("x_m,y_m,z_m go far beyond the domain: in {}, perhaps? in {} "
                                    "all are in it; write them in m",
                                    unit, unit)});
    return;
  }
  std::map<std::string, mesh::TriangleMesh> known = bodies;
  for (const auto& body : bodies)
    if (!table->has(body.first)) known.erase(body.first);
  const auto pose = [&](const std::string& body, std::int64_t t_ns) {
    return std::optional(table->at(body, t_ns).X_WB);
  };
  check_bodies_in_domain(c, pose, 0, table->end_ns(), known, findings);
  check_windows(c, table->end_ns(), findings);
}

}  // namespace dipper::check
