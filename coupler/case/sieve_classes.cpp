#include "coupler/case/sieve_classes.hpp"

#include <stdexcept>

#include "common/input_error.hpp"
#include "coupler/case/sieve.hpp"

namespace dipper::cases {

void make_sieve_classes(Case& c, std::vector<Finding>& findings) {
  if (c.origins.count("rock.sieve") == 0) return;
  if (c.origins.count("rock.classes") != 0) {
    findings.push_back(finding_at(
        c, "rock.sieve", "the case has rock.classes as well; write the sizes in one of the two"));
    return;
  }
  if (c.rock.sieve.file.empty()) {
    findings.push_back(finding_at(c, "rock.sieve",
                                  "has no file; write file: NAME.csv with size_m,passing_percent"));
    return;
  }
  try {
    c.rock.classes = size_classes(read_sieve(c.rock.sieve.file), c.rock.sieve);
  } catch (const InputError& e) {
    add_file_findings(c, "rock.sieve.file", e, findings);
  } catch (const std::invalid_argument& e) {
    findings.push_back(finding_at(c, "rock.sieve", e.what()));
  }
}

}  // namespace dipper::cases
