// Suggestions for an unknown key of a section.
#pragma once

#include <string>

namespace dipper::cases {

/// The message for an unknown key, and the section's key that was probably meant ("" if none).
struct UnknownKey {
  std::string message;
  std::string meant;
};

/// `section` is one of the schema, such as "rock.classes.#". Looks for the same stem with another
/// unit, a near spelling, and the right section; names all keys when nothing fits.
UnknownKey explain_unknown_key(const std::string& section, const std::string& key);

}  // namespace dipper::cases
