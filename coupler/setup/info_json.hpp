#pragma once

#include <string>

#include "coupler/core/server.hpp"

namespace dipper::setup {

/// A side's description as the JSON text of its reply to "hello", and back.
std::string to_json(const core::ServerInfo& info);
core::ServerInfo info_from_json(const std::string& text);

}  // namespace dipper::setup
