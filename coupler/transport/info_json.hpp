#pragma once

#include <string>

#include "coupler/core/server.hpp"

namespace dipper {

/// A server's description as the JSON text of the status that answers "hello", and back.
std::string to_json(const ServerInfo& info);
ServerInfo info_from_json(const std::string& text);

}  // namespace dipper
