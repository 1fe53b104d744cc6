#include "common/text_file.hpp"

#include <fstream>
#include <stdexcept>

namespace dipper {

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace dipper
