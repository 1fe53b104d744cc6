#include "coupler/result/operator_summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/record/record.hpp"
#include "common/temporary_folder.hpp"
#include "common/text_file.hpp"

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

/// A run of an operator who plans: dumps 70 t at 30, 80, 130 ... s, looks 2 s later, digs 3 s after
/// his first motion begins and 17 s after the others do.
class OperatorSummary : public testing::Test {
 protected:
  OperatorSummary() { c_.machine.operated_by = cases::OperatorKind::plan; }

  void begin(int pass) {
    std::filesystem::create_directories(run_.decisions());
    const double looks_s = pass == 1 ? 0 : 50 * pass - 68;
    const json one = {{"t_s", looks_s},
                      {"chosen", 0},
                      {"begins_at_s", looks_s + 1},
                      {"dig_at_s", looks_s + (pass == 1 ? 4 : 18)}};
    write_text(run_.decisions() / ("pass_" + std::to_string(pass) + ".json"), one.dump());
  }
  void end(double t_s) {
    write_text(run_.decisions() / "end.json", json{{"t_s", t_s}, {"reason", "full"}}.dump());
  }
  /// 10 MJ of work a second, a row a second.
  json summary(double record_s) {
    record::Record r = record::Record::create(run_.record(), {});
    const auto time = r.add("time_s", "s", ""), truck = r.add("rock/mass_in_truck", "kg", ""),
               work = r.add("machine/drive_work", "J", "");
    for (double t = 0; t <= record_s; ++t) {
      r.put(time, t);
      r.put(truck, t < 30 ? 0 : 70e3 * (1 + std::floor((t - 30) / 50)));
      r.put(work, 10e6 * t);
      r.next();
    }
    r.flush();
    return operator_summary(c_, run_);
  }

  const TemporaryFolder folder_{"dipper-operator"};
  cases::Case c_;
  const RunFolder run_ = RunFolder::create(folder_.path() / "run");
};

TEST_F(OperatorSummary, HasACycleFromEachDumpToTheNext) {
  for (const int pass : {1, 2, 3}) begin(pass);
  end(132);
  const json s = summary(132);
  EXPECT_EQ(s.at("passes"), 3);
  EXPECT_EQ(s.at("stopped"), "full");
  EXPECT_EQ(s.at("cycles_s"), json({50.0, 50.0}));
  EXPECT_EQ(s.at("truck_kg"), 210e3);
  EXPECT_EQ(s.at("truck_s"), 132 - 3 + 17) << "the first way to the dig is as long as the others";
  EXPECT_DOUBLE_EQ(s.at("tonnes_per_hour"), 210.0 / 146 * 3600);
  EXPECT_DOUBLE_EQ(s.at("energy_J_per_kg"), 1320e6 / 210e3);
}

TEST_F(OperatorSummary, OfOnePassHasNoTimeOfACycle) {
  begin(1);
  end(32);
  const json s = summary(32);
  EXPECT_EQ(s.at("passes"), 1);
  EXPECT_EQ(s.at("cycles_s"), json::array());
  EXPECT_TRUE(s.at("truck_s").is_null());
  EXPECT_TRUE(s.at("tonnes_per_hour").is_null());
  EXPECT_DOUBLE_EQ(s.at("energy_J_per_kg"), 320e6 / 70e3);
}

TEST_F(OperatorSummary, LeavesOutAPassThatTheEndInterrupts) {
  for (const int pass : {1, 2, 3}) begin(pass);
  const json s = summary(120);
  EXPECT_EQ(s.at("passes"), 2);
  EXPECT_TRUE(s.at("stopped").is_null());
  EXPECT_EQ(s.at("cycles_s"), json({50.0}));
  EXPECT_EQ(s.at("truck_s"), 82 - 3 + 17);
  EXPECT_DOUBLE_EQ(s.at("energy_J_per_kg"), 820e6 / 140e3);
}

TEST_F(OperatorSummary, OfAFirstPassThatTheEndInterruptsHasNoFigures) {
  begin(1);
  const json s = summary(20);
  EXPECT_EQ(s.at("passes"), 0);
  EXPECT_EQ(s.at("truck_kg"), 0);
  EXPECT_TRUE(s.at("energy_J_per_kg").is_null());
}

TEST_F(OperatorSummary, SaysWhyNoPassWasBegun) {
  std::filesystem::create_directories(run_.decisions());
  end(0);
  EXPECT_EQ(summary(0), (json{{"passes", 0}, {"stopped", "full"}}));
}

TEST_F(OperatorSummary, IsNoneWhereNobodyPlans) {
  c_.machine.operated_by = cases::OperatorKind::motion;
  EXPECT_TRUE(operator_summary(c_, run_).is_null());
}

}  // namespace
}  // namespace dipper::result
