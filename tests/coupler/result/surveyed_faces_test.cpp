#include "coupler/result/surveyed_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/height_map.hpp"
#include "common/input_error.hpp"
#include "common/temporary_folder.hpp"
#include "common/text_file.hpp"

namespace dipper::result {
namespace {

namespace fs = std::filesystem;
using analysis::signals::DriveSignals;
using analysis::signals::Pass;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A slope of 0.5 from x = 14 on, `lower_m` lower in the half y > 0.
void write_face(const fs::path& folder, int number, double t_s, double lower_m) {
  HeightMap map(face_grid(12, 26, -8, 8));
  for (int i = 0; i < map.grid().nx; ++i)
    for (int j = 0; j < map.grid().ny; ++j)
      map.at(i, j) = std::max(0.0, 0.5 * (map.x_of(i) - 14) - (map.y_of(j) > 0 ? lower_m : 0));
  nlohmann::json j = nlohmann::json::parse(to_json_text(map));
  j["t_s"] = t_s;
  j["axis_m"] = {1.0, 0.0};
  write_text(face_file(folder, number), j.dump());
}

/// Two passes of 10 s, the first dug at +0.3 rad, the second at -0.3.
DriveSignals two_passes() {
  DriveSignals s;
  for (int k = 0; k <= 200; ++k) {
    const double t = 0.1 * k, in_pass = std::fmod(t, 10.0), side = t < 10 ? 0.3 : -0.3;
    s.time_s.push_back(t);
    s.crowd_m.push_back(std::min(in_pass, 5.0));
    s.swing_rad.push_back(in_pass < 7 ? side : 1.5);
  }
  return s;
}

class SurveyedFaces : public testing::Test {
 protected:
  SurveyedFaces() {
    write_face(place_, 0, 0, 0);
    write_face(place_, 1, 8, 2);
    write_face(place_, 2, 18, 2);
    passes_[0].t_end_s = 10;
    passes_[1].t_start_s = 10;
    passes_[1].t_end_s = 20;
    for (Pass& p : passes_) p.dumped = true;
  }
  TemporaryFolder scratch_{"surveyed-faces"};
  fs::path place_ = scratch_.path();
  std::vector<Pass> passes_ = std::vector<Pass>(2);
};

TEST_F(SurveyedFaces, AreCutWhereEachPassDug) {
  ASSERT_TRUE(write_profiles(place_, two_passes(), passes_, place_));
  const std::string text = read(place_ / "profile.csv");
  EXPECT_EQ(text.rfind("pass,x_m,z_m,after\n", 0), 0U);
  const auto height = [&](int pass, int after) {  // 15 m from the axis, along the boom
    std::istringstream rows(text);
    for (std::string row; std::getline(rows, row);) {
      int of = 0, when = 0;
      double x = 0, z = 0;
      if (std::sscanf(row.c_str(), "%d,%lf,%lf,%d", &of, &x, &z, &when) == 4 && of == pass &&
          when == after && std::abs(x - 15) < 1e-6)
        return z;
    }
    return -1.0;
  };
  const double face = 0.5 * (1 + 15 * std::cos(0.3) - 14);
  EXPECT_NEAR(height(1, 0), face, 0.15);
  EXPECT_NEAR(height(1, 1), std::max(0.0, face - 2), 0.15);  // the half that the first pass dug
  EXPECT_NEAR(height(2, 0), face, 0.15);                     // the other is as it was
  EXPECT_NEAR(height(2, 1), face, 0.15);
}

TEST_F(SurveyedFaces, StopWhereAPassHasNotDumped) {
  passes_[1].dumped = false;
  ASSERT_TRUE(write_profiles(place_, two_passes(), passes_, place_));
  EXPECT_EQ(read(place_ / "profile.csv").find("\n2,"), std::string::npos);
  EXPECT_FALSE(write_profiles(place_ / "none", two_passes(), passes_, place_));
}

TEST_F(SurveyedFaces, ARunThatGoesOnKeepsTheEarlierOnes) {
  EXPECT_EQ(keep_faces_until(place_, 9), 2);
  EXPECT_FALSE(fs::exists(face_file(place_, 2)));
  write_text(face_file(place_, 1), "{}");
  EXPECT_THROW(keep_faces_until(place_, 9), InputError);
}

}  // namespace
}  // namespace dipper::result
