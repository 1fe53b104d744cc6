// A dig that nobody computed: rocks on a grid, a dipper that lifts those it meets. Any size, the
// same every time, made frame by frame.
#pragma once

#include <cmath>

#include "analysis/report/replay_source.hpp"
#include "tests/common/mesh/shapes.hpp"

namespace dipper::test {

class SyntheticDig : public analysis::report::ReplaySource {
 public:
  /// `noise_m` is how far rocks at rest tremble, about what contacts leave.
  SyntheticDig(std::size_t spheres, std::size_t frames, double duration_s, double noise_m = 1e-4)
      : spheres_(spheres), noise_m_(noise_m) {
    walls_ = {{"dipper", box({0, -2, -1.5}, {4, 2, 1.5}), {"normal_stress_average"}},
              {"door", box({-0.2, -2, -1.5}, {0, 2, 1.5}), {}}};
    for (std::size_t k = 0; k < frames; ++k) {
      times_.push_back(duration_s * static_cast<double>(k) / static_cast<double>(frames - 1));
    }
  }

  const std::vector<analysis::report::ReplayWall>& walls() const override { return walls_; }
  const std::vector<double>& times_s() const override { return times_; }

  /// The dipper crosses the pile from x = 0 to x = 20 m, rising by 8 m.
  BodyState dipper(double t) const {
    const double T = times_.back();
    BodyState s;
    s.X_WB.p = {20 * t / T, 0, 2 + 8 * t / T};
    s.V_WB_W.v = {20 / T, 0, 8 / T};
    return s;
  }

  /// Of the dipper's triangles the k-th is pressed with k t; the door has no field.
  void read(std::size_t index, analysis::report::ReplayFrame& frame,
            const Keep& keep = all) const override {
    const double t = times_.at(index);
    frame.time_s = t;
    frame.walls = {dipper(t), dipper(t)};
    frame.values = {{{}}, {}};
    for (std::size_t k = 0; k < walls_[0].mesh.triangles.size(); ++k)
      frame.values[0][0].push_back(static_cast<float>(static_cast<double>(k) * t));
    frame.spheres.clear();
    const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(spheres_))));
    const double pitch = 16.0 / static_cast<double>(side);
    for (std::size_t i = 0; i < spheres_; ++i) {
      analysis::report::ReplaySphere s;
      s.id = static_cast<std::int64_t>(i) + 1;
      s.rock = i % 3 == 0 ? -1 : static_cast<std::int64_t>(i / 6);
      s.type = 1 + static_cast<int>(i % 4);
      s.radius_m = static_cast<float>(0.5 * pitch);
      const std::size_t layer = i / side / side;
      const Vector3d rest(4 + pitch * static_cast<double>(i % side),
                          -8 + pitch * static_cast<double>(i / side % side),
                          pitch * (0.5 + static_cast<double>(layer)));
      // The dipper takes what is in its way from the moment it gets there; it tumbles inside.
      const double T = times_.back(), met = T * (rest.x() - 2) / 20;
      Vector3d p = rest;
      Vector3d v = Vector3d::Zero();
      if (t > met && std::abs(rest.y()) < 2 && rest.z() < 5) {
        const double a = 3 * (t - met) + static_cast<double>(i % 7);
        p += dipper(t).X_WB.p - dipper(met).X_WB.p +
             0.3 * Vector3d(std::sin(a), std::cos(a), std::sin(2 * a));
        v = dipper(t).V_WB_W.v + 0.9 * Vector3d(std::cos(a), -std::sin(a), 2 * std::cos(2 * a));
      } else {
        const double a = static_cast<double>(i * 31 + index * 17);
        p += noise_m_ * Vector3d(std::sin(a), std::cos(1.3 * a), std::sin(2.1 * a));
      }
      s.p_m = p.cast<float>();
      s.v_m_s = v.cast<float>();
      if (keep(s)) frame.spheres.push_back(s);
    }
  }

 private:
  static bool all(const analysis::report::ReplaySphere&) { return true; }

  std::size_t spheres_;
  double noise_m_;
  std::vector<analysis::report::ReplayWall> walls_;
  std::vector<double> times_;
};

}  // namespace dipper::test
