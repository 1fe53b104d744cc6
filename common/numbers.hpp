// Numbers in text, read the same way in a case, a mesh, a table and on the command line.
#pragma once

#include <cstdint>
#include <string_view>

namespace dipper {

/// Reads a number that is the whole of `text`: an optional sign (+ or -), decimal digits with an
/// optional point, and an optional exponent. Nothing may precede or follow it, not even a
/// blank. Refused are nan, inf, hexadecimal digits, digits grouped by commas, and what a double
/// cannot hold (1e999, 1e-400). The locale has no effect. Returns false, with `value` as it was,
/// when `text` is no such number.
bool parse_number(std::string_view text, double& value);

/// The same for whole numbers: a sign and digits, within 64 bits.
bool parse_number(std::string_view text, std::int64_t& value);

}  // namespace dipper
