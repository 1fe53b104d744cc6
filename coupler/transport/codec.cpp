#include "coupler/transport/codec.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "dipper_msg/command_t.hpp"
#include "dipper_msg/status_t.hpp"
#include "dipper_msg/target_motion_t.hpp"
#include "dipper_msg/wall_wrench_t.hpp"

namespace dipper::transport {
namespace {

using namespace dipper_msg;

void put(const Vector3d& v, double (&out)[3]) { std::copy_n(v.data(), 3, out); }
void put(const Quaterniond& q, double (&out)[4]) {
  out[0] = q.w();
  out[1] = q.x();
  out[2] = q.y();
  out[3] = q.z();
}

Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
Quaterniond rotation(const double (&v)[4]) { return {v[0], v[1], v[2], v[3]}; }

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

target_motion_t pack(const core::TargetMotion& m) {
  target_motion_t t;
  t.n_steps = m.n_steps;
  t.contact = m.contact;
  t.n_bodies = static_cast<std::int32_t>(m.bodies.size());
  for (const auto& b : m.bodies) {
    body_motion_t& out = t.bodies.emplace_back();
    put(b.X_WB.p, out.p_WBo_W);
    put(b.X_WB.R, out.R_WB);
    put(b.V_WB_W.w, out.w_WB_W);
    put(b.V_WB_W.v, out.v_WBo_W);
  }
  t.n_channels = static_cast<std::int32_t>(m.channels.size());
  t.channels = m.channels;
  return t;
}

core::TargetMotion unpack(const target_motion_t& t) {
  core::TargetMotion m;
  m.n_steps = t.n_steps;
  m.contact = t.contact != 0;
  for (const auto& b : t.bodies) {
    m.bodies.push_back(
        {{rotation(b.R_WB), vector(b.p_WBo_W)}, {vector(b.w_WB_W), vector(b.v_WBo_W)}});
  }
  m.channels = t.channels;
  return m;
}

wall_wrench_t pack(const core::WallWrench& m) {
  wall_wrench_t t;
  t.dem_step = m.dem_step;
  t.commit = m.commit;
  t.n_bodies = static_cast<std::int32_t>(m.bodies.size());
  for (const auto& b : m.bodies) {
    body_wrench_t& out = t.bodies.emplace_back();
    put(b.mean.torque, out.mean_torque_Bo_W);
    put(b.mean.force, out.mean_force_Bo_W);
    put(b.end.torque, out.end_torque_Bo_W);
    put(b.end.force, out.end_force_Bo_W);
    put(b.X_WB.p, out.p_WBo_W);
    put(b.X_WB.R, out.R_WB);
  }
  t.n_channels = static_cast<std::int32_t>(m.channels.size());
  t.channels = m.channels;
  return t;
}

core::WallWrench unpack(const wall_wrench_t& t) {
  core::WallWrench m;
  m.dem_step = t.dem_step;
  m.commit = t.commit != 0;
  for (const auto& b : t.bodies) {
    m.bodies.push_back({{vector(b.mean_torque_Bo_W), vector(b.mean_force_Bo_W)},
                        {vector(b.end_torque_Bo_W), vector(b.end_force_Bo_W)},
                        {rotation(b.R_WB), vector(b.p_WBo_W)}});
  }
  m.channels = t.channels;
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
bool is_whole(const std::string& bytes, const target_motion_t*) {
  return LengthCheck(bytes).skip(8 + 1).list(3 + 4 + 3 + 3).list(1).ends();
}
bool is_whole(const std::string& bytes, const wall_wrench_t*) {
  return LengthCheck(bytes).skip(8 + 1).list(4 * 3 + 3 + 4).list(1).ends();
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
  if (decode_as<target_motion_t>(bytes, m) || decode_as<wall_wrench_t>(bytes, m) ||
      decode_as<command_t>(bytes, m) || decode_as<status_t>(bytes, m)) {
    return m;
  }
  throw DecodeError("a message of a type this version does not know");
}

}  // namespace dipper::transport
