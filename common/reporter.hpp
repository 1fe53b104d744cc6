// The output of a program for its user.
#pragma once

#include <string>

namespace dipper {

/// Libraries report to one of these; the program decides where it is shown. No method throws: the
/// work continues when the output cannot be written.
class Reporter {
 public:
  virtual ~Reporter() = default;

  /// What was done or found; may have several lines, the last without a newline.
  virtual void line(const std::string& text) = 0;

  /// An error.
  virtual void error(const std::string& text) = 0;

  /// Progress of long work: the next one, or the next line, replaces it.
  virtual void progress(const std::string& text) = 0;
};

}  // namespace dipper
