#include "coupler/transport/codec.hpp"

#include <fmt/core.h>

#include <array>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dipper_msg/command_t.hpp"
#include "dipper_msg/machine_state_t.hpp"
#include "dipper_msg/machine_step_t.hpp"
#include "dipper_msg/rock_place_t.hpp"
#include "dipper_msg/rock_state_t.hpp"
#include "dipper_msg/rock_step_t.hpp"
#include "dipper_msg/status_t.hpp"

namespace dipper::transport {
namespace {

/// Writes or reads the fields of a message in LCM's format: numbers big-endian, a string after its
/// length (its NUL included), a list after its length. LCM's own decoder trusts the lengths: it
/// allocates a list before it checks that the bytes are there, and copies a string of negative
/// length from outside the message.
class Fields {
 public:
  Fields() = default;  ///< writes
  explicit Fields(std::string_view bytes) : reading_(true), rest_(bytes) {}

  template <class... Field>
  void operator()(Field&... field) {
    (visit(field), ...);
  }
  const std::string& written() const { return written_; }
  bool at_end() const { return rest_.empty(); }

 private:
  void visit(double& x) {
    std::int64_t bits = 0;
    std::memcpy(&bits, &x, sizeof x);
    visit(bits);
    std::memcpy(&x, &bits, sizeof x);
  }
  void visit(std::string& s) {
    auto length = static_cast<std::uint32_t>(s.size() + 1);
    visit(length);
    if (!reading_) {
      written_.append(s.c_str(), length);
    } else if (length == 0) {
      throw DecodeError("a string in a message is not terminated");
    } else {
      s = next(length).substr(0, length - 1);
    }
  }
  template <class Item>
  void visit(std::vector<Item>& list) {
    auto length = static_cast<std::uint32_t>(list.size());
    visit(length);
    for (std::uint32_t k = 0; k < length; ++k) visit(reading_ ? list.emplace_back() : list[k]);
  }

  // As in coupler/lcm/dipper_msg.lcm.
  void visit(core::Envelope& e) {
    std::array<std::int64_t, sizeof dipper_msg::header_t::mac / 8> mac{};  // the transport sets it
    for (auto& part : mac) visit(part);
    (*this)(e.run_id, e.case_hash, e.step_index, e.sequence, e.t_ns);
    header_ = &e;
  }
  void visit(Vector3d& v) { (*this)(v.x(), v.y(), v.z()); }
  void visit(Quaterniond& q) { (*this)(q.w(), q.x(), q.y(), q.z()); }
  void visit(Twist& V) { (*this)(V.w, V.v); }
  void visit(Wrench& F) { (*this)(F.torque, F.force); }
  void visit(Pose& X) { (*this)(X.p, X.R); }
  void visit(BodyState& b) { (*this)(b.X_WB, b.V_WB_W); }
  void visit(core::BodyLoad& b) { (*this)(b.mean, b.end, b.X_WB); }
  void visit(core::MachineStep& m) {
    (*this)(m.t_next_ns, m.F_Bo_W, m.order.by_ns, m.order.to);
    m.t_end_ns = header_->t_ns;
    m.step_index = header_->step_index;
  }
  void visit(core::MachineState& m) {
    (*this)(m.t_ns, m.contact, m.bodies, m.X_WB_next, m.channels);
  }
  void visit(core::RockPlace& m) { (*this)(m.X_WB); }
  void visit(core::RockStep& m) {
    (*this)(m.n_steps, m.contact, m.X_WB_target);
    m.t_end_ns = header_->t_ns;
    m.step_index = header_->step_index;
  }
  void visit(core::RockState& m) {
    (*this)(m.step, m.bodies, m.channels);
    m.t_ns = header_->t_ns;
  }
  void visit(core::Status& m) { (*this)(m.ok, m.text); }
  void visit(core::Command& m) {
    auto action = static_cast<std::int32_t>(m.action);
    (*this)(action, m.text);
    if (action < 1 || action > static_cast<std::int32_t>(core::Action::follow))
      throw DecodeError(fmt::format("unknown command {}", action));
    m.action = static_cast<core::Action>(action);
  }

  template <class Integer, std::enable_if_t<std::is_integral_v<Integer>, int> = 0>
  void visit(Integer& n) {
    std::uint64_t bits = 0;
    if (reading_) {
      for (const char c : next(sizeof n)) bits = (bits << 8) | static_cast<unsigned char>(c);
      n = static_cast<Integer>(bits);
    } else {
      bits = static_cast<std::uint64_t>(n);
      for (std::size_t k = sizeof n; k-- > 0;) written_ += static_cast<char>(bits >> (8 * k));
    }
  }
  std::string_view next(std::size_t n) {
    if (n > rest_.size()) throw DecodeError("a message is cut short");
    const std::string_view bytes = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return bytes;
  }

  bool reading_ = false;
  const core::Envelope* header_ = nullptr;  ///< of the message; holds some fields of its body
  std::string_view rest_;
  std::string written_;
};

/// LCM's fingerprint of each type of core::Body.
std::int64_t fingerprint(const core::Body& body) {
  using namespace dipper_msg;
  const std::array<std::int64_t, std::variant_size_v<core::Body>> of = {
      machine_step_t::getHash(), machine_state_t::getHash(), rock_place_t::getHash(),
      rock_step_t::getHash(),    rock_state_t::getHash(),    command_t::getHash(),
      status_t::getHash()};
  return of.at(body.index());
}

/// The rest of a message, decoded as that type of body.
template <class... Body>
bool read(Fields& fields, std::int64_t type, core::Envelope& header, std::variant<Body...>& body) {
  const auto read_as = [&](auto empty) {
    body = std::move(empty);
    if (fingerprint(body) != type) return false;
    fields(header, std::get<decltype(empty)>(body));
    if (!fields.at_end()) throw DecodeError("a message is too long");
    return true;
  };
  return (read_as(Body{}) || ...);
}

}  // namespace

std::string encode(const core::Message& message) {
  core::Message m = message;  // Fields takes a mutable reference
  Fields fields;
  std::int64_t type = fingerprint(m.body);
  std::visit([&](auto& body) { fields(type, m.envelope, body); }, m.body);
  return fields.written();
}

core::Message decode(const std::string& bytes) {
  Fields fields(bytes);
  std::int64_t type = 0;
  fields(type);
  core::Message m;
  if (read(fields, type, m.envelope, m.body)) return m;
  throw DecodeError("a message of a type this version does not know");
}

}  // namespace dipper::transport
