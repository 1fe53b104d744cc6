// What an InputError says, for tests that cause one.
#pragma once

#include <string>
#include <vector>

#include "common/input_error.hpp"

namespace dipper::test {

/// The findings of an InputError that `act` throws; empty: nothing thrown.
template <typename Act>
std::vector<Finding> findings_of(Act act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.findings();
  }
  return {};
}

/// The same as they are printed.
template <typename Act>
std::vector<std::string> faults_of(Act act) {
  std::vector<std::string> all;
  for (const Finding& f : findings_of(act)) all.push_back(to_string(f));
  return all;
}

/// The same in one text, a line a fault.
template <typename Act>
std::string message_of(Act act) {
  std::string all;
  for (const std::string& fault : faults_of(act)) all += (all.empty() ? "" : "\n") + fault;
  return all;
}

}  // namespace dipper::test
