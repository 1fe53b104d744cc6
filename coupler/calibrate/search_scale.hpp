// Conversion between values of searched keys and points of a design.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coupler/calibrate/calibration.hpp"
#include "coupler/calibrate/response_surface.hpp"

namespace dipper::calibrate {

/// The ends of each range are -1 and 1.
class SearchScale {
 public:
  explicit SearchScale(const std::vector<SearchRange>& ranges) : ranges_(ranges) {}

  std::vector<std::pair<std::string, double>> values(const Point& x) const {
    std::vector<std::pair<std::string, double>> out;
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      out.emplace_back(ranges_[i].key, middle(i) + half(i) * x[static_cast<Eigen::Index>(i)]);
    return out;
  }
  Point point(const std::vector<double>& values) const {
    Point x(static_cast<Eigen::Index>(ranges_.size()));
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      x[static_cast<Eigen::Index>(i)] = (values[i] - middle(i)) / half(i);
    return x;
  }
  double half(std::size_t i) const { return (ranges_[i].high - ranges_[i].low) / 2; }

 private:
  double middle(std::size_t i) const { return (ranges_[i].high + ranges_[i].low) / 2; }
  std::vector<SearchRange> ranges_;
};

}  // namespace dipper::calibrate
