#include "mbs/snapshot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace dipper::mbs {
namespace {

// The file: 8 bytes; the kind of drives, behind its length; the sizes of q, u, works, operator and
// rope; then time, q, u, works, operator, rope and wrenches as they are in memory: a checkpoint can
// be read only on the kind of machine that wrote it.
// Rows that the motion has gone on with follow, behind their length, where there are any.
constexpr char kMagic[] = "DIPMBS02";
constexpr std::uint64_t kMostKind = 64;       // bytes
constexpr std::uint64_t kMostRows = 1 << 26;  // bytes: a day's motion is shorter

template <typename T>
void put(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}
template <typename T>
void get(std::istream& in, T& value) {
  in.read(reinterpret_cast<char*>(&value), sizeof value);
}

void put_text(std::ostream& out, const std::string& text) {
  put(out, static_cast<std::uint64_t>(text.size()));
  out << text;
}

/// Of at least a byte and at most `most`; otherwise the stream fails.
std::string get_text(std::istream& in, std::uint64_t most) {
  std::uint64_t size = 0;
  get(in, size);
  if (size == 0 || size > most) in.setstate(std::ios::failbit);
  std::string text(in ? size : 0, ' ');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
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

std::array<std::int64_t, 5> sizes(const Snapshot& s) {
  return {s.numbers.q.size(), s.numbers.u.size(), s.numbers.works.size(),
          static_cast<std::int64_t>(s.sender.size()), s.numbers.rope.size()};
}

}  // namespace

void save(const Snapshot& s, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(kMagic, 8);
  put_text(out, s.drives);
  put(out, sizes(s));
  put(out, s.t_ns);
  each_number(s, [&](const double& x) { put(out, x); });
  if (!s.rows.empty()) put_text(out, s.rows);
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
  if (!in || std::memcmp(magic, kMagic, sizeof magic) != 0)
    fail(fmt::format("is not a saved shovel of this version: it does not begin with {}", kMagic));
  const std::string drives = get_text(in, kMostKind);
  if (!in) fail("ends too early");
  if (drives != like.drives)
    fail(fmt::format("was saved with drives of another kind: {}; this run's are {}", drives,
                     like.drives));
  std::array<std::int64_t, 5> n{};
  get(in, n);
  if (!in || n != sizes(like)) {
    fail(
        fmt::format("holds {} coordinates, speeds, works, numbers of the operator and of the "
                    "ropes; this shovel has {}",
                    fmt::join(n, ", "), fmt::join(sizes(like), ", ")));
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
    s.rows = get_text(in, kMostRows);
    if (in.eof()) fail("ends too early");
    if (!in) fail("is longer than a saved shovel");
  }
  if (in.peek() != std::ifstream::traits_type::eof()) fail("is longer than a saved shovel");
  if (s.t_ns < 0 || !finite) fail("holds a negative time or numbers that are not finite");
  return s;
}

}  // namespace dipper::mbs
