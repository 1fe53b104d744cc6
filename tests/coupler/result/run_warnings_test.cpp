#include "coupler/result/run_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/coupler/case/checkout.hpp"

namespace dipper::result {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using json = nlohmann::ordered_json;

/// Of a run in which nothing is wrong, with a change.
std::vector<std::string> warnings(const std::vector<std::pair<std::string, json>>& pass,
                                  double residual_J = 0, const std::string& status = "complete",
                                  double lost_kg = 0) {
  const test::Checkout checkout(true);  // the whole motion
  std::vector<Finding> findings;
  const cases::Case c =
      cases::load_case(checkout.folder(), {{"rock.coarse_graining_limit_m", "1"}}, findings);
  json row = {{"pass", 1},
              {"payload_kg", 7e4},
              {"truck_kg", 7e4},
              {"dig_force_mean_N", 3e6},
              {"dig_force_peak_N", 12e6},
              {"dig_force_peak_t_s", 5.5},
              {"dig_slack_fraction", 0.01}};
  for (const auto& [key, value] : pass) row[key] = value;
  return run_warnings(
      c, {{"status", status},
          {"passes", json::array({row})},
          {"dem", {{"rock_lost_kg", lost_kg}}},
          {"drives", {{"path_time_s", status == "complete" ? 1e3 : 1.0}}},
          {"coupling", {{"energy_residual_J", residual_J}, {"interface_work_J", -1e8}}}});
}

TEST(RunWarnings, SoundRunHasNone) { EXPECT_THAT(warnings({}), ElementsAre()); }

TEST(RunWarnings, SayWhatFiguresAreNoDigs) {
  EXPECT_THAT(warnings({{"dig_slack_fraction", 0.2}, {"teeth_deviation_m", 0.8}}),
              ElementsAre(HasSubstr("slack in 20 % of the dig and the teeth up to 0.8 m")));
  EXPECT_THAT(warnings({{"dig_force_peak_N", 343e6}}),
              ElementsAre(HasSubstr("peaks at 343 MN, 114 times its mean, at 5.50 s")));
  EXPECT_THAT(warnings({{"dig_rattle_fraction", 0.12}}),
              ElementsAre(HasSubstr("in 12 % of the dig the rock's force jumps")));
  EXPECT_THAT(warnings({{"crowd_beyond_fraction", 0.4}, {"hoist_beyond_fraction", 0.2}}),
              ElementsAre(HasSubstr("the crowd takes more force than the machine has in 40 %")));
  EXPECT_THAT(warnings({{"truck_kg", -28e3}}),
              ElementsAre(HasSubstr("28.0 t more leave the truck")));
  EXPECT_THAT(warnings({{"dumped", true}, {"truck_kg", 2e3}}),
              ElementsAre(HasSubstr("of 70.0 t in the dipper 2.0 t reach the truck")));
  EXPECT_THAT(warnings({{"dumped", false}}), ElementsAre(HasSubstr("pass 1: unfinished")));
  EXPECT_THAT(warnings({{"dumped", false}}, 0, "interrupted"), ElementsAre()) << "it goes on";
  EXPECT_THAT(warnings({}, 0, "complete", 27e3),
              ElementsAre(HasSubstr("27.0 t of rock left the domain")));
  EXPECT_THAT(warnings({}, -2e6), ElementsAre(HasSubstr("2.0 % of the work of 100 MJ")));
}

}  // namespace
}  // namespace dipper::result
