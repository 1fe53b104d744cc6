#include "coupler/run/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/input_error.hpp"
#include "common/temporary_folder.hpp"

namespace dipper::run {
namespace {

TEST(Replay, OfARunWithoutARecordingIsTheUsersMistake) {
  const TemporaryFolder run("replay");
  EXPECT_THAT([&] { replay(run.path(), "dem"); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("no recording to replay: it has no events.lcmlog")));
}

}  // namespace
}  // namespace dipper::run
