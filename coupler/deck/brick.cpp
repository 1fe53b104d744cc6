#include "coupler/deck/brick.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/text_file.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/pile_shape.hpp"

namespace dipper::deck {
namespace {

using setup::PlacedRock;

/// The same numbers with every standard library, which std::uniform_real_distribution is not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }
  /// Every turn alike (Shoemake 1992).
  Quaterniond turn() {
    const double u = between(0, 1), a = between(0, kTwoPi), b = between(0, kTwoPi);
    const double s = std::sqrt(1 - u), t = std::sqrt(u);
    return {t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)};
  }

 private:
  static constexpr double kTwoPi = 2 * 3.14159265358979323846;
  std::mt19937_64 engine_;
};

double wrapped(double x, double side) { return x - side * std::floor(x / side); }

/// Spheres in a box that repeats along x and y.
class RepeatingBox {
 public:
  RepeatingBox(double side, double height, double largest_radius)
      : side_(side),
        across_(std::max(1, static_cast<int>(side / (2 * largest_radius)))),
        up_(std::max(1, static_cast<int>(height / (2 * largest_radius)))),
        height_(height),
        cells_(static_cast<std::size_t>(across_ * across_ * up_)) {}

  bool is_free(const Sphere& s) const {
    const std::array<int, 3> at = cell(s.centre_m);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = std::max(0, at[2] - 1); k <= std::min(up_ - 1, at[2] + 1); ++k)
          for (const Sphere& other : cells_[index(at[0] + i, at[1] + j, k)]) {
            Vector3d apart = other.centre_m - s.centre_m;
            for (int axis = 0; axis < 2; ++axis)
              apart[axis] -= side_ * std::round(apart[axis] / side_);
            const double reach = other.radius_m + s.radius_m;
            if (apart.squaredNorm() < reach * reach) return false;
          }
    return true;
  }

  void add(const Sphere& s) {
    const std::array<int, 3> at = cell(s.centre_m);
    cells_[index(at[0], at[1], at[2])].push_back(s);
  }

 private:
  std::array<int, 3> cell(const Vector3d& p) const {
    const auto of = [](double x, double length, int n) {
      return std::clamp(static_cast<int>(x / length * n), 0, n - 1);
    };
    return {of(wrapped(p.x(), side_), side_, across_), of(wrapped(p.y(), side_), side_, across_),
            of(p.z(), height_, up_)};
  }
  std::size_t index(int i, int j, int k) const {
    const auto around = [&](int n) { return (n + across_) % across_; };
    return static_cast<std::size_t>((around(i) * across_ + around(j)) * up_ + k);
  }

  double side_;
  int across_, up_;
  double height_;
  std::vector<std::vector<Sphere>> cells_;
};

/// How many rocks of each kind. What one is short of a whole rock goes to the next.
std::vector<int> numbers_of(const std::vector<RockKind>& kinds, double mass_kg) {
  std::vector<int> numbers;
  double owed_kg = 0;
  for (const RockKind& kind : kinds) {
    owed_kg += mass_kg * kind.mass_fraction;
    numbers.push_back(std::max(0, static_cast<int>(std::lround(owed_kg / kind.mass_kg))));
    owed_kg -= numbers.back() * kind.mass_kg;
  }
  return numbers;
}

}  // namespace

BrickShape brick_shape(const cases::Case& c) {
  BrickShape s;
  s.number = static_cast<int>(c.seed % kBricks);
  for (const RockClass& rock : rock_classes(c))
    s.side_m = std::max(s.side_m, kSideInRocks * 2 * rock.radius_m);
  s.height_m = std::ceil(pile_shape(c).height_m);
  s.pour_height_m = s.height_m * kPourExcess * kSettledFraction / kPouredFraction;
  s.mass_kg = kPourExcess * kSettledFraction * laden_density(c) * s.side_m * s.side_m * s.height_m;
  return s;
}

void write_brick_deck(const cases::Case& c, const std::map<std::string, RockShape>& shapes,
                      const std::filesystem::path& folder) {
  const BrickShape shape = brick_shape(c);
  cases::Case rock = c;
  rock.seed = shape.number;
  rock.crust = {};  // of the dig
  rock.output.wear_m3_J = 0;
  const AtomTypes types = atom_types(rock);
  std::filesystem::create_directories(folder);
  write_rock(rock, shapes, folder);
  write_text(
      folder / "case.in",
      fmt::format("# Written by dipper from the case: what dem_in/brick.in needs of it.\n"
                  "variable timestep     index {:.9g}   # s\n"
                  "variable skin         index 0.1   # m; of the neighbour lists\n"
                  "variable xlo          index 0   # m, box\n"
                  "variable xhi          index {:.9g}   # m\n"
                  "variable ylo          index 0   # m, box\n"
                  "variable yhi          index {:.9g}   # m\n"
                  "variable zlo          index -1   # m, box\n"
                  "variable zhi          index {:.9g}   # m\n"
                  "variable types        index {}   # size classes, then the walls:\n"
                  "variable ground_type  index {}   #\n"
                  "variable cohesion     index {}   # model; moist is in dipper-liggghts only\n"
                  "variable settle_time  index {:.9g}   # s\n"
                  "{}",
                  rock.dem.timestep_s, shape.side_m, shape.side_m, shape.pour_height_m + 1,
                  types.count(), types.ground(), needs_cohesion_model(rock) ? "moist" : "off",
                  rock.pile.settle_s + rock.pile.relax_s,
                  needs_cohesion_model(rock) ? "variable bond_tension index 0   # Pa; no crust\n"
                                               "variable bond_shear   index 0   # Pa\n"
                                             : ""));
}

