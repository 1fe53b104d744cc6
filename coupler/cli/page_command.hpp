// dipper page FILE.html: a page of the JSON on standard input.
#pragma once

#include <string>

namespace dipper::cli {

/// Writes the page that parts of the tool written in other languages ask for; not for users.
/// Returns the exit status: 2 when the JSON is no page's.
int page_command(const std::string& file);

}  // namespace dipper::cli
