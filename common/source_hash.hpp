#pragma once

#include <string>

namespace dipper {

/// SHA-256 over the names and texts of all C++ and of the decks this program was built from: two
/// builds with the same hash compute the same from a case, even if their commits differ elsewhere.
std::string source_hash();

}  // namespace dipper
