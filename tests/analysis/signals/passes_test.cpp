#include "analysis/signals/passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace dipper::analysis::signals {
namespace {

/// Two passes of 20 s at 10 Hz: dig from 2 s with hoist 3 MN and crowd 4 MN (5 MN together, 10 MN
/// for the last second of digging), 80 t then 70 t in the dipper, dumped from 15 s to 18 s.
PassSignals two_passes() {
  PassSignals s;
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.1 * i, in_pass = i < 200 ? t : t - 20;
    const double payload = i < 200 ? 80e3 : 70e3;
    const bool dig = in_pass >= 2 && in_pass < 15, dumped = in_pass >= 16;
    const bool peak = in_pass >= 9 && in_pass < 10;
    s.time_s.push_back(t);
    s.door_rad.push_back(in_pass >= 15 && in_pass < 18 ? 1.0 : 0.0);
    s.dipper_force_N.push_back(dig ? 1e6 : 0);
    s.hoist_force_N.push_back(dig ? (peak ? 6e6 : 3e6) : 0.5e6);
    s.crowd_force_N.push_back(dig ? (peak ? -8e6 : -4e6) : 0.1e6);
    s.rope_tension_N.push_back(0.5e6);
    s.dipper_mass_kg.push_back(dig && in_pass > 12 ? payload : 0);
    s.truck_mass_kg.push_back((i >= 200 ? 80e3 : 0) + (dumped ? payload : 0));
  }
  return s;
}

TEST(Passes, FindsWhatWasLoadedAndWhatItTook) {
  const auto passes = find_passes(two_passes());
  ASSERT_EQ(passes.size(), 2u);
  const Pass& p = passes[0];
  EXPECT_EQ(p.pass, 1);
  EXPECT_NEAR(p.t_dig_s, 2, 1e-9);
  EXPECT_NEAR(p.t_dump_s, 15, 1e-9);
  EXPECT_NEAR(p.t_end_s, 18, 1e-9);
  EXPECT_NEAR(p.truck_kg, 80e3, 1e-6);
  EXPECT_NEAR(p.dig_force_mean_N, (12 * 5e6 + 1 * 10e6) / 13, 1e-3);
  EXPECT_NEAR(p.dig_force_peak_N, 10e6, 1e-6);
  EXPECT_NEAR(passes[1].t_start_s, 18, 1e-9);
  EXPECT_NEAR(passes[1].truck_kg, 70e3, 1e-6);
}

TEST(Passes, PayloadIsTheMeanOfTheLastSecondBeforeTheDoorOpens) {
  PassSignals s = two_passes();
  for (std::size_t i = 140; i <= 150; ++i) s.dipper_mass_kg[i] = 75e3;
  EXPECT_NEAR(find_passes(s)[0].payload_kg, 75e3, 1e-6);
}

TEST(Passes, ARunThatEndsBeforeTheDumpHasAnOpenPass) {
  PassSignals s = two_passes();
  for (auto* v : {&s.time_s, &s.door_rad, &s.dipper_force_N, &s.hoist_force_N, &s.crowd_force_N,
                  &s.rope_tension_N, &s.dipper_mass_kg, &s.truck_mass_kg}) {
    v->resize(130);
  }
  const auto passes = find_passes(s);
  ASSERT_EQ(passes.size(), 1u);
  EXPECT_NEAR(passes[0].t_dump_s, 12.9, 1e-9);
  EXPECT_NEAR(passes[0].truck_kg, 0, 1e-9);
}

/// two_passes() as far as `end_s`; of the second pass's 70 t, `left_kg` are in the dipper from 16 s
/// on, and the truck gains `rate_kg_s` of them from then to the end.
std::vector<Pass> ended_in_the_second_dump(double end_s, double left_kg, double rate_kg_s) {
  PassSignals s = two_passes();
  for (auto* v : {&s.time_s, &s.door_rad, &s.dipper_force_N, &s.hoist_force_N, &s.crowd_force_N,
                  &s.rope_tension_N, &s.dipper_mass_kg, &s.truck_mass_kg}) {
    v->resize(static_cast<std::size_t>(10 * end_s + 1.5));
  }
  for (std::size_t i = 350; i < s.time_s.size(); ++i) {
    const double since_s = std::max(0.0, s.time_s[i] - 36);
    s.dipper_mass_kg[i] = since_s > 0 ? left_kg : 70e3;
    s.truck_mass_kg[i] = 80e3 + rate_kg_s * since_s;
  }
  return find_passes(s);
}

