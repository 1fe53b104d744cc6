#include "coupler/result/truck_load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dipper::result {
namespace {

using testing::HasSubstr;
using json = nlohmann::ordered_json;

json passes(const std::vector<double>& tonnes) {
  json rows = json::array();
  for (const double t : tonnes) rows.push_back({{"truck_kg", 1e3 * t}, {"dumped", true}});
  return rows;
}

TEST(TruckLoad, IsOfPassesThatWereDumpedIntoATruckThatIsRated) {
  EXPECT_FALSE(truck_load(0, passes({80})));
  EXPECT_FALSE(truck_load(220, passes({})));
  EXPECT_FALSE(truck_load(220, passes({0, 0})));
  json rows = passes({80, 75});
  rows.push_back({{"truck_kg", 1e3}, {"dumped", false}});
  const auto load = truck_load(220, rows);
  ASSERT_TRUE(load);
  EXPECT_EQ(load->passes, 2);
  EXPECT_DOUBLE_EQ(load->load_t, 155);
}

TEST(TruckLoad, IsFilledByThePassesWhoseLoadIsNearest) {
  const auto three = truck_load(220, passes({82, 80, 71}));  // 233 t
  EXPECT_EQ(three->passes_to_fill, 3);
  EXPECT_DOUBLE_EQ(three->filled_t, 233);
  EXPECT_THAT(to_text(*three), HasSubstr("3 passes fill it with 233 t, 6 % over its rated 220 t"));
  EXPECT_EQ(overload_warning(*three), "");

  const auto one = truck_load(220, passes({70}));  // 210 after three, 280 after four
  EXPECT_EQ(one->passes_to_fill, 3);
  EXPECT_DOUBLE_EQ(one->filled_t, 210);
  EXPECT_THAT(to_text(*one),
              HasSubstr("5 % under its rated 220 t, if further passes load the mean 70 t"));
  EXPECT_THAT(to_text(*one), HasSubstr("after 1 pass it has 70 t, 32 % of it"));

  const auto fourth = truck_load(220, passes({80, 80, 60, 70}));  // three were enough
  EXPECT_EQ(fourth->passes_to_fill, 3);
  EXPECT_DOUBLE_EQ(as_json(*fourth)["filled_fraction"], 1);
  EXPECT_DOUBLE_EQ(as_json(*fourth)["load_fraction"], 290.0 / 220);
}

TEST(TruckLoad, OfAPassThatIsSmallForItsTruckTakesAsManyAsItTakes) {
  const auto load = truck_load(400, passes({0.1}));
  EXPECT_EQ(load->passes_to_fill, 4000);
  EXPECT_NEAR(load->filled_t, 400, 0.05);
  EXPECT_GE(truck_load(1000, passes({1e-9}))->passes_to_fill, 1'000'000'000);
  EXPECT_EQ(truck_load(100, passes({40, 30}))->passes_to_fill, 3) << "105 t, for 70 and 140 t";
}

TEST(TruckLoad, ThatIsNotKnownIsReported) {
  EXPECT_EQ(no_truck_load(0, passes({0})), "");
  EXPECT_EQ(no_truck_load(220, passes({})), "truck.rated_t has no effect: the run has no passes");
  EXPECT_THAT(no_truck_load(220, passes({0, 0})), HasSubstr("gained nothing from 2 passes"));
  json unfinished = passes({0});
  unfinished[0]["dumped"] = false;
  EXPECT_EQ(no_truck_load(220, unfinished), "");
}

TEST(TruckLoad, IsWarnedOfAboveTenAndTwentyPercent) {
  EXPECT_EQ(overload_warning(*truck_load(100, passes({55, 54.9}))), "");
  EXPECT_THAT(overload_warning(*truck_load(100, passes({55, 56}))),
              HasSubstr("111 t after 2 passes, 111 % of its rated 100 t; by the 10/10/20 rule no "
                        "more than one load in ten"));
  EXPECT_THAT(overload_warning(*truck_load(100, passes({55, 50, 50}))),
              HasSubstr("155 t after 3 passes, 155 % of its rated 100 t; by the 10/10/20 rule no "
                        "load exceeds 120 %"));
  EXPECT_THAT(overload_warning(*truck_load(50, passes({70}))),
              HasSubstr("70 t after 1 pass, 140 %"))
      << "a truck that one pass overloads";
}

}  // namespace
}  // namespace dipper::result
