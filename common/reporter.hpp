// Where a program's words to its user go.
#pragma once

#include <string>

namespace dipper {

/// Libraries say what they do to one of these; the program decides where it is shown. Whatever
/// becomes of the words, the work goes on: no method throws.
class Reporter {
 public:
  virtual ~Reporter() = default;

  /// Of what is done or found; may hold several lines, the last without its end.
  virtual void line(const std::string& text) = 0;

  /// What went wrong.
  virtual void error(const std::string& text) = 0;

  /// How far a long work has come: the next one, or the next line, takes its place.
  virtual void progress(const std::string& text) = 0;
};

}  // namespace dipper
