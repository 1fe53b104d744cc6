#include "machine/return_legs.hpp"

#include <algorithm>
#include <iterator>

#include "machine/door.hpp"

namespace dipper::machine {
namespace {

constexpr std::int64_t kLegTick_ns = 10'000'000;
constexpr double kNear_m = 1e-3;

}  // namespace

std::vector<ReturnLeg> return_legs(const Motion& motion) {
  std::vector<Drives> x;
  for (std::int64_t t = motion.start_ns(); t <= motion.end_ns(); t += kLegTick_ns)
    x.push_back(motion.value(t));
  const auto door = [](const Drives& a, const Drives& b) { return a.door < b.door; };
  const auto crowd = [](const Drives& a, const Drives& b) { return a.crowd < b.crowd; };
  const auto is_open = [](const Drives& d) { return door_is_open(d.door); };
  const auto time = [&](auto at) { return motion.start_ns() + (at - x.begin()) * kLegTick_ns; };

  std::vector<ReturnLeg> legs;
  for (auto opened = std::find_if(x.begin(), x.end(), is_open); opened != x.end();) {
    const auto closed = std::find_if_not(opened, x.end(), is_open);
    if (closed == x.end()) break;
    // The last row with the widest opening: from there it closes.
    const auto widest = std::max_element(std::make_reverse_iterator(closed),
                                         std::make_reverse_iterator(opened), door);
    opened = std::find_if(closed, x.end(), is_open);
    std::int64_t end_ns = motion.end_ns();
    if (opened != x.end()) {
      const auto out = std::max_element(closed, opened, crowd);  // in the dig, or at its end
      const double in = std::min_element(closed, out + 1, crowd)->crowd + kNear_m;
      const auto last =
          std::find_if(std::make_reverse_iterator(out + 1), std::make_reverse_iterator(closed),
                       [&](const Drives& d) { return d.crowd <= in; });
      end_ns = time(last.base() - 1);
    }
    legs.push_back({time(widest.base() - 1), end_ns});
  }
  return legs;
}

}  // namespace dipper::machine
