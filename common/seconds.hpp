// Ticks as seconds.
#pragma once

#include <cstdint>

namespace dipper {

/// For formulas and messages. Times are added and compared as nanoseconds.
inline double seconds(std::int64_t t_ns) { return static_cast<double>(t_ns) * 1e-9; }

}  // namespace dipper
