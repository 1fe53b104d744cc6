#include "coupler/deck/bench_cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace dipper::deck {

std::vector<long> over_surface(const std::vector<PileSphere>& spheres,
                               const std::function<double(double, double)>& height) {
  struct Moment {
    double volume = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
  };
  std::map<long, Moment> rocks;
  for (const PileSphere& s : spheres) {
    if (s.rock < 0) continue;
    Moment& m = rocks[s.rock];
    const double volume = std::pow(s.radius_m, 3);
    m.volume += volume;
    m.first += volume * s.centre_m;
  }
  const auto over = [&](const Eigen::Vector3d& p) { return p.z() > height(p.x(), p.y()); };
  std::vector<long> ids;
  for (const PileSphere& s : spheres) {
    const Moment* m = s.rock < 0 ? nullptr : &rocks[s.rock];
    if (over(m == nullptr ? s.centre_m : m->first / m->volume)) ids.push_back(s.id);
  }
  return ids;
}

std::string waste_group(const std::vector<long>& ids) {
  // All less all: a group that exists even when nothing is cut away.
  std::string out = "group waste subtract all all\n";
  constexpr std::size_t kLine = 100;  // LIGGGHTS reads 2048 characters a command
  for (std::size_t i = 0; i < ids.size(); ++i) {
    out += (i % kLine == 0 ? (i == 0 ? "group waste id" : "\ngroup waste id") : "");
    out += ' ' + std::to_string(ids[i]);
  }
  return out + (ids.empty() ? "" : "\n");
}

}  // namespace dipper::deck
