#include "mbs/snapshot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace dipper::mbs {
namespace {

// The file: 8 bytes, the sizes of q, u and works, then time, q, u, works, operator, rope and
// wrenches as they are in memory: a checkpoint can be read only on the kind of
// machine that wrote it.
// Rows that the motion has gone on with follow, behind their length, where there are any.
constexpr std::uint64_t kMostRows = 1 << 26;  // bytes: a day's motion is shorter
constexpr char kPrescribed[] = "DIPMBS01", kLimited[] = "DIPMBSL1";
constexpr char kSegmented[] = "DIPMBSS1", kLimitedSegmented[] = "DIPMBSB1";
// Drives that follow set points, by more numbers.
constexpr char kTold[] = "DIPMBST1", kToldSegmented[] = "DIPMBSC1";
// Drives that an operator leads who feels the dig.
constexpr char kFeeling[] = "DIPMBSF2", kFeelingSegmented[] = "DIPMBSG2";
constexpr std::size_t kFollower = 4, kFeels = 8;

const char* magic_of(const Snapshot& s) {
  if (s.sender.size() == kFeels) return s.numbers.rope.size() > 0 ? kFeelingSegmented : kFeeling;
  if (s.sender.size() > kFollower) return s.numbers.rope.size() > 0 ? kToldSegmented : kTold;
  if (s.numbers.rope.size() > 0) return s.sender.empty() ? kSegmented : kLimitedSegmented;
  return s.sender.empty() ? kPrescribed : kLimited;
}

template <typename T>
void put(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}
template <typename T>
void get(std::istream& in, T& value) {
  in.read(reinterpret_cast<char*>(&value), sizeof value);
}

/// Calls f with every number of the snapshot, in the file's order.
template <typename S, typename F>
void each_number(S& s, F f) {
  auto& n = s.numbers;
  for (int i = 0; i < kJoints; ++i) f(n.q[i]);
  for (int i = 0; i < kJoints; ++i) f(n.u[i]);
  for (int i = 0; i < n.works.size(); ++i) f(n.works[i]);
  for (auto& x : s.sender) f(x);
  for (int i = 0; i < n.rope.size(); ++i) f(n.rope[i]);
  for (auto& F_Bo_W : s.F_Bo_W) {
    for (int i = 0; i < 3; ++i) f(F_Bo_W.torque[i]);
    for (int i = 0; i < 3; ++i) f(F_Bo_W.force[i]);
  }
}

std::array<std::int64_t, 3> sizes(const Snapshot& s) {
  return {s.numbers.q.size(), s.numbers.u.size(), s.numbers.works.size()};
}

}  // namespace

void save(const Snapshot& s, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(magic_of(s), 8);
  put(out, sizes(s));
  put(out, s.t_ns);
  each_number(s, [&](const double& x) { put(out, x); });
  if (!s.rows.empty()) {
    put(out, static_cast<std::uint64_t>(s.rows.size()));
    out << s.rows;
  }
  out.flush();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

Snapshot load_snapshot(const std::filesystem::path& file, const Snapshot& like) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
  };
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("cannot be opened");
  char magic[8] = {};
  in.read(magic, sizeof magic);
  if (!in || std::memcmp(magic, magic_of(like), sizeof magic) != 0) {
    fail(fmt::format("is not a saved shovel with these drives and ropes: it does not begin with {}",
                     magic_of(like)));
  }
  std::array<std::int64_t, 3> n{};
  get(in, n);
  if (!in || n != sizes(like)) {
    fail(fmt::format("holds {} coordinates, {} speeds and {} works; this shovel has {}, {} and {}",
                     n[0], n[1], n[2], sizes(like)[0], sizes(like)[1], sizes(like)[2]));
  }
  Snapshot s = like;
  bool finite = true;
  get(in, s.t_ns);
  each_number(s, [&](double& x) {
    get(in, x);
    finite = finite && std::isfinite(x);
  });
  if (!in) fail("ends too early");
  s.rows.clear();
  if (in.peek() != std::ifstream::traits_type::eof()) {
    std::uint64_t size = 0;
    get(in, size);
    if (!in || size == 0 || size > kMostRows) fail("is longer than a saved shovel");
    s.rows.resize(size);
    in.read(s.rows.data(), static_cast<std::streamsize>(size));
    if (!in) fail("ends too early");
  }
  if (in.peek() != std::ifstream::traits_type::eof()) fail("is longer than a saved shovel");
  if (s.t_ns < 0 || !finite) fail("holds a negative time or numbers that are not finite");
  return s;
}

}  // namespace dipper::mbs
