#pragma once

#include <stdexcept>
#include <string>

#include "coupler/core/message.hpp"

namespace dipper::transport {

/// Bytes that are not a whole message of one of the types in coupler/lcm.
struct DecodeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// As LCM encodes the types in coupler/lcm. header.mac is zero: the transport seals it.
std::string encode(const core::Message& m);

/// Throws DecodeError for an unknown type or a wrong length. Numbers are passed on as they are:
/// `require_sound` judges them once it is known whose message it is.
core::Message decode(const std::string& bytes);

}  // namespace dipper::transport
