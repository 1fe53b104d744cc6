// What someone may have meant by a key that a section does not have.
#pragma once

#include <string>

namespace dipper::cases {

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
