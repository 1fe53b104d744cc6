// What a dump shows while rock is parked: all rock, and it changes nothing.
#include <gtest/gtest.h>
#include <input.h>
#include <lammps.h>
#include <update.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <sstream>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

constexpr int kSteps = 20, kSaved = 200, kWindows = 215;
constexpr const char* kColumns = "id type x y z vx vy vz omegax omegay omegaz radius density";

using Row = std::vector<double>;
using Lines = std::vector<Row>;

/// The rows of a dump, gzipped or not, by id; on rank 0.
Lines rows(const std::filesystem::path& file) {
  const auto in = gzopen(file.c_str(), "rb");
  std::string text(1 << 22, '\0');
  const int got = in == nullptr ? 0 : gzread(in, text.data(), static_cast<unsigned>(text.size()));
  if (in != nullptr) gzclose(in);
  text.resize(static_cast<std::size_t>(std::max(got, 0)));
  std::istringstream lines(text.substr(text.find('\n', text.find("ITEM: ATOMS")) + 1));
  Lines found;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream row(line);
    found.push_back({std::istream_iterator<double>(row), {}});
  }
  std::sort(found.begin(), found.end());  // by id
  return found;
}

/// Whether two dumps have the same rows: positions to 0.1 mm, all else to 0.01 of its unit.
bool alike(const Lines& a, const Lines& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Row& p, const Row& q) {
    for (std::size_t k = 0; k < p.size(); ++k)
      if (std::abs(p[k] - q.at(k)) > (k >= 2 && k < 5 ? 1e-4 : 0.01)) return false;
    return p.size() == q.size();
  });
}

/// Rock falls into a bin and comes to rest, and a paddle goes down into it at 2 m/s.
class Scenario {
 public:
  explicit Scenario(const std::string& kind) : scene_("rock_dump"), kind_(kind) {}

  /// \param modify  of the dump; "": none
  std::unique_ptr<LiggghtsRock> begin(bool dump, const std::string& modify = "") {
    auto rock = std::make_unique<LiggghtsRock>(setup(), MPI_COMM_WORLD);
    if (dump) add_dump(*rock, modify);
    rock->place({paddle(0)});
    info = rock->info();
    return rock;
  }
  std::unique_ptr<LiggghtsRock> resume(const core::BodyLoad& at) {
    setup::RockSetup s = setup();
    s.variables.insert(s.variables.begin(), {"resumed", kind_ == "spheres" ? "1" : "2"});
    s.variables.push_back({"restart", saved().string()});
    s.resumed = {{at.end, {Vector3d(0, 0, -2.0), Vector3d::Zero()}}};
    s.image = setup::image_of(saved());
    auto rock = std::make_unique<LiggghtsRock>(s, MPI_COMM_WORLD);
    add_dump(*rock, "");
    rock->place({at.X_WB});
    return rock;
  }
  core::RockState step(LiggghtsRock& rock, int window) const {
    const auto done = rock.liggghts().update->ntimestep;  // the deck may have begun with a step
    return rock.step({window * kSteps - done, {paddle(window)}});
  }
  double parked(const core::RockState& s) const {
    return s.channels[core::channel_index(info, "rock_parked")];
  }
  Lines frame(int window) const {
    const std::filesystem::path text = file(std::to_string(window * kSteps));
    const std::filesystem::path packed = text.string() + ".gz";
    return rows(std::filesystem::exists(packed) ? packed : text);
  }
  /// What LIGGGHTS writes when all rock is in it.
  Lines all(LiggghtsRock& rock) const {
    rock.state_hash();
    const std::string command = "write_dump all custom " + file("all").string() + " " + kColumns;
    rock.liggghts().input->one(command.c_str());
    return rows(file("all"));
  }
  std::filesystem::path saved() const { return scene_.folder() / "rock.restart"; }
  core::ServerInfo info;  ///< once begun

 private:
  static Pose paddle(int windows) {
    return {Quaterniond::Identity(), Vector3d(0.05, 0, 1.6 - 2.0 * windows * kSteps * 1e-4)};
  }
  std::filesystem::path file(const std::string& step) const {
    return scene_.folder() / ("frame_" + step + ".dump");
  }
  void add_dump(LiggghtsRock& rock, const std::string& modify) const {
    LAMMPS_NS::Input& input = *rock.liggghts().input;
    const std::string every = std::to_string(5 * kSteps);
    input.one(
        ("dump frames all custom " + every + " " + file("*").string() + " " + kColumns).c_str());
    if (!modify.empty()) input.one(("dump_modify frames " + modify).c_str());
  }
  setup::RockSetup setup() const {
    setup::RockSetup s = scene_.bed(kind_);
    s.hold = test::lively_hold();
    return s;
  }

  test::Scene scene_;
  std::string kind_;
};

class RockDump : public testing::TestWithParam<const char*> {};

TEST_P(RockDump, ShowsAllRockAndChangesNothing) {
  Scenario scenario(GetParam());
  std::string plain;
  {
    const auto rock = scenario.begin(false);
    for (int k = 1; k <= kWindows; ++k) scenario.step(*rock, k);
    plain = rock->state_hash();
  }
  core::RockState at;
  Lines saved, end;
  {
    const auto rock = scenario.begin(true);
    for (int k = 1; k <= kSaved; ++k) at = scenario.step(*rock, k);
    rock->save(scenario.saved());
    ASSERT_GT(scenario.parked(at), 0);
    saved = scenario.frame(kSaved);
    core::RockState s;
    for (int k = kSaved + 1; k <= kWindows; ++k) s = scenario.step(*rock, k);
    ASSERT_GT(scenario.parked(s), 0);
    end = scenario.frame(kWindows);
    EXPECT_EQ(rock->state_hash(), plain);
    const Lines all = scenario.all(*rock);
    if (test::rank() == 0) {
      EXPECT_GT(all.size(), 100u);
      EXPECT_TRUE(alike(end, all));
    }
  }
  const auto rock = scenario.resume(at.bodies[0]);
  for (int k = kSaved + 1; k <= kWindows; ++k) scenario.step(*rock, k);
  EXPECT_TRUE(scenario.frame(kSaved) == saved) << "of the checkpoint";
  EXPECT_TRUE(scenario.frame(kWindows) == end) << "after a checkpoint";
}

TEST_P(RockDump, BringsAllRockBackForADumpThatItCannotStandInFor) {
  Scenario scenario(GetParam());
  const auto rock = scenario.begin(true, "sort id");
  double most = 0;
  core::RockState s;
  for (int k = 1; k <= kWindows; ++k) {
    s = scenario.step(*rock, k);
    most = std::max(most, scenario.parked(s));
  }
  ASSERT_GT(most, 0);
  EXPECT_EQ(scenario.parked(s), 0) << "the last window has a frame";
  const Lines end = scenario.frame(kWindows), all = scenario.all(*rock);
  EXPECT_TRUE(end == all);
}

INSTANTIATE_TEST_SUITE_P(Rock, RockDump, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace dipper::dem
