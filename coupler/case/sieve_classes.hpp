// rock.sieve in place of rock.classes.
#pragma once

#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Makes rock.classes from rock.sieve when the case has that section. Findings: both or neither
/// given, no file, a fault in the file, a truncation that leaves nothing.
void make_sieve_classes(Case& c, std::vector<Finding>& findings);

}  // namespace dipper::cases
