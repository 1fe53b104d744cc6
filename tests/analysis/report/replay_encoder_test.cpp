#include "analysis/report/replay_encoder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/analysis/report/synthetic_dig.hpp"

namespace dipper::analysis::report {
namespace {

/// What web/unpack.js does: the positions of every sphere after each frame.
class Decoder {
 public:
  Decoder(const ReplayEncoder& encoder, std::size_t n) : encoder_(encoder), steps_(3 * n), n_(n) {}

  void add(const std::uint8_t* planes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < n_; ++i) {
        const unsigned change =
            planes[2 * axis * n_ + i] | static_cast<unsigned>(planes[(2 * axis + 1) * n_ + i]) << 8;
        const unsigned move = (change >> 1) ^ (0u - (change & 1u));
        steps_[3 * i + axis] = static_cast<std::uint16_t>(steps_[3 * i + axis] + move);
      }
    }
    speed_.assign(planes + 6 * n_, planes + 7 * n_);
  }
  Vector3d position(std::size_t i) const {
    const Vector3d steps(steps_[3 * i], steps_[3 * i + 1], steps_[3 * i + 2]);
    return encoder_.origin_m() + steps.cwiseProduct(encoder_.step_m());
  }
  std::uint8_t speed(std::size_t i) const { return speed_[i]; }

 private:
  const ReplayEncoder& encoder_;
  std::vector<std::uint16_t> steps_;
  std::vector<std::uint8_t> speed_;
  std::size_t n_;
};

TEST(ReplayEncoder, DecodedPositionsStayWithinTheStatedError) {
  const test::SyntheticDig dig(2000, 40, 20);
  ReplayExtent extent(2000);
  ReplayFrame frame;
  for (std::size_t k = 0; k < 40; ++k) {
    dig.read(k, frame);
    for (const auto& s : frame.spheres) extent.add(s);
    extent.add_values(frame, dig.walls());
  }
  ASSERT_EQ(extent.spheres.size(), 2000u);
  ReplayEncoder encoder(extent, extent.spheres, dig.walls());
  Decoder decoder(encoder, 2000);
  const double bound = std::max(kStill_m, 0.5 * encoder.step_m().maxCoeff()) + 1e-6;
  for (std::size_t k = 0; k < 40; ++k) {
    std::vector<std::uint8_t> raw;
    dig.read(k, frame);
    encoder.encode(frame, raw);
    ASSERT_EQ(raw.size(), 7 * 2000u + 12u);
    for (std::size_t t = 0; t < 12; ++t) {  // the box's triangles: t k / 39 of 11 at most
      const double share = static_cast<double>(t * k) / (11.0 * 39);
      const double byte = share > 0 ? 1 + 254 * (1 + std::log10(share) / 5) : 0;
      EXPECT_NEAR(raw[7 * 2000 + t], byte, 0.51);
    }
    decoder.add(raw.data());
    double worst = 0;
    for (std::size_t i = 0; i < 2000; ++i) {
      const Vector3d off = decoder.position(i) - frame.spheres[i].p_m.cast<double>();
      worst = std::max(worst, off.cwiseAbs().maxCoeff());
    }
    EXPECT_LE(worst, bound) << "frame " << k;
  }
}

ReplayFrame one(std::int64_t id, float x, float v = 0) {
  ReplayFrame f;
  f.spheres.resize(1);
  f.spheres[0].id = id;
  f.spheres[0].p_m = {x, 0, 0};
  f.spheres[0].v_m_s = {v, 0, 0};
  return f;
}

TEST(ReplayEncoder, RestIsZeros) {
  ReplayExtent extent(10);
  extent.add(one(7, 0).spheres[0]);
  extent.add(one(7, 30, 2).spheres[0]);
  ReplayEncoder encoder(extent, extent.spheres, {});
  std::vector<std::uint8_t> raw;
  encoder.encode(one(7, 10), raw);
  raw.clear();
  encoder.encode(one(7, 10.0015f), raw);
  EXPECT_THAT(raw, testing::Each(0));
}

TEST(ReplayEncoder, AWholeBoxInOneFrameAndBack) {
  // The largest changes there are, either way: 65535 steps.
  ReplayExtent extent(10);
  extent.add(one(1, -5).spheres[0]);
  extent.add(one(1, 25).spheres[0]);
  ReplayEncoder encoder(extent, extent.spheres, {});
  Decoder decoder(encoder, 1);
  for (const float x : {-5.f, 25.f, -5.f, 10.f}) {
    std::vector<std::uint8_t> raw;
    encoder.encode(one(1, x), raw);
    decoder.add(raw.data());
    EXPECT_NEAR(decoder.position(0).x(), x, 0.5 * 30 / 65535 + 1e-6);
  }
}

TEST(ReplayEncoder, SpeedIsTheSquareRootOfItsShareAndAbsenceIsSaid) {
  ReplayExtent extent(10);
  extent.add(one(1, 0, 8).spheres[0]);
  extent.add(one(2, 1, 2).spheres[0]);
  ReplayEncoder encoder(extent, extent.spheres, {});
  std::vector<std::uint8_t> raw;
  encoder.encode(one(2, 1, 2), raw);
  EXPECT_EQ(raw[6 * 2 + 0], 255);  // 1 is not in this frame
  EXPECT_EQ(raw[6 * 2 + 1], 127);  // sqrt(2 / 8) of 254
}

TEST(Shown, TakesWholeRocksAndTheShareAskedFor) {
  std::size_t kept = 0;
  for (std::int64_t rock = 0; rock < 30000; ++rock) {
    ReplaySphere a, b;
    a.id = 2 * rock;
    b.id = 2 * rock + 1;
    a.rock = b.rock = rock;
    EXPECT_EQ(shown(a, 3), shown(b, 3));
    kept += shown(a, 3);
    EXPECT_TRUE(shown(a, 2) || !shown(a, 3));
  }
  EXPECT_NEAR(static_cast<double>(kept), 10000, 300);  // 3.7 sigma of a fair draw
}

TEST(ReplayExtent, KeepsToItsNumberWithTheSmallestShareThatDoes) {
  ReplayExtent few(1000);
  std::vector<ReplaySphere> all(20000);
  for (int again = 0; again < 2; ++again) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].id = static_cast<std::int64_t>(i);
      few.add(all[i]);
      ASSERT_LE(few.spheres.size(), 1000u);
    }
  }
  const auto kept = [&](std::size_t one_in) {
    return static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [&](const ReplaySphere& s) { return shown(s, one_in); }));
  };
  EXPECT_EQ(few.spheres.size(), kept(few.one_in));
  EXPECT_GT(kept(few.one_in - 1), 1000u);
}

}  // namespace
}  // namespace dipper::analysis::report
