// The planner of a case's operator, with what is known before the run.
#pragma once

#include <filesystem>

#include "coupler/case/case.hpp"
#include "machine/pass_choice.hpp"

namespace dipper::deck {

/// Throws InputError where the file beside the dipper's mesh, or the machine's, is at fault.
machine::DigFacts dig_facts(const cases::Case& c);

/// The input of a plan file. Throws InputError with every fault and its line, also where the file
/// plans passes instead of giving candidates.
machine::DigPlanner dig_planner(const cases::Case& c, const std::filesystem::path& plan);

/// His dig before any other, on the bench as the case makes it, from where the dipper is.
machine::DigDecision first_dig(const cases::Case& c, const machine::DigPlanner& planner,
                               const machine::PassStart& from);

}  // namespace dipper::deck
