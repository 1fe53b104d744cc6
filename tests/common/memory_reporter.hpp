// A reporter that keeps what is reported.
#pragma once

#include <string>

#include "common/reporter.hpp"

namespace dipper::test {

struct MemoryReporter final : Reporter {
  void line(const std::string& text) override { lines += text + "\n"; }
  void error(const std::string& text) override { errors += text + "\n"; }
  void progress(const std::string& text) override { last_progress = text; }
  std::string lines, errors, last_progress;
};

}  // namespace dipper::test