std::vector<PlacedRock> loose_brick(const std::vector<RockKind>& kinds, const BrickShape& shape) {
  constexpr int kTries = 200'000;
  double largest = 0;
  for (const RockKind& kind : kinds)
    for (const Sphere& sphere : kind.spheres) largest = std::max(largest, sphere.radius_m);
  RepeatingBox box(shape.side_m, shape.pour_height_m, largest);
  Draw draw(static_cast<std::uint64_t>(shape.number));
  const std::vector<int> numbers = numbers_of(kinds, shape.mass_kg);
  std::vector<std::size_t> order(kinds.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  // The large ones first: the small ones find room between them.
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return kinds[a].reach_m > kinds[b].reach_m; });
  std::vector<PlacedRock> rocks;
  for (const std::size_t k : order) {
    const RockKind& kind = kinds[k];
    for (int n = 0; n < numbers[k]; ++n) {
      bool placed = false;
      for (int tries = 0; tries < kTries && !placed; ++tries) {
        Pose X;
        // Each kind evenly over the height, so that a bench cut at any has all of them in their
        // shares.
        const double layer = (n + draw.between(0, 1)) / numbers[k];
        X.p = {draw.between(0, shape.side_m), draw.between(0, shape.side_m),
               kind.reach_m + layer * (shape.pour_height_m - 2 * kind.reach_m)};
        if (kind.spheres.size() > 1) X.R = draw.turn();
        std::vector<Sphere> spheres = kind.spheres;
        for (Sphere& s : spheres) s.centre_m = X * s.centre_m;
        placed = std::all_of(spheres.begin(), spheres.end(),
                             [&](const Sphere& s) { return box.is_free(s); });
        if (!placed) continue;
        for (const Sphere& s : spheres) box.add(s);
        rocks.push_back({kind.name, X});
      }
      if (!placed)
        throw std::runtime_error(
            fmt::format("a brick of {:.3g} m has no room for its rocks of kind {}; take smaller "
                        "rocks, or pile.built: poured",
                        shape.side_m, kind.name));
    }
  }
  return rocks;
}

BrickLay brick_lay(std::int64_t seed, const BrickShape& shape) {
  Draw draw(static_cast<std::uint64_t>(seed));
  BrickLay lay;
  const double quarter = std::floor(draw.between(0, 4));
  lay.turn_rad = radians(90 * quarter + draw.between(15, 75));
  lay.shift_m = {draw.between(0, shape.side_m), draw.between(0, shape.side_m)};
  return lay;
}

std::vector<PlacedRock> laid_bench(const std::vector<PlacedRock>& brick,
                                   const std::vector<RockKind>& kinds, const BrickShape& shape,
                                   const BrickLay& lay, const cases::Case& c,
                                   const std::function<double(double, double)>& height) {
  std::map<std::string, const RockKind*> kind_of;
  for (const RockKind& kind : kinds) kind_of[kind.name] = &kind;
  const PileShape pile = pile_shape(c);
  const double half = c.pile.width_m / 2;
  const Quaterniond turn(Eigen::AngleAxisd(lay.turn_rad, Vector3d::UnitZ()));
  const Vector3d shift(lay.shift_m.x(), lay.shift_m.y(), 0);
  // Which bricks the bench may reach into.
  Eigen::Array2d low = Eigen::Array2d::Constant(1e300), high = -low;
  for (const double x : {pile.toe_x_m, pile.rear_x_m})
    for (const double y : {-half, half}) {
      const Vector3d corner = turn.conjugate() * (Vector3d(x, y, 0) - shift) / shape.side_m;
      low = low.min(corner.head<2>().array());
      high = high.max(corner.head<2>().array());
    }
  // A brick's rocks may lie a little outside of it: LIGGGHTS wraps them round by another point.
  const Eigen::Array2i first = low.floor().cast<int>() - 1, last = high.floor().cast<int>() + 1;
  std::vector<PlacedRock> bench;
  for (int i = first.x(); i <= last.x(); ++i)
    for (int j = first.y(); j <= last.y(); ++j)
      for (const PlacedRock& rock : brick) {
        const Vector3d in_bed = rock.X_WR.p + shape.side_m * Vector3d(i, j, 0);
        const Vector3d p = turn * in_bed + shift;
        if (p.x() < pile.toe_x_m || p.x() > pile.rear_x_m || std::abs(p.y()) > half) continue;
        if (p.z() > kPourExcess * height(p.x(), p.y())) continue;
        const Pose X{turn * rock.X_WR.R, p};
        const auto& spheres = kind_of.at(rock.kind)->spheres;
        if (std::all_of(spheres.begin(), spheres.end(), [&](const Sphere& s) {
              const Vector3d at = X * s.centre_m;
              return at.x() + s.radius_m < pile.rear_x_m && std::abs(at.y()) + s.radius_m < half;
            }))
          bench.push_back({rock.kind, X});
      }
  return bench;
}

}  // namespace dipper::deck
