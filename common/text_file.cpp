#include "common/text_file.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

#include "common/draft_file.hpp"

namespace dipper {

void write_text(const std::filesystem::path& file, const std::string& text) {
  const DraftFile draft(file);
  std::ofstream out(draft.path(), std::ios::binary);
  out << text;
  out.close();
  std::error_code failed;
  if (out) draft.keep(failed);
  if (!out || failed)
    throw std::runtime_error(file.string() +
                             ": cannot be written; is the disk full, or the folder not yours?");
}

}  // namespace dipper
