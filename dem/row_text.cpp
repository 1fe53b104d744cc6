#include "dem/row_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace dipper::dem {
namespace {

constexpr int kMostDecimals = 12;
constexpr double kHair = 1e-9;          // tolerance for the rounding of a logarithm
constexpr double kLargestWhole = 9e15;  // a double represents whole numbers up to 2^53

int decimals_for(double step) {
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - kHair)), 0, kMostDecimals);
}

bool one_of(const std::string& column, const std::string& stem) {
  return column.size() == stem.size() + 1 && column.compare(0, stem.size(), stem) == 0 &&
         column.back() >= 'x' && column.back() <= 'z';
}

char* put_whole(std::int64_t value, char* to) { return std::to_chars(to, to + 24, value).ptr; }

char* put_general(double value, char* to) {
  if (std::abs(value) < kLargestWhole && value == std::trunc(value))
    return put_whole(static_cast<std::int64_t>(value), to);
  return std::to_chars(to, to + 32, value, std::chars_format::general, 6).ptr;
}

/// Rounded to these decimals, without trailing zeros.
char* put_fixed(double value, int decimals, char* to) {
  static const std::array<double, kMostDecimals + 1> powers = {1e0, 1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                                               1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
  const double scaled = value * powers[static_cast<std::size_t>(decimals)];
  if (!(std::abs(scaled) < kLargestWhole)) return put_general(value, to);
  std::int64_t rest = std::llround(scaled);
  if (rest < 0) *to++ = '-';
  rest = std::abs(rest);
  while (decimals > 0 && rest % 10 == 0) {
    rest /= 10;
    --decimals;
  }
  std::array<char, 24> digits{};  // padded with leading zeros up to the decimal point
  char* end = digits.data() + digits.size();
  char* first = end;
  for (int k = 0; k <= decimals || rest > 0; ++k, rest /= 10) {
    *--first = static_cast<char>('0' + rest % 10);
    if (k + 1 == decimals) *--first = '.';
  }
  return std::copy(first, end, to);
}

}  // namespace

RowText::RowText(const std::vector<std::string>& columns, double smallest_radius_m)
    : id_(static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "id") -
                                   columns.begin())) {
  const int place = decimals_for(smallest_radius_m / 500);
  const int speed = std::max(place - 1, 0);
  const int spin = decimals_for(2 * std::pow(10, -speed) / smallest_radius_m);
  for (const std::string& column : columns)
    decimals_.push_back(one_of(column, "")        ? place
                        : one_of(column, "v")     ? speed
                        : one_of(column, "omega") ? spin
                                                  : kGeneral);
}

std::string RowText::of(const std::vector<double>& rows) const {
  const std::size_t width = decimals_.size();
  std::vector<const double*> order(rows.size() / width);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = rows.data() + i * width;
  // Neighbouring rows of one rock have similar numbers.
  if (id_ < width)
    std::sort(order.begin(), order.end(),
              [&](const double* a, const double* b) { return a[id_] < b[id_]; });
  std::string text;
  text.reserve(rows.size() * 6);
  std::vector<char> line(width * 33);  // 32 of the longest number, and a blank
  for (const double* row : order) {
    char* to = line.data();
    for (std::size_t k = 0; k < width; ++k) {
      to = decimals_[k] == kGeneral ? put_general(row[k], to) : put_fixed(row[k], decimals_[k], to);
      *to++ = k + 1 < width ? ' ' : '\n';
    }
    text.append(line.data(), to);
  }
  return text;
}

}  // namespace dipper::dem
