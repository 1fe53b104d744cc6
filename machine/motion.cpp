#include "machine/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "common/input_error.hpp"
#include "common/numbers.hpp"
#include "common/seconds.hpp"

namespace dipper::machine {
namespace {

constexpr std::string_view kHeader = "time_s,hoist_m,crowd_m,swing_deg,door_deg";
constexpr std::array<std::string_view, 5> kColumns = {"time_s", "hoist_m", "crowd_m", "swing_deg",
                                                      "door_deg"};
constexpr double kRadPerDeg = 0.017453292519943295;
constexpr double kLongest_s = 1e6;  // int64 nanoseconds hold it 9000 times over

std::string_view trim(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

/// One field of a row, and the 1-based column of its first character.
struct Field {
  std::string_view text;
  std::size_t column;
};

std::vector<Field> split(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    fields.push_back({trim(line.substr(begin, comma - begin)), begin + 1});
    if (comma == line.size()) return fields;
    begin = comma + 1;
  }
}

Drives drives(const std::array<double, 4>& v) { return {v[0], v[1], v[2], v[3]}; }

}  // namespace

Motion Motion::load(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError({fmt::format("{}: cannot be opened", file.string())});
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return parse(text, file.string());
}

Motion Motion::parse(std::string_view text, const std::string& name) {
  Motion motion;
  std::vector<std::string> faults;
  const auto fault = [&](std::size_t line, std::size_t column, const std::string& message) {
    faults.push_back(fmt::format("{}:{}:{}: {}", name, line, column, message));
  };

  std::size_t line_number = 0;
  bool header_seen = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t newline = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, newline - begin);
    begin = newline + 1;
    ++line_number;
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') continue;
    if (!header_seen) {
      if (content != kHeader) {
        throw InputError({fmt::format("{}:{}:1: header is \"{}\"; it must be \"{}\"", name,
                                      line_number, content, kHeader)});
      }
      header_seen = true;
      continue;
    }

    const std::vector<Field> fields = split(line);
    if (fields.size() != kColumns.size()) {
      fault(
          line_number, line.size() + 1,
          fmt::format("{} columns; each row has {}: {}", fields.size(), kColumns.size(), kHeader));
      continue;
    }
    std::array<double, 5> row{};
    bool good = true;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (parse_number(fields[i].text, row[i])) continue;
      fault(line_number, fields[i].column,
            fmt::format("{} is \"{}\"; it must be a finite number", kColumns[i], fields[i].text));
      good = false;
    }
    if (!good) continue;
    if (std::abs(row[0]) > kLongest_s) {
      fault(line_number, 1,
            fmt::format("time_s is {}; it must be within {} s", row[0], kLongest_s));
      continue;
    }
    const std::int64_t t_ns = std::llround(row[0] * 1e9);
    if (!motion.t_ns_.empty() && t_ns <= motion.t_ns_.back()) {
      fault(line_number, 1,
            fmt::format("time_s is {}, not after the row before ({} s)", row[0],
                        seconds(motion.t_ns_.back())));
      continue;
    }
    motion.t_ns_.push_back(t_ns);
    motion.position_.push_back({row[1], row[2], row[3] * kRadPerDeg, row[4] * kRadPerDeg});
  }

  if (!header_seen) {
    fault(line_number + 1, 1, fmt::format("no header; it must be \"{}\"", kHeader));
  } else if (faults.empty() && motion.t_ns_.size() < 2) {
    fault(line_number + 1, 1,
          fmt::format("{} row(s); a motion needs at least 2", motion.t_ns_.size()));
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  motion.set_slopes();
  return motion;
}

void Motion::set_slopes() {
  const std::size_t n = t_ns_.size();
  slope_.assign(n, {});
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = seconds(t_ns_[i] - t_ns_[i - 1]);
    const double h1 = seconds(t_ns_[i + 1] - t_ns_[i]);
    for (std::size_t j = 0; j < 4; ++j) {
      const double d0 = (position_[i][j] - position_[i - 1][j]) / h0;
      const double d1 = (position_[i + 1][j] - position_[i][j]) / h1;
      if (d0 * d1 <= 0) continue;  // an extremum stays one: slope 0
      const double parabola = (h1 * d0 + h0 * d1) / (h0 + h1);
      const double most = 3 * std::min(std::abs(d0), std::abs(d1));
      slope_[i][j] = std::clamp(parabola, -most, most);
    }
  }
}

DriveState Motion::at(double t_s) const {
  const double first = seconds(t_ns_.front());
  const double last = seconds(t_ns_.back());
  if (!(t_s >= first)) return {drives(position_.front()), {}, {}};
  if (t_s >= last) return {drives(position_.back()), {}, {}};
  const auto after = std::upper_bound(t_ns_.begin() + 1, t_ns_.end() - 1, t_s,
                                      [](double t, std::int64_t row) { return t < seconds(row); });
  const auto i = static_cast<std::size_t>(after - t_ns_.begin()) - 1;

  const double h = seconds(t_ns_[i + 1] - t_ns_[i]);
  const double s = (t_s - seconds(t_ns_[i])) / h;
  std::array<double, 4> x{}, v{}, a{};
  for (std::size_t j = 0; j < 4; ++j) {
    const double d = position_[i + 1][j] - position_[i][j];
    const double m0 = h * slope_[i][j];
    const double m1 = h * slope_[i + 1][j];
    // x = x0 + m0 s + c2 s^2 + c3 s^3
    const double c2 = 3 * d - 2 * m0 - m1;
    const double c3 = m0 + m1 - 2 * d;
    x[j] = position_[i][j] + s * (m0 + s * (c2 + s * c3));
    v[j] = (m0 + s * (2 * c2 + s * 3 * c3)) / h;
    a[j] = (2 * c2 + 6 * c3 * s) / (h * h);
  }
  return {drives(x), drives(v), drives(a)};
}

std::int64_t Motion::next_row_ns(std::int64_t t_ns) const {
  const auto row = std::upper_bound(t_ns_.begin(), t_ns_.end(), t_ns);
  return row == t_ns_.end() ? std::numeric_limits<std::int64_t>::max() : *row;
}

Drives Motion::value(std::int64_t t_ns) const { return at(seconds(t_ns)).position; }
Drives Motion::rate(std::int64_t t_ns) const { return at(seconds(t_ns)).rate; }
Drives Motion::acceleration(std::int64_t t_ns) const { return at(seconds(t_ns)).acceleration; }

}  // namespace dipper::machine
