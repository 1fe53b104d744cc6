// The bench as the case makes it, seen from above.
#pragma once

#include "common/height_map.hpp"
#include "coupler/case/case.hpp"

namespace dipper::deck {

/// Of the settled pile from its toe to its rear wall, in cells of 0.1 m; 0 around it.
HeightMap bench_map(const cases::Case& c);

}  // namespace dipper::deck
