// A rock in a closed drum that a paddle stirs, drum and paddle both moved: nothing else touches it.
#pragma once

#include <string>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::test {

class Drum {
 public:
  /// `kind` is "spheres" or "multispheres"; the rest are further variables of drum.in.
  explicit Drum(const std::string& kind, std::vector<std::pair<std::string, std::string>> more = {})
      : scene_("drum_" + kind), rock_(setup(kind, std::move(more)), MPI_COMM_WORLD) {}

  dem::LiggghtsRock& rock() { return rock_; }
  double timestep() const { return rock_.info().timestep_s; }

  /// Drum and paddle, `t` seconds after the start. Two ranks meet at x = 0.
  static std::vector<Pose> poses(double t) {
    using Eigen::AngleAxisd;
    const Vector3d p_WD(0.9 - 0.5 * (1 - std::cos(9 * t)), 0.3 * std::sin(8 * t),
                        0.2 * std::sin(7 * t));
    const Quaterniond R_WD(AngleAxisd(0.8 * std::sin(5 * t), Vector3d::UnitZ()) *
                           AngleAxisd(0.9 * std::sin(6 * t), Vector3d::UnitY()));
    const Quaterniond R_DP(AngleAxisd(1.2 * std::sin(7 * t), Vector3d::UnitY()));
    const Vector3d p_DP(0.3 * std::sin(10 * t), 0, 0.3 - 0.5 * (1 - std::cos(4 * t)));
    return {{R_WD, p_WD}, {R_WD * R_DP, p_WD + R_WD * p_DP}};
  }

 private:
  setup::RockSetup setup(const std::string& kind,
                         std::vector<std::pair<std::string, std::string>> more) const {
    setup::RockSetup s = scene_.setup("drum.in");
    s.bodies = {"drum", "paddle"};
    s.variables.push_back({"rock", kind});
    s.variables.push_back(
        {"drum", scene_.stl("drum", test::box(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)))});
    s.variables.push_back({"paddle", scene_.stl("paddle", test::box(Vector3d(-0.1, -0.6, -0.3),
                                                                    Vector3d(0.1, 0.6, 0.4)))});
    s.variables.insert(s.variables.end(), more.begin(), more.end());
    return s;
  }

  Scene scene_;
  dem::LiggghtsRock rock_;
};

}  // namespace dipper::test
