#include "machine/motion_plan_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "common/yaml_section.hpp"

namespace dipper::machine {
namespace {

constexpr Range kPlanPositive{0, 1e5, true};
constexpr Range kPlanNotNegative{0, 1e5};
const std::string kMove = "[start, end, ramp] in s from the cycle's start";

class PlanReader {
 public:
  PlanReader(const MachineData& machine, const ShovelKinematics& shovel, const FaceNamed& face,
             std::vector<Finding>& findings)
      : saddle_(machine.saddle.position.x(), machine.saddle.position.z()),
        shovel_(shovel),
        face_(face),
        findings_(findings) {}

  PlanFile read(const YamlTree& tree) {
    YamlSection y(tree, "", findings_);
    PlanFile file;
    MotionPlan& p = file.plan;
    file.source = y.text("source", "a string: the source of the curves");
    p.sample_s = y.number("sample_s", "a number in s", kPlanPositive);
    p.cycle_s = y.number("cycle_s", "a number in s", kPlanPositive);
    p.dig = move(y, "dig");
    p.swing_out = move(y, "swing_out");
    p.door_open = move(y, "door_open");
    p.returns = false;
    for (const char* key : {"back", "swing_back", "door_close", "lower_deg_m"})
      p.returns = p.returns || y.find(key) != nullptr;
    if (p.returns) {
      p.back = move(y, "back");
      p.swing_back = move(y, "swing_back");
      p.door_close = move(y, "door_close");
      for (const Vector2d& polar : points(y, "lower_deg_m", "[deg, m]")) {
        const double a = radians(polar.x());
        p.lower.push_back(saddle_ + polar.y() * Vector2d(std::cos(a), std::sin(a)));
      }
    }
    p.lift = points(y, "lift_m", "[x, z] in m");
    p.dump_rad = radians(y.number("dump_deg", "a number in deg"));
    p.door_rad = radians(y.number("door_deg", "a number in deg"));
    if (y.find("choose") != nullptr)
      file.choice = choice(y.section("choose", "what an operator chooses from"));
    else
      read_passes(y, p);
    y.refuse_others();
    return file;
  }

 private:
  Move move(YamlSection& y, const std::string& key) {
    const YamlTree* node = y.need(key, kMove);
    if (node == nullptr) return {};
    const std::vector<double> v = y.numbers_at(*node, key, 3, kMove);
    if (!(v[0] >= 0 && v[1] > v[0] && v[2] >= 0 && 2 * v[2] <= v[1] - v[0]))
      y.fault(*node, key, "must begin before it ends, with two ramps between; write " + kMove);
    return {v[0], v[1], v[2]};
  }

  TeethPath points(YamlSection& y, const std::string& key, const std::string& what) {
    const YamlTree* node = y.need(key, "a list of points " + what);
    TeethPath out;
    if (node == nullptr) return out;
    if (node->kind != YamlTree::Kind::list || node->children.empty())
      y.fault(*node, key, fmt::format("is {}; write a list of points {}", shown(*node), what));
    for (const auto& [index, child] : node->children) {
      const std::vector<double> v = y.numbers_at(child, key + "." + index, 2, what);
      out.emplace_back(v[0], v[1]);
    }
    return out;
  }

  /// The values of a range, both of its ends among them, none below `least`.
  std::vector<double> range(YamlSection& y, const std::string& key, double least = -INFINITY) {
    const std::string what = "[from, to, step]";
    const std::vector<double> v = y.numbers(key, 3, what);
    constexpr double kMostValues = 50;
    std::vector<double> out;
    if (v.size() < 3 || y.find(key) == nullptr) return out;
    if (!(v[1] >= v[0] && v[2] > 0 && (v[1] - v[0]) / v[2] <= kMostValues)) {
      y.fault(*y.find(key), key,
              fmt::format("must rise in at most {} steps; write {}", kMostValues, what));
      return out;
    }
    if (v[0] < least) {
      y.fault(*y.find(key), key, fmt::format("begins at {:g}; write {:g} or more", v[0], least));
      return out;
    }
    const double closest = 1e-6 * v[2];  // a last step this short is rounding
    for (int i = 0; v[0] + i * v[2] < v[1] - closest; ++i) out.push_back(v[0] + i * v[2]);
    out.push_back(v[1]);
    return out;
  }

