#include "coupler/run/run_record.hpp"

#include <array>

#include "common/seconds.hpp"

namespace dipper::run {
namespace {

using Clock = std::chrono::steady_clock;

std::array<double, 7> row(const Pose& X) {
  return {X.p.x(), X.p.y(), X.p.z(), X.R.w(), X.R.x(), X.R.y(), X.R.z()};
}
std::array<double, 6> row(const Vector3d& a, const Vector3d& b) {
  return {a.x(), a.y(), a.z(), b.x(), b.y(), b.z()};
}
std::array<double, 6> row(const Twist& V) { return row(V.w, V.v); }
std::array<double, 6> row(const Wrench& F) { return row(F.torque, F.force); }

}  // namespace

RunRecord::RunRecord(const std::filesystem::path& file, const core::ServerInfo& machine,
                     const core::ServerInfo& rock,
                     const std::map<std::string, std::string>& attributes,
                     const RecordPosition& from)
    : record_(from.rows > 0 ? record::Record::resume(file, from.rows)
                            : record::Record::create(file, attributes)),
      time_(record_.add("time_s", "s", "-")),
      step_(record_.add("step_index", "1", "-")),
      sync_(record_.add("sync_s", "s", "-")),
      rock_work_(record_.add("coupling/rock_work", "J", "-")),
      machine_work_(record_.add("coupling/machine_work", "J", "-")),
      residual_(record_.add("coupling/energy_residual", "J", "-")),
      power_rock_(record_.add("coupling/interface_power_rock", "W", "-")),
      power_machine_(record_.add("coupling/interface_power_machine", "W", "-")),
      at_(from),
      flushed_(Clock::now()) {
  for (const auto& c : machine.channels) {
    machine_.push_back(record_.add("machine/" + c.name, c.unit, c.frame));
  }
  for (const auto& c : rock.channels) {
    rock_.push_back(record_.add("rock/" + c.name, c.unit, c.frame));
  }
  for (const auto& name : machine.bodies) {
    const std::string at = "bodies/" + name + "/";
    bodies_.push_back(
        {record_.add(at + "pose", "m m m 1 1 1 1 (p, then quaternion w x y z)", "W", 7),
         record_.add(at + "twist", "rad/s x3, m/s x3", "W", 6),
         record_.add(at + "wrench_mean", "N m x3, N x3", "W, about the body's origin", 6),
         record_.add(at + "wrench_end", "N m x3, N x3", "W, about the body's origin", 6),
         record_.add(at + "wall_pose", "m m m 1 1 1 1 (p, then quaternion w x y z)", "W", 7)});
  }
}

void RunRecord::flush() {
  record_.flush();
  flushed_ = Clock::now();
}

void RunRecord::sync() {
  record_.sync();
  flushed_ = Clock::now();
}

void RunRecord::window(const core::Window& w) {
  const double t = seconds(w.rock.t_ns);
  const double sync = t - seconds(at_.t_ns);
  at_.t_ns = w.rock.t_ns;
  at_.rock_work_J += w.rock_work_J;
  at_.machine_work_J += w.machine_work_J;
  record_.put(time_, t);
  record_.put(step_, static_cast<double>(w.step_index));
  record_.put(sync_, sync);
  record_.put(rock_work_, at_.rock_work_J);
  record_.put(machine_work_, at_.machine_work_J);
  record_.put(residual_, at_.machine_work_J - at_.rock_work_J);
  record_.put(power_rock_, sync > 0 ? w.rock_work_J / sync : 0.0);
  record_.put(power_machine_, sync > 0 ? w.machine_work_J / sync : 0.0);
  for (std::size_t i = 0; i < machine_.size(); ++i) {
    record_.put(machine_[i], w.machine.channels[i]);
  }
  for (std::size_t i = 0; i < rock_.size(); ++i) record_.put(rock_[i], w.rock.channels[i]);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    record_.put(bodies_[b].pose, row(w.machine.bodies[b].X_WB).data());
    record_.put(bodies_[b].twist, row(w.machine.bodies[b].V_WB_W).data());
    record_.put(bodies_[b].wrench_mean, row(w.rock.bodies[b].mean).data());
    record_.put(bodies_[b].wrench_end, row(w.rock.bodies[b].end).data());
    record_.put(bodies_[b].wall_pose, row(w.rock.bodies[b].X_WB).data());
  }
  record_.next();
  at_.rows = record_.rows();
  if (Clock::now() - flushed_ > std::chrono::seconds(1)) flush();
}

}  // namespace dipper::run
