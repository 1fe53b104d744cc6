#include "coupler/run/pass_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/angles.hpp"
#include "common/json_text.hpp"
#include "common/seconds.hpp"
#include "common/text_file.hpp"
#include "coupler/deck/dig_planner.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::run {
namespace {

using nlohmann::json;

constexpr double kStand_s = 0.1;  // the machine stands where it is until a pass begins
constexpr double kTick_s = 0.01;  // of a pass's beginning
// The range of what passes can teach: beyond it a pass went wrong.
constexpr double kLeastResistance = 0.5, kMostResistance = 2;
constexpr double kLeastLoaded = 0.6, kMostLoaded = 1.2;

/// Calls f with name and value of every number that a checkpoint keeps of them.
template <typename Pass, typename Experience, typename F>
void each_number(Pass& p, Experience& e, F f) {
  f("rock_from_s", p.rock_from_s);
  f("rock_to_s", p.rock_to_s);
  f("crowd_N", p.crowd_N);
  f("payload_kg", p.payload_kg);
  f("along_s", p.along_s);
  f("crowd_sum", p.crowd_sum);
  f("sum_s", p.sum_s);
  f("resistance", e.resistance);
  f("loaded", e.loaded);
}

/// A factor after a pass that measured `ratio` times what it expected. One pass scatters by as much
/// as passes differ, so half of the difference counts. Below 0: a truck that lost rock, or a crowd
/// that held back.
double learned(double factor, double ratio, double least, double most) {
  return std::clamp(factor * std::sqrt(std::max(ratio, 0.0)), least, most);
}

double rounded(double value, double step) { return std::round(value / step) * step + 0.0; }

json json_of(const machine::TeethPath& path) {
  json points = json::array();
  for (const auto& p : path) points.push_back({rounded(p.x(), 1e-3), rounded(p.y(), 1e-3)});
  return points;
}

json json_of(const machine::DigCandidate& c) {
  json j = {{"heading_deg", rounded(degrees(c.heading_rad), 1e-3)},
            {"depth_m", rounded(c.depth_m, 1e-4)},
            {"floor_rise", rounded(c.floor_rise, 1e-4)},
            {"exit_z_m", rounded(c.exit_z_m, 1e-3)},
            {"swept_m3", rounded(c.swept_m3, 1e-2)},
            {"payload_kg", rounded(c.payload_kg, 1)},
            {"crowd_peak_N", rounded(c.crowd_peak_N, 1)},
            {"crowd_mean_N", rounded(c.crowd_mean_N, 1)},
            {"hoist_peak_N", rounded(c.hoist_peak_N, 1)},
            {"dig_force_mean_N", rounded(c.dig_force_mean_N, 1)},
            {"dig_s", rounded(c.dig_s, 1e-2)},
            {"cycle_s", rounded(c.cycle_s, 1e-2)},
            {"energy_J", rounded(c.energy_J, 1)},
            {"score", c.score}};
  if (!c.refused.empty()) j["refused"] = c.refused;
  return j;
}

}  // namespace

PassDesk::PassDesk(const cases::Case& c, const Sides& sides, std::filesystem::path folder,
                   const json& state, Reporter& reporter)
    : case_(c),
      sides_(sides),
      folder_(std::move(folder)),
      reporter_(reporter),
      planner_(deck::dig_planner(c, c.machine.plan)),
      crowd_force_(core::channel_index(sides.machine_info, "crowd_force")),
      truck_(core::channel_index(sides.rock_info, "mass_in_truck")) {
  const machine::MachineData data = machine::load_machine(c.machine.model);
  const machine::ShovelKinematics shovel(data, {Quaterniond::Identity(), c.machine.base_position_m},
                                         radians(c.machine.rake_angle_deg));
  const machine::Drives start = machine::Motion::load(c.machine.motion).value(0);
  start_tip_ = shovel.teeth(start);
  start_heading_rad_ = start.swing;
  eye_W_ = c.machine.base_position_m + data.boom.point;
  if (c.machine.drives == machine::DriveMode::limited)
    path_time_ = core::channel_index(sides.machine_info, "path_time");
  if (state.is_null()) return;
  passes_ = state.at("passes");
  end_s_ = state.at("end_s");
  truck_kg_ = state.at("truck_kg");
  loaded_kg_ = state.at("loaded_kg");
  finished_ = state.at("finished");
  each_number(pass_, before_, [&](const char* name, double& x) { x = state.at(name); });
  forget_later();
}

