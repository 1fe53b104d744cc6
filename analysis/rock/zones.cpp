#include "analysis/rock/zones.hpp"

#include <algorithm>
#include <array>

namespace dipper::analysis::rock {

Location location_of(const LoadRegions& regions, const Pose& X_WB, const Vector3d& p_W) {
  if (regions.dipper && regions.dipper->holds(inverse(X_WB) * p_W)) return Location::dipper;
  if (regions.truck && regions.truck->holds(inverse(regions.X_WT) * p_W)) return Location::truck;
  return Location::elsewhere;
}

void FrameSums::add(const Fragment& rock, const LoadRegions& regions, const BodyState& dipper) {
  rock_kg += rock.mass_kg;
  kinetic_energy_J += 0.5 * rock.mass_kg * rock.v_W.squaredNorm();
  if (regions.truck && regions.truck->holds(inverse(regions.X_WT) * rock.p_W))
    in_truck_kg += rock.mass_kg;
  if (!regions.dipper) return;
  const Box& load = *regions.dipper;
  const Vector3d p_B = inverse(dipper.X_WB) * rock.p_W;
  if (load.holds(p_B)) {
    const double speed = (rock.v_W - velocity_at(dipper, rock.p_W)).norm();
    const double rear = p_B.x() - load.min_m.x();
    rearmost_m = in_dipper_kg == 0 ? rear : std::min(rearmost_m, rear);
    in_dipper_kg += rock.mass_kg;
    relative_momentum += rock.mass_kg * speed;
    (speed > kFlowSpeed_m_s ? flow_kg : bulk_kg) += rock.mass_kg;
  }
  const double reach = (regions.lip_x_m - load.min_m.x()) / 2;
  const bool ahead = p_B.x() > regions.lip_x_m && p_B.x() <= regions.lip_x_m + reach &&
                     p_B.y() >= load.min_m.y() && p_B.y() <= load.max_m.y() &&
                     p_B.z() >= load.min_m.z() && p_B.z() <= load.max_m.z();
  if (ahead) ahead_kg += rock.mass_kg;
}

const char* stage_name(int stage) {
  constexpr std::array<const char*, 5> names = {"lip cuts", "flow zone grows",
                                                "flow zone reaches the rear", "dead load in front",
                                                "leaves the pile"};
  return names.at(static_cast<std::size_t>(stage - 1));
}

std::vector<Stage> find_stages(const std::vector<FrameSums>& frames, std::size_t begin,
                               std::size_t end, std::size_t leave, double depth_m) {
  std::vector<Stage> stages;
  leave = std::min(leave, end);
  const auto first = [&](std::size_t from, auto holds) {
    std::size_t k = from;
    while (k < leave && !holds(frames[k])) ++k;
    return k;
  };
  const auto within = [&](double share) {
    return [share, depth_m](const FrameSums& f) {
      return f.in_dipper_kg > 0 && f.rearmost_m <= share * depth_m;
    };
  };
  const std::size_t lip = first(begin, [](const FrameSums& f) { return f.in_dipper_kg > 0; });
  if (lip < leave) stages.push_back({1, lip});
  const std::size_t half = first(lip, within(0.5));
  if (half < leave) stages.push_back({2, half});
  const std::size_t rear = first(half, within(0.1));
  if (rear < leave) {
    stages.push_back({3, rear});
    std::size_t most = rear;
    for (std::size_t k = rear; k < leave; ++k)
      if (frames[k].ahead_kg > frames[most].ahead_kg) most = k;
    stages.push_back({4, most});
  }
  if (leave < end && !stages.empty()) stages.push_back({5, leave});
  return stages;
}

}  // namespace dipper::analysis::rock