TEST(Passes, ARunThatEndsInTheDumpHasNotDumped) {
  EXPECT_FALSE(ended_in_the_second_dump(35.5, 0, 0)[1].dumped) << "half a second after it opened";
  EXPECT_FALSE(ended_in_the_second_dump(37.5, 0, 20e3)[1].dumped) << "10 t arrive in half a second";
  EXPECT_FALSE(ended_in_the_second_dump(36.2, 30e3, 0)[1].dumped) << "40 t leave in half a second";
  for (const double left_kg : {0.0, 12e3})  // what sticks inside does not leave
    EXPECT_TRUE(ended_in_the_second_dump(37.5, left_kg, 100)[1].dumped) << left_kg;
  EXPECT_TRUE(ended_in_the_second_dump(37.5, 0, 20e3)[0].dumped) << "the pass before";
}

/// As two_passes(), and 5 s more with the door shut: the dipper comes home.
PassSignals with_way_home(double contact_N, double inside_kg) {
  PassSignals s = two_passes();
  for (int i = 1; i <= 50; ++i) {
    s.time_s.push_back(40 + 0.1 * i);
    s.door_rad.push_back(0);
    s.dipper_force_N.push_back(i > 30 ? contact_N : 0);
    s.hoist_force_N.push_back(0.5e6);
    s.crowd_force_N.push_back(0.1e6);
    s.rope_tension_N.push_back(0.5e6);
    s.dipper_mass_kg.push_back(i > 30 ? inside_kg : 0);
    s.truck_mass_kg.push_back(150e3);
  }
  return s;
}

TEST(Passes, TheWayHomeIsNoPassEvenWhereTheDipperRestsOnRock) {
  EXPECT_EQ(find_passes(with_way_home(0, 0)).size(), 2u);
  EXPECT_EQ(find_passes(with_way_home(50e3, 0)).size(), 2u);
  EXPECT_EQ(find_passes(with_way_home(50e3, 500)).size(), 2u);
  EXPECT_NEAR(find_passes(with_way_home(50e3, 0))[1].truck_kg, 70e3, 1e-6);
}

TEST(Passes, AThirdPassThatTheRunEndsInIsOne) {
  const auto passes = find_passes(with_way_home(1e6, 20e3));
  ASSERT_EQ(passes.size(), 3u);
  EXPECT_NEAR(passes[2].t_dig_s, 43.1, 1e-9);
}

TEST(Passes, RockThatSticksInTheDipperIsNeitherContactNorALoad) {
  PassSignals s = two_passes();
  for (double t = 40.1; t < 50; t += 0.1) {  // and the way home
    s.time_s.push_back(t);
    for (auto* v : {&s.door_rad, &s.dipper_force_N, &s.rope_tension_N, &s.hoist_force_N,
                    &s.crowd_force_N, &s.dipper_mass_kg})
      v->push_back(0);
    s.truck_mass_kg.push_back(150e3);
  }
  for (std::size_t i = 180; i < s.time_s.size(); ++i) {
    s.dipper_mass_kg[i] = std::max(s.dipper_mass_kg[i], 2.5e3);
    s.dipper_force_N[i] = std::max(s.dipper_force_N[i], 24.5e3);
  }
  const auto passes = find_passes(s);
  ASSERT_EQ(passes.size(), 2u) << "the way home is no pass";
  EXPECT_NEAR(passes[1].t_dig_s, 22, 1e-9);
  EXPECT_NEAR(passes[1].dig_force_mean_N, (12 * 5e6 + 1 * 10e6) / 13, 1e-3);
}

TEST(Passes, ADigThatBroughtNothingIsAPassWhenTheDoorOpened) {
  for (const double contact_N : {50e3, 0.0}) {
    PassSignals s = with_way_home(contact_N, 0);
    s.door_rad.back() = 1;
    EXPECT_EQ(find_passes(s).size(), 3u) << contact_N;
  }
}

TEST(Passes, ADoorThatIsOpenAtTheStartHasNotOpened) {
  PassSignals s = two_passes();
  std::fill_n(s.door_rad.begin(), 10, 1.0);
  const auto passes = find_passes(s);
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_NEAR(passes[0].t_start_s, 1, 1e-9);
  EXPECT_NEAR(passes[0].truck_kg, 80e3, 1e-6);
  const auto planned = find_planned_passes(s.time_s, s.door_rad);
  ASSERT_EQ(planned.size(), 2u);
  EXPECT_NEAR(planned[0].t_start_s, 1, 1e-9);
  std::fill(s.door_rad.begin(), s.door_rad.end(), 1.0);
  EXPECT_TRUE(find_passes(s).empty());
  EXPECT_TRUE(find_planned_passes(s.time_s, s.door_rad).empty());
}

TEST(Passes, SignalsOfDifferentLengthsAreRefused) {
  PassSignals s = two_passes();
  s.door_rad.pop_back();
  EXPECT_THROW(find_passes(s), std::invalid_argument);
}

TEST(Passes, AnEmptyRunHasNone) { EXPECT_TRUE(find_passes({}).empty()); }

}  // namespace
}  // namespace dipper::analysis::signals
