#include "common/shell_word.hpp"

#include <glib.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>

namespace dipper {

std::string shell_word(const std::filesystem::path& path) {
  const std::string text = path.string();
  if (std::all_of(text.begin(), text.end(), [](unsigned char letter) {
        return std::isalnum(letter) != 0 || letter > 127 || std::strchr("/._-+", letter) != nullptr;
      }))
    return text;
  const std::unique_ptr<gchar, decltype(&g_free)> quoted(g_shell_quote(text.c_str()), g_free);
  return quoted.get();
}

}  // namespace dipper
