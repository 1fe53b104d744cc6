#include "analysis/metrics/frame_survey.hpp"

namespace dipper::analysis::metrics {
namespace {

struct Lifted {
  double mass_kg = 0;
  bool found = false;
};

/// One load that is being followed.
struct Following {
  LoadToFollow load;
  std::unordered_map<std::int64_t, Lifted> rocks;
  double truck_before_kg = 0;
  LoadFate fate;
};

void take(Following& f, const rock::Fragment& rock) {
  f.rocks[rock.key].mass_kg = rock.mass_kg;
  f.fate.lifted_kg += rock.mass_kg;
  f.fate.class_kg[rock.type] += rock.mass_kg;
}

void look(Following& f, const rock::Fragment& rock, rock::Location place, const Footprint& pile) {
  const auto at = f.rocks.find(rock.key);
  if (at == f.rocks.end()) return;
  at->second.found = true;
  if (place == rock::Location::truck) {
    f.fate.truck_kg += rock.mass_kg;
  } else if (place == rock::Location::dipper) {
    f.fate.carry_back_kg += rock.mass_kg;
  } else {
    (pile.holds(rock.p_W) ? f.fate.back_in_pile_kg : f.fate.spillage_kg) += rock.mass_kg;
  }
}

void finish(Following& f, double truck_kg) {
  for (const auto& [key, rock] : f.rocks)
    if (!rock.found) f.fate.spillage_kg += rock.mass_kg;
  f.fate.truck_from_elsewhere_kg = truck_kg - f.truck_before_kg - f.fate.truck_kg;
}

}  // namespace

void Footprint::add(const Vector3d& p) {
  min = min.cwiseMin(p.head<2>());
  max = max.cwiseMax(p.head<2>());
}

bool Footprint::holds(const Vector3d& p) const {
  return (p.head<2>().array() >= min.array()).all() && (p.head<2>().array() <= max.array()).all();
}

Survey survey_frames(const io::DumpFolder& dumps, const rock::ClumpMasses& clumps,
                     const rock::LoadRegions& regions, const rock::PoseTrack& dipper,
                     const std::vector<LoadToFollow>& loads) {
  Survey s;
  std::vector<Following> all;
  for (const LoadToFollow& load : loads) all.push_back({load, {}, 0, {}});
  for (std::size_t k = 0; k < dumps.frames.size(); ++k) {
    const BodyState body = dipper.empty() ? BodyState{} : dipper.at(dumps.time_s[k]);
    rock::FrameSums sums;
    std::size_t rocks = 0;
    rock::for_each_fragment(dumps.frames[k], clumps, [&](const rock::Fragment& rock) {
      sums.add(rock, regions, body);
      ++rocks;
      const rock::Location place = rock::location_of(regions, body.X_WB, rock.p_W);
      if (k == 0) {
        if (place == rock::Location::elsewhere) s.pile.add(rock.p_W);
        ClassSums& c = s.classes[rock.type];
        c.mass_kg += rock.mass_kg;
        if (rock.density_kg_m3 > 0) c.volume_m3 += rock.mass_kg / rock.density_kg_m3;
        ++c.rocks;
      }
      for (Following& f : all) {
        if (k == f.load.lift_frame && place == rock::Location::dipper) take(f, rock);
        if (k == f.load.end_frame) look(f, rock, place, s.pile);
      }
    });
    for (Following& f : all) {
      if (k == f.load.start_frame) f.truck_before_kg = sums.in_truck_kg;
      if (k == f.load.end_frame) finish(f, sums.in_truck_kg);
    }
    s.frames.push_back(sums);
    s.rocks = rocks;
    s.spheres = dumps.frames[k].particles;
  }
  for (Following& f : all) s.fates.push_back(std::move(f.fate));
  return s;
}

}  // namespace dipper::analysis::metrics
