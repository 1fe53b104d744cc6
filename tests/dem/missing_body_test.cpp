// A deck that lacks a body's mesh is the user's mistake: a message that names it, on every rank.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

// no_body.in has a fix `dipper` without stress, and no fix `door`.
class MissingBody : public testing::TestWithParam<const char*> {};

TEST_P(MissingBody, IsNamed) {
  const std::string body = GetParam();
  const test::Scene scene("missing_" + body);
  setup::RockSetup setup = scene.setup("no_body.in");
  const auto box = test::box(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  setup.variables.push_back({"dipper", scene.stl("dipper", box)});
  setup.bodies = {body};
  try {
    LiggghtsRock rock(setup, MPI_COMM_WORLD);
    FAIL() << "a deck without a stress mesh for the " << body;
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("no `fix " + body + " all mesh/surface/stress"));
  }
}

INSTANTIATE_TEST_SUITE_P(Deck, MissingBody, testing::Values("dipper", "door"),
                         [](const auto& body) { return std::string(body.param); });

}  // namespace
}  // namespace dipper::dem
