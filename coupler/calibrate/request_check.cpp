#include "coupler/calibrate/request_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "common/begins_with.hpp"
#include "common/cache_folder.hpp"
#include "common/case_lines.hpp"
#include "common/input_error.hpp"
#include "common/installation.hpp"
#include "common/writable_folder.hpp"
#include "coupler/calibrate/search_scale.hpp"
#include "coupler/check/checked_case.hpp"
#include "coupler/deck/liggghts_path.hpp"

namespace dipper::calibrate {
namespace {

std::vector<cases::Override> with(const CalibrationRequest& request,
                                  const std::vector<std::pair<std::string, double>>& parameters) {
  std::vector<cases::Override> all = request.overrides;
  for (const auto& [key, value] : parameters) all.push_back({key, fmt::format("{:.9g}", value)});
  return all;
}

/// Refuses a key that has no effect in these decks.
std::string fault_of(const SearchRange& r) {
  if (!begins_with(r.key, "contact.") && !begins_with(r.key, "rock."))
    return "the pile does not depend on this key; search keys of contact or rock";
  for (const char* wall : {"friction_dipper", "rolling_friction_dipper", "friction_truck",
                           "friction_truck_sphere", "rolling_friction_truck", "adhesion_Pa"})
    if (r.key == std::string("contact.") + wall)
      return "the calibration has no dipper and no truck; search a key of the ground or the rocks";
  if (r.key == "rock.bulk_density_kg_m3") return "it is measured, not searched";
  if (!(r.low < r.high))
    return fmt::format("{:g}:{:g} is not a range; write LOW:HIGH with LOW below HIGH", r.low,
                       r.high);
  return "";
}

/// The error of `dipper check` at the first point of the search that it refuses; "" when there is
/// none.
std::string fault_at_a_point(const CalibrationRequest& request) {
  const SearchScale scale(request.search);
  for (const Point& x : composite_design(static_cast<int>(request.search.size()))) {
    try {
      changed_case(request, scale.values(x), 1);
    } catch (const std::invalid_argument& e) {
      std::string at;
      for (const auto& [key, value] : scale.values(x)) at += fmt::format(" {}={:g}", key, value);
      return fmt::format("--search: at{}: {}", at, e.what());
    }
  }
  return "";
}

}  // namespace

std::optional<double> value_of(const cases::Case& c, const std::string& key) {
  return CaseLines(c.text).number(key);
}

std::optional<cases::Case> checked_request(const CalibrationRequest& request, Reporter& reporter) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < request.search.size(); ++i) {
    const SearchRange& r = request.search[i];
    const std::string fault = fault_of(r);
    if (!fault.empty()) faults.push_back(fmt::format("--search: {}: {}", r.key, fault));
    for (std::size_t j = 0; j < i; ++j)
      if (request.search[j].key == r.key)
        faults.push_back(fmt::format("--search: {}: given twice", r.key));
  }
  if (request.search.size() > 3)
    faults.push_back("--search: one to three keys can be searched at once");
  // Three points and three coefficients leave no degree of freedom for the noise.
  if (request.search.size() == 1 && request.seeds == 1)
    faults.push_back("--seeds 1 is too few to search one key; take 2 or more");
  if (std::filesystem::exists(request.out))
    faults.push_back(request.out.string() + " exists; choose another --out");
  if (!deck::liggghts_takes(data_folder()))  // the deck and its sheet are in this folder
    faults.push_back(data_folder().string() + ": " + deck::kLiggghtsRefuses);
  try {
    require_writable(request.out);
    make_writable(cache_folder(), kOtherCache);
  } catch (const InputError& e) {
    faults.push_back(e.what());
  }
  for (const std::string& fault : faults) reporter.line(fault);
  std::optional<cases::Case> c =
      check::checked_case(request.case_folder, request.overrides, reporter);
  if (!c || !faults.empty()) return std::nullopt;
  if (!request.search.empty()) {
    const std::string fault = fault_at_a_point(request);
    if (!fault.empty()) faults.push_back(fault);
  }
  for (const SearchRange& r : request.search)
    if (faults.empty() && !value_of(*c, r.key))
      faults.push_back(fmt::format("--search: {}: has no numeric value in this case", r.key));
  for (const std::string& fault : faults) reporter.line(fault);
  return faults.empty() ? c : std::nullopt;
}

cases::Case changed_case(const CalibrationRequest& request,
                         const std::vector<std::pair<std::string, double>>& parameters,
                         std::int64_t seed) {
  std::vector<cases::Override> all = with(request, parameters);
  all.push_back({"seed", std::to_string(seed)});
  std::vector<Finding> findings;
  cases::Case c = check::read_case(request.case_folder, all, findings);
  if (!findings.empty()) throw std::invalid_argument(to_string(findings[0]));
  return c;
}

std::string missing_classes(const cases::Case& c, const std::vector<double>& rocks) {
  std::string out;
  for (std::size_t i = 0; i < rocks.size(); ++i)
    if (rocks[i] < 1)
      out += fmt::format("{}{:.2f} rocks of {}", out.empty() ? "" : ", ", rocks[i],
                         c.rock.classes[i].name);
  return out;
}

int jobs_of(const CalibrationRequest& request) {
  if (request.jobs > 0) return request.jobs;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace dipper::calibrate
