// The two decks under the plain binary: settle.in on one rank, then dig.in on one and two.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/stable_timestep.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

/// Atoms of a text dump by id, a row as its columns say.
struct Dump {
  std::map<std::string, std::size_t> column;
  std::map<int, std::vector<double>> rows;
  double get(const std::vector<double>& row, const std::string& name) const {
    return row[column.at(name)];
  }
};

Dump read_dump(const fs::path& file) {
  Dump d;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("ITEM: ATOMS ", 0) == 0) {
      std::istringstream head(line.substr(12));
      for (std::string name; head >> name;) d.column.emplace(name, d.column.size());
    } else if (!d.column.empty()) {
      std::istringstream words(line);
      std::vector<double> row;
      for (double v = 0; words >> v;) row.push_back(v);
      d.rows[static_cast<int>(row[0])] = row;
    }
  }
  return d;
}

/// A settled bench in a folder of its own: what dig.in starts from.
struct Bench {
  Bench(const std::string& name, const cases::Case& c) : folder(fresh_folder(name)) {
    write_deck(c, test::source() / "meshes/rocks", folder / "deck");
    fs::create_directories(folder / "settle");
    status = run_liggghts("dem_in/settle.in", deck(), 1, folder / "settle");
  }
  std::string deck() const { return "-var deck '" + (folder / "deck").string() + "' "; }
  Dump dig(int ranks, int steps, double timestep = tiny_case().dem.timestep_s) const {
    const fs::path out = folder / fmt::format("dig{}", ranks);
    fs::remove_all(out);
    fs::create_directories(out);
    EXPECT_EQ(
        run_liggghts(
            "dem_in/dig.in",
            deck() + fmt::format("-var pile '{}' -var run_steps {} -var dump_steps {} "
                                 "-var timestep {}",
                                 (folder / "settle/pile.restart").string(), steps, steps, timestep),
            ranks, out),
        0)
        << read_text(out / "screen.txt");
    for (const char* wall : {"dipper", "door", "truck"})
      EXPECT_TRUE(fs::exists(out / fmt::format("{}_{}.vtk", wall, steps))) << wall;
    return read_dump(out / fmt::format("rocks_{}.dump", steps));
  }
  fs::path folder;
  int status = -1;
};

class SettleAndDig : public testing::Test {
 protected:
  static const Bench& bench() {
    static const Bench bench("settle_and_dig", tiny_case());
    return bench;
  }
  static Dump dig(int ranks, int steps) { return bench().dig(ranks, steps); }
  void SetUp() override {
    ASSERT_EQ(bench().status, 0) << read_text(bench().folder / "settle/screen.txt");
  }
};

TEST_F(SettleAndDig, SettleWritesABenchOfTheWantedForm) {
  const cases::Case c = tiny_case();
  const Dump d = dig(1, 1);
  ASSERT_GT(d.rows.size(), 200U);
  double top = 0, largest = 0;
  for (const RockClass& k : rock_classes(c)) largest = std::max(largest, 2 * k.radius_m);
  std::map<int, int> by_type;
  for (const auto& [id, row] : d.rows) {
    EXPECT_GT(d.get(row, "x"), c.pile.toe_x_m - 0.5 * largest);
    EXPECT_LT(std::abs(d.get(row, "y")), c.pile.width_m / 2);
    // A rock stays when its centre does; its spheres' centres are within half its size of that.
    EXPECT_LT(d.get(row, "z"), c.pile.height_m + 0.5 * largest);
    EXPECT_GT(d.get(row, "z") - d.get(row, "radius"), -0.03);
    top = std::max(top, d.get(row, "z") + d.get(row, "radius"));
    ++by_type[static_cast<int>(d.get(row, "type"))];
  }
  EXPECT_GT(top, 0.85 * c.pile.height_m);
  EXPECT_EQ(by_type.size(), c.rock.classes.size());
}

TEST_F(SettleAndDig, RocksAreWhole) {
  const Dump d = dig(1, 1);
  std::map<int, int> spheres;
  for (const auto& [id, row] : d.rows)
    if (d.get(row, "type") > 1) ++spheres[static_cast<int>(d.get(row, "id_multisphere"))];
  EXPECT_EQ(spheres.count(-1), 0U);
  for (const auto& [body, n] : spheres) EXPECT_EQ(n, 6) << body;
}

TEST_F(SettleAndDig, OneAndTwoRanksAgree) {
  const Dump one = dig(1, 50), two = dig(2, 50);
  ASSERT_EQ(one.rows.size(), two.rows.size());
  for (const auto& [id, row] : one.rows) {
    ASSERT_EQ(two.rows.count(id), 1U) << id;
    for (const char* k : {"x", "y", "z"})
      EXPECT_NEAR(one.get(row, k), two.get(two.rows.at(id), k), 1e-6) << id;
  }
}

TEST(ChosenStep, LetsRockWithStrongTangentialDampersComeToRest) {
  cases::Case c = tiny_case();
  c.contact.tangential_damping = 3;
  c.dem.timestep_s = chosen_timestep(c);
  const Bench bench("tangential_dampers", c);
  ASSERT_EQ(bench.status, 0) << read_text(bench.folder / "settle/screen.txt");
  const Dump d = bench.dig(1, 1000, c.dem.timestep_s);
  double sum = 0;
  for (const auto& [id, row] : d.rows)
    for (const char* v : {"vx", "vy", "vz"}) sum += d.get(row, v) * d.get(row, v);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(d.rows.size())), 0.15);
}

/// Spheres a rock.
class StableStep : public testing::TestWithParam<const char*> {};

TEST_P(StableStep, IsStable) {
  // The bench at rest, for 0.4 s more: at the largest stable step it stays so; at twice that it
  // boils.
  cases::Case c = tiny_case();
  c.rock.shape_resolution = GetParam();
  const Bench bench("stable_step_" + c.rock.shape_resolution, c);
  ASSERT_EQ(bench.status, 0) << read_text(bench.folder / "settle/screen.txt");
  const double limit = stable_timestep(c);
  const auto speed = [&](double share) {
    const Dump d = bench.dig(1, static_cast<int>(0.4 / (share * limit)), share * limit);
    double sum = 0;
    for (const auto& [id, row] : d.rows)
      for (const char* v : {"vx", "vy", "vz"}) sum += d.get(row, v) * d.get(row, v);
    return std::sqrt(sum / static_cast<double>(d.rows.size()));
  };
  const double small = speed(0.3), stable = speed(1), boiling = speed(2);
  RecordProperty("rms_speeds_m_s", fmt::format("{:.3g} {:.3g} {:.3g}", small, stable, boiling));
  EXPECT_LT(stable, 1.3 * small);
  EXPECT_GT(boiling, 4 * stable);
}

INSTANTIATE_TEST_SUITE_P(SpheresARock, StableStep, testing::Values("coarse", "medium", "fine"));

}  // namespace
}  // namespace dipper::deck
