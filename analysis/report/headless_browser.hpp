// A web browser without a window, controlled over a pipe (Chrome DevTools Protocol).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/temporary_folder.hpp"

namespace dipper::analysis::report {

/// The path of a program on the PATH; empty when it is not there.
std::optional<std::filesystem::path> program_on_path(const std::string& name);

/// Chromium or Chrome, whichever is installed.
std::optional<std::filesystem::path> find_browser();

/// One page in a browser of its own, with an empty profile and software WebGL. The browser ends
/// with it.
class HeadlessBrowser {
 public:
  /// Throws std::runtime_error when the browser does not start within a minute.
  HeadlessBrowser(const std::filesystem::path& program, const std::filesystem::path& page);
  ~HeadlessBrowser();
  HeadlessBrowser(const HeadlessBrowser&) = delete;
  HeadlessBrowser& operator=(const HeadlessBrowser&) = delete;

  /// The value of an expression, or of its promise. Throws std::runtime_error with the page's
  /// error, when the browser has ended, or when there is no answer within `patience`.
  nlohmann::json evaluate(const std::string& expression, std::chrono::seconds patience);

 private:
  nlohmann::json ask(const std::string& method, nlohmann::json parameters,
                     std::chrono::seconds patience);
  std::string next_message(std::chrono::steady_clock::time_point until);
  void end();

  TemporaryFolder profile_{"dipper-browser"};
  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
  int last_id_ = 0;
  std::string session_, unread_;
};

}  // namespace dipper::analysis::report
