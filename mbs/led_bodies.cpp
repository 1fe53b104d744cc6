#include "mbs/led_bodies.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <utility>

namespace dipper::mbs {
namespace {

constexpr const char* kHeader = "dipper led bodies 1";

}  // namespace

LedBodies::LedBodies(machine::PoseTable poses, std::vector<std::string> bodies)
    : poses_(std::move(poses)), bodies_(std::move(bodies)) {
  for (const std::string& body : bodies_)
    if (!poses_.has(body)) throw std::invalid_argument("the table has no pose of " + body);
}

core::ServerInfo LedBodies::info() const {
  core::ServerInfo info;
  info.version = "dipper-mbs, poses";
  info.bodies = bodies_;
  return info;
}

core::MachineState LedBodies::state(std::int64_t t_next_ns) {
  core::MachineState s;
  s.t_ns = t_ns_;
  for (const std::string& body : bodies_) {
    s.bodies.push_back(poses_.at(body, t_ns_));
    if (t_next_ns > t_ns_) s.X_WB_next.push_back(poses_.at(body, t_next_ns).X_WB);
  }
  return s;
}

core::MachineState LedBodies::step(const core::MachineStep& step) {
  if (step.t_end_ns <= t_ns_)
    throw std::invalid_argument(
        fmt::format("poses: a sync step must go forward; the time is {} ns, its end {} ns", t_ns_,
                    step.t_end_ns));
  t_ns_ = step.t_end_ns;
  return state(step.t_next_ns);
}

void LedBodies::save(const std::filesystem::path& file) {
  std::ofstream out(file);
  out << kHeader << '\n' << t_ns_ << '\n';
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

void LedBodies::load(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string header;
  std::int64_t t_ns = 0;
  if (!std::getline(in, header) || header != kHeader || !(in >> t_ns))
    throw std::runtime_error(file.string() + ": no checkpoint of bodies that follow poses");
  t_ns_ = t_ns;
}

}  // namespace dipper::mbs
