#include "coupler/calibrate/request_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "coupler/case/check_command.hpp"

namespace dipper {
namespace {

std::vector<Override> with(const CalibrationRequest& request,
                           const std::vector<std::pair<std::string, double>>& parameters) {
  std::vector<Override> all = request.overrides;
  for (const auto& [key, value] : parameters) all.push_back({key, fmt::format("{:.9g}", value)});
  return all;
}

bool starts_with(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

/// A key that changes nothing in these decks would be searched for nothing.
std::string fault_of(const SearchRange& r) {
  if (!starts_with(r.key, "contact.") && !starts_with(r.key, "rock."))
    return "the pile does not depend on it; search keys of contact or rock";
  for (const char* wall : {"friction_dipper", "friction_truck"})
    if (r.key == std::string("contact.") + wall)
      return "there is no dipper and no truck at the pile; search friction_ground or that of rocks";
  if (!(r.low < r.high))
    return fmt::format("{:g}:{:g} is no range; write LOW:HIGH with LOW below HIGH", r.low, r.high);
  return "";
}

}  // namespace

std::optional<Case> checked_case(const CalibrationRequest& request) {
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < request.search.size(); ++i) {
    const SearchRange& r = request.search[i];
    const std::string fault = fault_of(r);
    if (!fault.empty()) faults.push_back(fmt::format("--search: {}: {}", r.key, fault));
    for (std::size_t j = 0; j < i; ++j)
      if (request.search[j].key == r.key)
        faults.push_back(fmt::format("--search: {}: given twice", r.key));
    for (const double end : {r.low, r.high}) {
      std::vector<Finding> findings;
      load_case(request.case_folder, {{r.key, fmt::format("{:.9g}", end)}}, findings);
      for (const Finding& f : findings) {
        const std::string text = to_string(f);
        if (f.key == r.key && std::find(faults.begin(), faults.end(), text) == faults.end())
          faults.push_back(text);
      }
    }
  }
  if (request.search.size() > 3)
    faults.push_back("--search: one to three keys can be searched at once");
  // Three levels and three terms: nothing would be left to tell the noise by.
  if (request.search.size() == 1 && request.seeds == 1)
    faults.push_back("--seeds 1 is too few to search one key; take 2 or more");
  if (std::filesystem::exists(request.out))
    faults.push_back(request.out.string() + " is there already; choose another --out");
  for (const std::string& fault : faults) std::cout << fault << '\n';
  if (check_command(request.case_folder, request.overrides, std::cout) != 0) return std::nullopt;
  if (!faults.empty()) return std::nullopt;
  std::vector<Finding> findings;
  return load_case(request.case_folder, request.overrides, findings);
}

Case changed_case(const CalibrationRequest& request,
                  const std::vector<std::pair<std::string, double>>& parameters,
                  std::int64_t seed) {
  std::vector<Override> all = with(request, parameters);
  all.push_back({"seed", std::to_string(seed)});
  std::vector<Finding> findings;
  Case c = load_case(request.case_folder, all, findings);
  if (!findings.empty()) throw std::invalid_argument(to_string(findings[0]));
  return c;
}

std::string missing_classes(const Case& c, const std::vector<double>& rocks) {
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

}  // namespace dipper
