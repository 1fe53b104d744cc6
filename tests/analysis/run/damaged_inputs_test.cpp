// Text that a user can damage beside the dumps: poses, templates of rocks, the case's text. Each
// mutant is read as sound numbers or refused with its name.
#include <gmock/gmock.h>

#include <cmath>

#include "analysis/run/run_folder.hpp"
#include "tests/analysis/io/damage.hpp"

namespace dipper::analysis::run {
namespace {

constexpr int kMutants = 3000;

constexpr const char* kPoses =
    "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,5,1,0,0,0\n0.5,1.25,-2,5e0,0.6,0,0.8,0\n"
    "# the door opens\n1,2,3,4,0,0,0,1\n";

constexpr const char* kRocks =
    "fix d200_sphere spheres particletemplate/sphere 122663 atom_type 1 density constant 3000 &\n"
    "  radius constant 0.1\n"
    "fix d300_block all particletemplate/multisphere 130579 atom_type 2 density constant 3000 &\n"
    "  nspheres 6 ntry 200000 spheres file ${deck}/block.spheres scale 0.6 &\n"
    "  type 1 mass 55.5 use_density &\n  inertia_tensor 1 2 3 4 5 6\n";

constexpr const char* kCase =
    "title=\"tiny\"\nseed=1\nrock.density_kg_m3=3215\ndomain.min_m=[-12, -28, -1]\n";

/// Reads mutants of a text; `read` throws InputError for those it refuses, and returns whether what
/// it has read is sound. How many were refused.
template <typename Read>
int refused(const char* text, const std::string& name, const Read& read) {
  const Scratch s;
  int count = 0;
  std::mt19937 random(16);
  for (int k = 0; k < kMutants; ++k) {
    const auto file = s.write(name, io::damaged(text, random));
    try {
      EXPECT_TRUE(read(file)) << k << ":\n" << io::file_bytes(file);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(file.string())) << k;
      ++count;
    }
  }
  return count;
}

TEST(DamagedInputs, Poses) {
  const int n = refused(kPoses, "poses.csv", [](const auto& file) {
    const rock::PoseTrack track = read_poses(file);
    const Pose X = track.at(0.75).X_WB;
    return X.p.allFinite() && std::abs(X.R.norm() - 1) < 1e-9;
  });
  EXPECT_GT(n, kMutants / 2);
}

TEST(DamagedInputs, TemplatesOfRocks) {
  refused(kRocks, "rocks.in", [](const auto& file) {
    for (const auto& [type, kg] : rock::read_clump_masses(file))
      if (!(kg > 0) || !std::isfinite(kg)) return false;
    return true;
  });
}

TEST(DamagedInputs, TheTextOfACase) {
  refused(kCase, "case.txt", [](const auto& file) {
    const CaseLines lines = CaseLines::read(file);
    const auto density = lines.number("rock.density_kg_m3");
    lines.text("title");
    return !density || std::isfinite(*density);
  });
}

}  // namespace
}  // namespace dipper::analysis::run
