// What a mistyped word was most likely meant to be.
#pragma once

#include <string>
#include <vector>

namespace dipper::cli {

/// The word of `known` with the fewest letters to change, leave out, put in or swap with their
/// neighbour (Damerau 1964, Commun. ACM 7:171); empty when that is more than a third of the
/// letters.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace dipper::cli
