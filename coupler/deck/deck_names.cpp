#include "coupler/deck/deck_names.hpp"

#include <string_view>

namespace dipper::deck {

bool is_deck_name(const std::string& name) {
  static constexpr std::string_view kNames =
      " all bond bondShearStrength bondTensileStrength coefficientFriction"
      " coefficientRollingFriction crust_zone floor front funnel funnel_wall gamman gammat grading"
      " gravity ground k_finnie kn kt left lift moistPullOff pour rear right rocks rocks_move sheet"
      " sheet_wall sides sides_wall slab slab_crest slab_face slab_foot spheres spheres_move"
      " split truck walls waste ";
  return kNames.find(" " + name + " ") != std::string_view::npos;
}

}  // namespace dipper::deck