void PassDesk::forget_later() const {
  namespace fs = std::filesystem;
  if (finished_) return;  // its last decision says why
  for (int pass = passes_ + 1; fs::remove(folder_ / fmt::format("pass_{}.json", pass)); ++pass) {
  }
  fs::remove(folder_ / "end.json");
}

json PassDesk::state() const {
  json all = {{"passes", passes_},
              {"end_s", end_s_},
              {"truck_kg", truck_kg_},
              {"loaded_kg", loaded_kg_},
              {"finished", finished_}};
  each_number(pass_, before_, [&](const char* name, double x) { all[name] = x; });
  return all;
}

bool is_finished(const json& desk_state) {
  return desk_state.is_object() && desk_state.value("finished", false);
}

double PassDesk::along_s(const core::Window& w) const {
  return path_time_ ? w.machine.channels[*path_time_] : seconds(w.rock.t_ns);
}

double PassDesk::expected_end_s() const {
  if (finished_ || passes_ == 0) return end_s_;
  double left = case_.op.passes - passes_;
  if (case_.truck.rated_t > 0 && pass_.payload_kg > 0) {
    const double to_fill = (case_.truck.rated_t * 1e3 - truck_kg_) / pass_.payload_kg;
    left = std::min(left, std::max(0.0, std::round(to_fill) - 1));
  }
  return end_s_ * (1 + left / passes_);
}

bool PassDesk::needs_rest(const core::Window& w) const {
  return !finished_ && (w.step_index == 0 || (passes_ > 0 && along_s(w) >= end_s_));
}

void PassDesk::window(const core::Window& w) {
  feel(w);
  if (needs_rest(w)) plan(w);
}

void PassDesk::feel(const core::Window& w) {
  const double now_s = along_s(w), since_s = now_s - pass_.along_s;
  pass_.along_s = now_s;
  if (now_s <= pass_.rock_from_s || now_s > pass_.rock_to_s || since_s <= 0) return;
  pass_.crowd_sum += since_s * w.machine.channels[crowd_force_];
  pass_.sum_s += since_s;
}

void PassDesk::learn(double loaded_kg) {
  if (pass_.sum_s > 0 && pass_.crowd_N > 0)
    before_.resistance = learned(before_.resistance, pass_.crowd_sum / pass_.sum_s / pass_.crowd_N,
                                 kLeastResistance, kMostResistance);
  if (pass_.payload_kg > 0)
    before_.loaded =
        learned(before_.loaded, loaded_kg / pass_.payload_kg, kLeastLoaded, kMostLoaded);
}

std::string PassDesk::reason_to_stop(double truck_kg) const {
  if (passes_ == 0) return "";
  const double rated_kg = case_.truck.rated_t * 1e3, mean_kg = loaded_kg_ / passes_;
  // One more pass would take it further over its rating than it is under it now.
  if (rated_kg > 0 && truck_kg + mean_kg / 2 >= rated_kg)
    return fmt::format("the truck is full: {:.1f} t of {:.0f} t, and a pass loads {:.0f} t",
                       truck_kg * 1e-3, case_.truck.rated_t, mean_kg * 1e-3);
  if (passes_ >= case_.op.passes)
    return fmt::format("all passes done (operator.passes: {})", passes_);
  return "";
}

void PassDesk::stop(const core::Window& w, const std::string& why, double truck_kg) {
  finished_ = true;
  reporter_.line(fmt::format("operator, {:.1f} s: {}", seconds(w.rock.t_ns), why));
  write_text(folder_ / "end.json", json{{"t_s", seconds(w.rock.t_ns)},
                                        {"passes", passes_},
                                        {"truck_kg", truck_kg},
                                        {"reason", why}}
                                           .dump(1) +
                                       '\n');
}

