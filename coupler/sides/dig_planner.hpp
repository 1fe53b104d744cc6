// The planner of a case's operator, and what he knows before anything is computed.
#pragma once

#include <filesystem>

#include "coupler/case/case.hpp"
#include "machine/pass_choice.hpp"

namespace dipper::sides {

/// Throws as read_mesh_facts and load_machine do.
machine::DigFacts dig_facts(const cases::Case& c);

/// Of a plan file. Throws InputError with every fault and its line, and where the plan has passes
/// in place of a choice.
machine::DigPlanner dig_planner(const cases::Case& c, const std::filesystem::path& plan);

}  // namespace dipper::sides
