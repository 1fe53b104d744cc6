#include "coupler/launch/shell_words.hpp"

#include <glib.h>

#include "common/input_error.hpp"

namespace dipper::launch {

std::vector<std::string> shell_words(const std::string& text, const std::string& option) {
  if (text.find_first_not_of(' ') == std::string::npos) return {};
  int count = 0;
  char** words = nullptr;
  GError* error = nullptr;
  if (g_shell_parse_argv(text.c_str(), &count, &words, &error) == FALSE) {
    const std::string why = error->message;
    g_error_free(error);
    throw InputError({{{}, 0, option, why}});
  }
  std::vector<std::string> all(words, words + count);
  g_strfreev(words);
  return all;
}

}  // namespace dipper::launch
