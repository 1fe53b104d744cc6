#pragma once

#include <stdexcept>
#include <string>

#include "coupler/core/message.hpp"

namespace dipper::transport {

/// Bytes that are not one complete message of a type in coupler/lcm.
struct DecodeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Encodes as LCM does the types in coupler/lcm. header.mac is zero: the transport sets it.
std::string encode(const core::Message& m);

/// Throws DecodeError for an unknown type or a wrong length. Does not check values: `require_sound`
/// does, once the sender is known.
core::Message decode(const std::string& bytes);

}  // namespace dipper::transport
