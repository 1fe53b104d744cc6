#include "coupler/core/message.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "common/seconds.hpp"

namespace dipper::core {
namespace {

struct MessageCheck {
  const Envelope& envelope;
  const std::string& side;
  const std::vector<std::string>& names;

  void require(bool sound, const char* what, std::size_t body,
               const char* fault = "is not finite") const {
    if (sound) return;
    throw std::runtime_error(
        fmt::format("{} sent a {} that {} for body '{}' in sync step {} (t = {:.6f} s)", side, what,
                    fault, body < names.size() ? names[body] : std::to_string(body),
                    envelope.step_index, seconds(envelope.t_ns)));
  }
  void check(const Pose& X, std::size_t body) const {
    require(is_finite(X), "pose", body);
    require(std::abs(X.R.norm() - 1) < 1e-6, "pose", body, "has a quaternion not of length 1");
  }
  void check(const Wrench& F, std::size_t body) const { require(is_finite(F), "wrench", body); }
  void check(const BodyState& b, std::size_t body) const {
    check(b.X_WB, body);
    require(is_finite(b.V_WB_W), "twist", body);
  }
  void check(const BodyLoad& b, std::size_t body) const {
    check(b.X_WB, body);
    check(b.mean, body);
    check(b.end, body);
  }
  template <class Item>
  void all(const std::vector<Item>& list) const {
    for (std::size_t b = 0; b < list.size(); ++b) check(list[b], b);
  }

  void operator()(const MachineStep& m) const {
    all(m.F_Bo_W);
    for (const double x : m.order.to)
      if (!std::isfinite(x))
        throw std::runtime_error(fmt::format("{} sent an order that is not finite (t = {:.6f} s)",
                                             side, seconds(envelope.t_ns)));
  }
  void operator()(const MachineState& m) const {
    all(m.bodies);
    all(m.X_WB_next);
  }
  void operator()(const RockPlace& m) const { all(m.X_WB); }
  void operator()(const RockStep& m) const { all(m.X_WB_target); }
  void operator()(const RockState& m) const { all(m.bodies); }
  template <class Words>
  void operator()(const Words&) const {}
};

}  // namespace

void require_sound(const Message& m, const std::string& side,
                   const std::vector<std::string>& bodies) {
  std::visit(MessageCheck{m.envelope, side, bodies}, m.body);
}

}  // namespace dipper::core
