#include "coupler/core/message.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

namespace dipper::core {
namespace {

struct MessageCheck {
  const Envelope& envelope;
  const std::string& side;
  const std::vector<std::string>& names;

  void require(bool sound, const char* what, std::size_t body,
               const char* fault = "is not a finite number") const {
    if (sound) return;
    throw std::runtime_error(
        fmt::format("{} sent a {} that {} for body '{}' in sync step {} (t = {:.6f} s)", side, what,
                    fault, body < names.size() ? names[body] : std::to_string(body),
                    envelope.step_index, static_cast<double>(envelope.t_ns) * 1e-9));
  }
  void pose(const Pose& X, std::size_t body) const {
    require(is_finite(X), "pose", body);
    const double norm = X.R.norm();
    require(std::abs(norm - 1) < 1e-6, "pose", body,
            fmt::format("has a quaternion of length {:.9g} in place of 1", norm).c_str());
  }

  void poses(const std::vector<Pose>& X_WB) const {
    for (std::size_t b = 0; b < X_WB.size(); ++b) pose(X_WB[b], b);
  }

  void operator()(const MachineStep& m) const {
    for (std::size_t b = 0; b < m.F_Bo_W.size(); ++b)
      require(is_finite(m.F_Bo_W[b]), "wrench that is not finite", b);
  }
  void operator()(const MachineState& m) const {
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
      pose(m.bodies[b].X_WB, b);
      require(is_finite(m.bodies[b].V_WB_W), "twist that is not finite", b);
    }
    poses(m.X_WB_next);
  }
  void operator()(const RockPlace& m) const { poses(m.X_WB); }
  void operator()(const RockStep& m) const { poses(m.X_WB_target); }
  void operator()(const RockState& m) const {
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
      pose(m.bodies[b].X_WB, b);
      require(is_finite(m.bodies[b].mean) && is_finite(m.bodies[b].end),
              "wrench that is not finite", b);
    }
  }
  void operator()(const Command&) const {}
  void operator()(const Status&) const {}
};

}  // namespace

void require_sound(const Message& m, const std::string& side,
                   const std::vector<std::string>& bodies) {
  std::visit(MessageCheck{m.envelope, side, bodies}, m.body);
}

}  // namespace dipper::core
