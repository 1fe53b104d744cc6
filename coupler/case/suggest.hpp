// What someone may have meant by a word that is not on the list.
#pragma once

#include <string>
#include <vector>

namespace dipper::cases {

/// Edits (insert, delete, replace, swap neighbours) from one word to the other, blind to case.
int edit_distance(const std::string& a, const std::string& b);

/// The closest of `known`, or "" when none is close enough to be a slip.
std::string closest(const std::string& word, const std::vector<std::string>& known);

/// What to say of a key that a section does not have, and which of the section's keys it seems to
/// stand for ("" when none does).
struct UnknownKey {
  std::string message;
  std::string meant;
};

/// `section` is one of the schema, such as "rock.classes.#". Looks for the same stem with another
/// unit, a near spelling, and the right section; names all keys when nothing fits.
UnknownKey explain_unknown_key(const std::string& section, const std::string& key);

}  // namespace dipper::cases
