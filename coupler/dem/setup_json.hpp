#pragma once

#include <nlohmann/json.hpp>

#include "coupler/dem/liggghts_rock.hpp"

namespace dipper {

/// The settings of dipper-dem as the launcher writes them, and back.
nlohmann::json to_json(const RockSetup& setup);
RockSetup rock_setup_from(const nlohmann::json& j);

}  // namespace dipper
