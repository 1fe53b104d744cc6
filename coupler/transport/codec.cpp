#include "coupler/transport/codec.hpp"

#include <fmt/core.h>

#include <algorithm>
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

using namespace dipper_msg;

void put(const Vector3d& v, double (&out)[3]) { std::copy_n(v.data(), 3, out); }
Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

pose_t pack(const Pose& X) {
  pose_t t;
  put(X.p, t.p_WBo_W);
  t.R_WB[0] = X.R.w();
  t.R_WB[1] = X.R.x();
  t.R_WB[2] = X.R.y();
  t.R_WB[3] = X.R.z();
  return t;
}
Pose unpack(const pose_t& t) {
  return {{t.R_WB[0], t.R_WB[1], t.R_WB[2], t.R_WB[3]}, vector(t.p_WBo_W)};
}

wrench_t pack(const Wrench& F) {
  wrench_t t;
  put(F.torque, t.torque_Bo_W);
  put(F.force, t.force_Bo_W);
  return t;
}
Wrench unpack(const wrench_t& t) { return {vector(t.torque_Bo_W), vector(t.force_Bo_W)}; }

body_motion_t pack(const BodyState& b) {
  body_motion_t t;
  t.X_WB = pack(b.X_WB);
  put(b.V_WB_W.w, t.V_WB_W.w_WB_W);
  put(b.V_WB_W.v, t.V_WB_W.v_WBo_W);
  return t;
}
BodyState unpack(const body_motion_t& t) {
  return {unpack(t.X_WB), {vector(t.V_WB_W.w_WB_W), vector(t.V_WB_W.v_WBo_W)}};
}

body_load_t pack(const core::BodyLoad& b) {
  body_load_t t;
  t.mean = pack(b.mean);
  t.end = pack(b.end);
  t.X_WB = pack(b.X_WB);
  return t;
}
core::BodyLoad unpack(const body_load_t& t) {
  return {unpack(t.mean), unpack(t.end), unpack(t.X_WB)};
}

template <class To, class From>
std::int32_t pack(const std::vector<From>& from, std::vector<To>& to) {
  for (const From& x : from) to.push_back(pack(x));
  return static_cast<std::int32_t>(to.size());
}
template <class To, class From>
void unpack(const std::vector<From>& from, std::vector<To>& to) {
  for (const From& x : from) to.push_back(unpack(x));
}

header_t pack(const core::Envelope& e) {
  header_t h;
  std::fill(std::begin(h.mac), std::end(h.mac), std::uint8_t{0});  // the transport seals it
  h.run_id = e.run_id;
  h.case_hash = e.case_hash;
  h.step_index = e.step_index;
  h.sequence = e.sequence;
  h.t_ns = e.t_ns;
  return h;
}

core::Envelope unpack(const header_t& h) {
  return {h.run_id, h.case_hash, h.step_index, h.sequence, h.t_ns};
}

machine_step_t pack(const core::MachineStep& m) {
  machine_step_t t;
  t.t_next_ns = m.t_next_ns;
  t.n_bodies = pack(m.F_Bo_W, t.wrenches);
  return t;
}
core::MachineStep unpack(const machine_step_t& t) {
  core::MachineStep m{t.header.t_ns, {}, t.t_next_ns, t.header.step_index};
  unpack(t.wrenches, m.F_Bo_W);
  return m;
}

machine_state_t pack(const core::MachineState& m) {
  machine_state_t t;
  t.t_ns = m.t_ns;
  t.contact = m.contact;
  t.n_bodies = pack(m.bodies, t.bodies);
  t.n_next = pack(m.X_WB_next, t.next);
  t.n_channels = static_cast<std::int32_t>(m.channels.size());
  t.channels = m.channels;
  return t;
}
core::MachineState unpack(const machine_state_t& t) {
  core::MachineState m{t.t_ns, {}, t.channels, t.contact != 0, {}};
  unpack(t.bodies, m.bodies);
  unpack(t.next, m.X_WB_next);
  return m;
}

rock_place_t pack(const core::RockPlace& m) {
  rock_place_t t;
  t.n_bodies = pack(m.X_WB, t.bodies);
  return t;
}
core::RockPlace unpack(const rock_place_t& t) {
  core::RockPlace m;
  unpack(t.bodies, m.X_WB);
  return m;
}

rock_step_t pack(const core::RockStep& m) {
  rock_step_t t;
  t.n_steps = m.n_steps;
  t.contact = m.contact;
  t.n_bodies = pack(m.X_WB_target, t.targets);
  return t;
}
core::RockStep unpack(const rock_step_t& t) {
  core::RockStep m{t.n_steps, {}, t.contact != 0, t.header.t_ns, t.header.step_index};
  unpack(t.targets, m.X_WB_target);
  return m;
}

rock_state_t pack(const core::RockState& m) {
  rock_state_t t;
  t.dem_step = m.step;
  t.n_bodies = pack(m.bodies, t.bodies);
  t.n_channels = static_cast<std::int32_t>(m.channels.size());
  t.channels = m.channels;
  return t;
}
core::RockState unpack(const rock_state_t& t) {
  core::RockState m{t.dem_step, t.header.t_ns, {}, t.channels};
  unpack(t.bodies, m.bodies);
  return m;
}