  DigChoice choice(YamlSection y) {
    DigChoice c;
    for (const double deg : range(y, "heading_deg")) c.heading_rad.push_back(radians(deg));
    c.depth_m = range(y, "depth_m", 0);
    c.floor_rise = range(y, "floor_rise", 0);
    c.exit_z_m = range(y, "exit_z_m", 0);
    const std::vector<double> start = y.numbers("start_m", 2, "[x, z] in m");
    c.start = {start[0], start[1]};
    c.smooth_m = y.number("smooth_m", "a number in m", kPlanNotNegative);
    c.crowd_max_m = y.number("crowd_max_m", "a number in m");
    c.teeth_m_s = y.number("teeth_m_s", "a number in m/s", kPlanPositive);
    y.refuse_others();
    return c;
  }

  void read_passes(YamlSection& y, MotionPlan& plan) {
    const YamlTree* node = y.need("passes", "a list of passes");
    if (node == nullptr) return;
    if (node->kind != YamlTree::Kind::list || node->children.empty())
      return y.fault(*node, "passes", fmt::format("is {}; write a list of passes", shown(*node)));
    for (const auto& [index, child] : node->children) {
      YamlSection pass(child, "passes." + index, findings_, "heading_deg and path_m, or cut");
      PlannedPass p;
      p.heading_rad = radians(pass.number("heading_deg", "a number in deg"));
      if (pass.find("path_m") != nullptr) {
        p.dig = points(pass, "path_m", "[x, z] in m");
      } else {
        p.dig = cut(pass.section("cut", "path_m, a list of points [x, z], or cut"), p.heading_rad);
      }
      pass.refuse_others();
      plan.passes.push_back(std::move(p));
    }
  }

  TeethPath cut(YamlSection y, double heading_rad) {
    Cut c;
    const std::string face = y.text("face", "pile, or a CSV of x_m,z_m");
    const std::vector<double> start = y.numbers("start_m", 2, "[x, z] in m");
    c.start = {start[0], start[1]};
    c.depth_m = y.number("depth_m", "a number in m", kPlanPositive);
    c.floor_rise = y.number("floor_rise", "a number, dz/dx", kPlanNotNegative);
    c.exit_z_m = y.number("exit_z_m", "a number in m", kPlanPositive);
    c.smooth_m = y.number("smooth_m", "a number in m", kPlanNotNegative);
    const double crowd = y.number("crowd_max_m", "a number in m");
    y.refuse_others();
    if (!findings_.empty() || !y.is_there()) return {};
    try {
      return cut_path(face_(face, heading_rad), c, saddle_, shovel_.teeth_reach(crowd),
                      [&](const Vector2d& tip) { return shovel_.heel(tip); });
    } catch (const InputError& e) {
      for (const Finding& f : e.findings()) y.fault(*y.find("face"), "face", to_string(f));
    } catch (const std::invalid_argument& e) {
      y.fault(y.node(), "", e.what());
    }
    return {};
  }

  Vector2d saddle_;
  const ShovelKinematics& shovel_;
  const FaceNamed& face_;
  std::vector<Finding>& findings_;
};

}  // namespace

PlanFile read_plan(const std::filesystem::path& file, const MachineData& machine,
                   const ShovelKinematics& shovel, const FaceNamed& face) {
  std::vector<Finding> findings;
  const YamlTree tree = read_yaml(file, findings);
  if (!findings.empty()) throw InputError(std::move(findings));
  PlanFile plan = PlanReader(machine, shovel, face, findings).read(tree);
  if (!findings.empty()) {
    sort_by_line(findings);
    throw InputError(std::move(findings));
  }
  return plan;
}

}  // namespace dipper::machine
