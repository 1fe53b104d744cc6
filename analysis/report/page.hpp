// A page of the tool: one HTML file that draws itself from the JSON inside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dipper::analysis::report {

/// The page's text. `data` holds "kind", which picks the sections (web/pages/KIND.js), "title",
/// which goes into the browser's tab, and what these sections draw. `frames`: gzip blocks of a
/// replay. Throws std::invalid_argument when the title is missing, or the kind is unknown.
std::string page(const nlohmann::json& data,
                 const std::vector<std::vector<std::uint8_t>>& frames = {});

}  // namespace dipper::analysis::report