void PassDesk::plan(const core::Window& w) {
  const double truck_kg = w.rock.channels[truck_];
  if (passes_ > 0) {
    learn(truck_kg - truck_kg_);
    loaded_kg_ += truck_kg - truck_kg_;
  }
  truck_kg_ = truck_kg;
  if (const std::string why = reason_to_stop(truck_kg); !why.empty()) return stop(w, why, truck_kg);

  const HeightMap face = sides_.rock.look(planner_.grid());
  const HeightMap seen = machine::scanned(
      face, eye_W_, {case_.op.scan_error_m, radians(case_.op.scan_dead_angle_deg)},
      static_cast<std::uint64_t>(case_.seed) * 1000 + static_cast<std::uint64_t>(passes_));
  machine::PassStart from;
  from.t_s = std::ceil((std::max(along_s(w), end_s_) + kStand_s) / kTick_s) * kTick_s;
  from.at_dump = passes_ > 0;
  from.tip = start_tip_;
  from.heading_rad = start_heading_rad_;
  const double room_kg = case_.truck.rated_t > 0 ? case_.truck.rated_t * 1e3 - truck_kg
                                                 : std::numeric_limits<double>::infinity();
  const machine::DigDecision decision = planner_.decide(
      seen, from, case_.op.least_fill * planner_.facts().capacity_kg, room_kg, before_);
  ++passes_;
  write(w, seen, decision, from.t_s, truck_kg);
  if (decision.chosen < 0) {
    --passes_;
    return stop(w, decision.reason, truck_kg);
  }
  sides_.machine.follow(decision.rows);
  end_s_ = decision.times.end_s;
  const auto& best = decision.candidates[static_cast<std::size_t>(decision.chosen)];
  pass_ = {decision.rock_from_s,
           decision.rock_to_s,
           best.crowd_mean_N,
           best.payload_kg,
           along_s(w),
           0,
           0};
  reporter_.line(fmt::format("operator, {:.1f} s, pass {}: {}", seconds(w.rock.t_ns), passes_,
                             decision.reason));
}

void PassDesk::write(const core::Window& w, const HeightMap& seen,
                     const machine::DigDecision& decision, double begins_s, double truck_kg) const {
  json j = {{"pass", passes_},
            {"t_s", seconds(w.rock.t_ns)},
            {"truck_kg", truck_kg},
            {"goal", case_.op.goal == machine::DigGoal::energy ? "energy" : "time"},
            {"reason", decision.reason},
            {"resistance", rounded(before_.resistance, 1e-3)},
            {"loaded", rounded(before_.loaded, 1e-3)},
            {"face", parse_json(to_json_text(seen))},
            {"chosen", nullptr},
            {"candidates", json::array()}};
  for (const machine::DigCandidate& c : decision.candidates) j["candidates"].push_back(json_of(c));
  if (decision.chosen >= 0) {
    const auto& best = decision.candidates[static_cast<std::size_t>(decision.chosen)];
    Pose X_WBoom;
    X_WBoom.R = from_rotation_vector({0, 0, best.heading_rad});
    X_WBoom.p = {case_.machine.base_position_m.x(), case_.machine.base_position_m.y(), 0};
    j["chosen"] = decision.chosen;
    j["path_m"] = json_of(best.dig);
    j["profile_m"] = json_of(seen.profile(X_WBoom, case_.pile.width_m / 6));
    j["begins_at_s"] = begins_s;
    j["dig_at_s"] = decision.times.dig_s;
    j["dump_at_s"] = decision.times.dump_s;
    j["end_at_s"] = decision.times.end_s;
    j["rows"] = decision.rows;
  }
  std::filesystem::create_directories(folder_);
  write_text(folder_ / fmt::format("pass_{}.json", passes_), j.dump() + '\n');
}

}  // namespace dipper::run
