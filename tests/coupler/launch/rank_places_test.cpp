#include "coupler/launch/rank_places.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/host_identity.hpp"
#include "common/input_error.hpp"

namespace dipper::launch {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string command(const MpiPlaces& places) {
  return fmt::format("{} ", fmt::join(mpirun(4, {"program", "config"}, places), " "));
}

/// A file for as long as a test takes.
struct File {
  File(const std::string& name, const std::string& text)
      : path(fs::temp_directory_path() / fmt::format("rank_places_{}_{}", getpid(), name)) {
    std::ofstream(path) << text;
  }
  ~File() { fs::remove(path); }
  fs::path path;
};

std::string refusal(const std::string& options) {
  try {
    mpirun_options(options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Mpirun, OnThisHostAsksNoOther) {
  const std::string here = command({});
  EXPECT_THAT(here, HasSubstr("--mca plm isolated --mca ras ^slurm,gridengine "));
  EXPECT_THAT(here, HasSubstr("--oversubscribe --bind-to core:overload-allowed "));
  EXPECT_THAT(here, HasSubstr("-np 4 program config "));
}

TEST(Mpirun, AUsersOptionsGoBeforeOurOwn) {
  const std::string here = command({{"-bind-to", "none", "-mca", "btl", "self,tcp"}, false, 1});
  EXPECT_THAT(here, HasSubstr("-bind-to none -mca btl self,tcp -np 4 "));
  EXPECT_THAT(here, Not(HasSubstr("overload-allowed")));
  EXPECT_THAT(here, Not(HasSubstr("vader ")));  // a parameter that is there twice is an error
}

TEST(Mpirun, OverHostsNothingIsSetThatHoldsForOneAlone) {
  const std::string both = command({{"--hostfile", "/hosts"}, true, 0.5});
  for (const char* local : {"oversubscribe", "bind-to", "isolated", "btl", "orte_tmpdir_base"})
    EXPECT_THAT(both, Not(HasSubstr(local)));
  EXPECT_THAT(both, HasSubstr("--hostfile /hosts -np 4 program config "));
}

TEST(RankPlaces, OptionsAreReadAsAShellReadsThem) {
  EXPECT_THAT(mpirun_options("--host h1,h2  --mca plm_rsh_agent 'ssh -p 22'"),
              ElementsAre("--host", "h1,h2", "--mca", "plm_rsh_agent", "ssh -p 22"));
  EXPECT_TRUE(mpirun_options("  ").empty());
  EXPECT_THAT(refusal("--mca plm_rsh_agent 'ssh"), HasSubstr("--mpirun: "));
}

TEST(RankPlaces, AHostfileIsReadableAndSeenFromAnyFolder) {
  const File hosts("hosts", "h1\n");
  EXPECT_THAT(mpirun_options("-hostfile " + fs::relative(hosts.path).string()),
              ElementsAre("-hostfile", fs::current_path() / fs::relative(hosts.path)));
  EXPECT_THAT(refusal("--hostfile /no/hosts"), HasSubstr("--mpirun: /no/hosts: cannot be read"));
  EXPECT_THAT(refusal("--machinefile /tmp"), HasSubstr("/tmp: cannot be read"));
}

TEST(RankPlaces, EveryRankHasToAnswer) {
  const std::string said = "a warning\nrank\t1\th2\tB\nrank\t0\th1\tA\n";
  const auto places = read_places(said, 2);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].host + places[0].network, "h1A");
  EXPECT_EQ(places[1].host + places[1].network, "h2B");
  EXPECT_TRUE(read_places(said, 3).empty());
  EXPECT_TRUE(read_places(said, 1).size() == 1);
  EXPECT_TRUE(read_places("rank\t0\th1\n", 1).empty());
}

TEST(RankPlaces, HostsAreLeftOut) {
  EXPECT_THAT(
      without_hosts({"--bind-to", "core", "--host", "h1:2", "--mca", "a", "b", "-hostfile", "f"}),
      ElementsAre("--bind-to", "core", "--mca", "a", "b"));
}

/// In place of dipper-dem: reports two ranks, whatever mpirun it is under.
std::string program(const File& script) {
  fs::permissions(script.path, fs::perms::owner_all);
  return script.path.string();
}

TEST(RankPlaces, WithoutHostsOrOptionsNothingIsStarted) {
  const PlacedRanks placed = place_ranks(2, {}, "/no/such/program");
  EXPECT_FALSE(placed.places.several_hosts);
  EXPECT_EQ(placed.places.part_here, 1);
}

TEST(RankPlaces, AnAllocationOfSeveralNodesIsLookedAt) {
  const File far("far", fmt::format("#!/bin/sh\n[ $OMPI_COMM_WORLD_RANK = 0 ] || exit 0\n"
                                    "printf 'rank\\t0\\th1\\t{}\\nrank\\t1\\th2\\tB\\n'\n",
                                    network_identity()));
  setenv("NHOSTS", "2", 1);  // of Grid Engine, which mpirun finds is not there
  const PlacedRanks placed = place_ranks(2, {"--oversubscribe"}, program(far));
  unsetenv("NHOSTS");
  EXPECT_TRUE(placed.places.several_hosts);
  EXPECT_EQ(placed.places.part_here, 0.5);
  EXPECT_EQ(placed.hosts, "h1 (1 rank), h2 (1 rank)");
}

TEST(RankPlaces, TheFirstRankStaysBesideTheLauncher) {
  const File away("away", "#!/bin/sh\nprintf 'rank\\t0\\th2\\tB\\n'\n");
  try {
    place_ranks(1, {"--bind-to", "none"}, program(away));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("rank 0 is on h2, but must be on this host, " + host_name()));
  }
}

TEST(RankPlaces, WhatMpirunRefusesIsReportedInItsWords) {
  try {
    place_ranks(1, {"--nonsense"}, "/bin/true");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("--mpirun: mpirun: Error: unknown option \"--nonsense\""));
  }
}

}  // namespace
}  // namespace dipper::launch
