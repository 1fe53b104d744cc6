// The known word nearest to a mistyped one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dipper {

/// Letters to change, leave out, put in or swap with their neighbour to make one word of the other
/// (Damerau 1964, Commun. ACM 7:171), blind to case.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The word of `known` with the least distance; empty when that is more than a third of the
/// letters, and more than one.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace dipper
