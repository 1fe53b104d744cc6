#include "analysis/metrics/suspended_load.hpp"

#include <unordered_map>

#include "common/gravity.hpp"

namespace dipper::analysis::metrics {
namespace {

constexpr double kReach_m = 1.0;  // about the longest tooth, and more than any rock's radius

bool rides(const rock::Fragment& rock, const rock::LoadRegions& regions, const BodyState& dipper) {
  return regions.dipper->grown(kReach_m).holds(inverse(dipper.X_WB) * rock.p_W) &&
         (rock.v_W - rock::velocity_at(dipper, rock.p_W)).norm() <= rock::kFlowSpeed_m_s;
}

}  // namespace

std::optional<SuspendedLoad> suspended_load(const io::DumpFolder& dumps,
                                            const rock::ClumpMasses& clumps,
                                            const rock::LoadRegions& regions,
                                            const rock::PoseTrack& dipper, double from_s,
                                            double to_s) {
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < dumps.frames.size(); ++k)
    if (dumps.time_s[k] >= from_s && dumps.time_s[k] <= to_s && dumps.frames[k].has("vz"))
      frames.push_back(k);
  if (frames.empty()) return std::nullopt;
  SuspendedLoad load;
  std::unordered_map<std::int64_t, double> first_vz;  // of the rock inside or riding
  double momentum = 0;
  for (const std::size_t k : frames) {
    const BodyState body = dipper.at(dumps.time_s[k]);
    rock::for_each_fragment(dumps.frames[k], clumps, [&](const rock::Fragment& rock) {
      const rock::Location place = rock::location_of(regions, body.X_WB, rock.p_W);
      const bool riding = place == rock::Location::elsewhere && rides(rock, regions, body);
      if (riding) load.riding_kg += rock.mass_kg / static_cast<double>(frames.size());
      if (k == frames.front() && (riding || place == rock::Location::dipper))
        first_vz[rock.key] = rock.v_W.z();
      const auto then = first_vz.find(rock.key);
      if (k == frames.back() && then != first_vz.end())
        momentum += rock.mass_kg * (rock.v_W.z() - then->second);
    });
  }
  if (frames.size() > 1)
    load.accelerating_kg =
        momentum / (dumps.time_s[frames.back()] - dumps.time_s[frames.front()]) / kGravity_m_s2;
  return load;
}

}  // namespace dipper::analysis::metrics