command_t pack(const core::Command& m) {
  command_t t;
  t.action = static_cast<std::int32_t>(m.action);
  t.file = m.file;
  return t;
}

core::Command unpack(const command_t& t) {
  if (t.action < 1 || t.action > 6) {
    throw DecodeError(fmt::format("unknown command {}", t.action));
  }
  return {static_cast<core::Action>(t.action), t.file};
}

status_t pack(const core::Status& m) {
  status_t t;
  t.ok = m.ok;
  t.text = m.text;
  return t;
}

core::Status unpack(const status_t& t) { return {t.ok != 0, t.text}; }

/// LCM puts an 8-byte fingerprint of the type in front, big-endian.
std::int64_t fingerprint(const std::string& bytes) {
  std::int64_t hash = 0;
  for (int k = 0; k < 8; ++k) hash = (hash << 8) | static_cast<unsigned char>(bytes[k]);
  return hash;
}

/// Whether bytes are as long as the lengths in them say. LCM's decoder trusts those: it makes
/// room for a list before it looks for its bytes, and a text of less than no letters it copies from
/// wherever that leads. So it is given nothing that has not been walked through first.
class LengthCheck {
 public:
  explicit LengthCheck(const std::string& bytes) : bytes_(bytes) {
    skip(8 + sizeof header_t::mac);  // fingerprint
    text();                          // run_id
    text();                          // case_hash
    skip(3 * 8);                     // step_index, sequence, t_ns
  }
  LengthCheck& skip(std::size_t n) {
    if (n > bytes_.size() - at_) sound_ = false;
    if (sound_) at_ += n;
    return *this;
  }
  LengthCheck& text() {
    const std::size_t n = count();
    if (n == 0) sound_ = false;  // its NUL is counted
    return skip(n);
  }
  LengthCheck& list(std::size_t doubles) {
    const std::size_t n = count();
    if (n > bytes_.size()) sound_ = false;
    return skip(sound_ ? 8 * doubles * n : 0);
  }
  bool ends() const { return sound_ && at_ == bytes_.size(); }

 private:
  std::size_t count() {
    const std::size_t from = at_;
    skip(4);
    if (!sound_) return 0;
    std::size_t n = 0;
    for (std::size_t k = from; k < at_; ++k) n = (n << 8) | static_cast<unsigned char>(bytes_[k]);
    return n;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
  bool sound_ = true;
};

// As in coupler/lcm/dipper_msg.lcm.
constexpr std::size_t kPose = 7, kTwist = 6, kWrench = 6;  // doubles
bool is_whole(const std::string& bytes, const machine_step_t*) {
  return LengthCheck(bytes).skip(8).list(kWrench).ends();
}
bool is_whole(const std::string& bytes, const machine_state_t*) {
  return LengthCheck(bytes).skip(8 + 1).list(kPose + kTwist).list(kPose).list(1).ends();
}
bool is_whole(const std::string& bytes, const rock_place_t*) {
  return LengthCheck(bytes).list(kPose).ends();
}
bool is_whole(const std::string& bytes, const rock_step_t*) {
  return LengthCheck(bytes).skip(8 + 1).list(kPose).ends();
}
bool is_whole(const std::string& bytes, const rock_state_t*) {
  return LengthCheck(bytes).skip(8).list(2 * kWrench + kPose).list(1).ends();
}
bool is_whole(const std::string& bytes, const command_t*) {
  return LengthCheck(bytes).skip(4).text().ends();
}
bool is_whole(const std::string& bytes, const status_t*) {
  return LengthCheck(bytes).skip(1).text().ends();
}

template <class Type>
bool decode_as(const std::string& bytes, core::Message& m) {
  if (fingerprint(bytes) != Type::getHash()) return false;
  Type t;
  const int size = static_cast<int>(bytes.size());
  if (!is_whole(bytes, &t) || t.decode(bytes.data(), 0, size) != size) {
    throw DecodeError(
        fmt::format("a {} of {} bytes is cut short or too long, or has a length in it "
                    "that is",
                    Type::getTypeName(), bytes.size()));
  }
  m.envelope = unpack(t.header);
  m.body = unpack(t);
  return true;
}

}  // namespace

std::string encode(const core::Message& m) {
  return std::visit(
      [&](const auto& body) {
        auto t = pack(body);
        t.header = pack(m.envelope);
        std::string bytes(t.getEncodedSize(), '\0');
        t.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
        return bytes;
      },
      m.body);
}

core::Message decode(const std::string& bytes) {
  if (bytes.size() < 8) throw DecodeError("a message of less than 8 bytes");
  core::Message m;
  if (decode_as<machine_step_t>(bytes, m) || decode_as<machine_state_t>(bytes, m) ||
      decode_as<rock_place_t>(bytes, m) || decode_as<rock_step_t>(bytes, m) ||
      decode_as<rock_state_t>(bytes, m) || decode_as<command_t>(bytes, m) ||
      decode_as<status_t>(bytes, m)) {
    return m;
  }
  throw DecodeError("a message of a type this version does not know");
}

}  // namespace dipper::transport
