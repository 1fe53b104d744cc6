#include "analysis/metrics/load_in_dipper.hpp"

#include <algorithm>

#include "analysis/metrics/pile_surface.hpp"
#include "analysis/rock/load.hpp"

namespace dipper::analysis::metrics {
namespace {

constexpr double kLoadCell_m = 0.05;

}  // namespace

std::size_t frame_before(const io::DumpFolder& dumps, double t) {
  const auto after = std::upper_bound(dumps.time_s.begin(), dumps.time_s.end(), t + 1e-9);
  return after == dumps.time_s.begin() ? 0
                                       : static_cast<std::size_t>(after - dumps.time_s.begin()) - 1;
}

std::size_t lift_frame(const io::DumpFolder& dumps, const signals::PassPhases& pass) {
  const signals::Phase* swing = pass.phase(signals::PhaseName::swing);
  return frame_before(dumps, swing != nullptr ? swing->t_start_s : pass.pass.t_dump_s);
}

std::optional<LoadInDipper> load_in_dipper(const io::DumpFolder& dumps,
                                           const rock::ClumpMasses& clumps,
                                           const rock::LoadRegions& regions,
                                           const rock::PoseTrack& dipper,
                                           const signals::PassPhases& pass) {
  if (!regions.dipper || dumps.time_s[lift_frame(dumps, pass)] < pass.pass.t_dig_s)
    return std::nullopt;
  const std::size_t k = frame_before(dumps, pass.pass.t_dump_s);
  const Pose X_WB = dipper.at(dumps.time_s[k]).X_WB;
  LoadInDipper load;
  rock::for_each_fragment(dumps.frames[k], clumps, [&](const rock::Fragment& rock) {
    if (location_of(regions, X_WB, rock.p_W) == rock::Location::dipper)
      load.mass_kg += rock.mass_kg;
  });
  const Vector3d up_B = X_WB.R.conjugate() * Vector3d::UnitZ();
  load.volume_m3 = rock::load_volume(balls_in(dumps.frames[k], *regions.dipper, X_WB), up_B,
                                     *regions.dipper, kLoadCell_m);
  if (load.mass_kg <= 0 || load.volume_m3 <= 0) return std::nullopt;
  return load;
}

}  // namespace dipper::analysis::metrics
