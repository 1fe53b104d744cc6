// The text of a case as a run keeps it (case.txt): a line key=value for each key.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dipper {

/// One key. The value is what --set takes: a number, a list, or a text in quotes.
struct CaseLine {
  std::string key;
  std::string value;
  int line = 0;  ///< 1-based
};

/// All keys of a case, in the order of the text. Each key is there once.
class CaseLines {
 public:
  CaseLines() = default;
  explicit CaseLines(std::string_view text);

  /// Of a file; throws InputError when it cannot be read.
  static CaseLines read(const std::filesystem::path& file);

  const CaseLine* find(std::string_view key) const;  ///< nullptr: no such key

  /// A key's number; empty when it has none.
  std::optional<double> number(std::string_view key) const;

  /// A key's text without its quotes; "" when there is none.
  std::string text(std::string_view key) const;

  auto begin() const { return lines_.begin(); }
  auto end() const { return lines_.end(); }

 private:
  std::vector<CaseLine> lines_;
};

}  // namespace dipper
