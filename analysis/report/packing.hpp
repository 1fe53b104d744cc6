// Bytes for a web page: gzip, then base64.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dipper::analysis::report {

/// One gzip member (RFC 1952), which a browser's DecompressionStream("gzip") reads. The same bytes
/// for the same input: no time and no name inside. Throws std::runtime_error when zlib fails.
std::vector<std::uint8_t> gzip(const std::uint8_t* data, std::size_t size);

/// RFC 4648, with padding.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace dipper::analysis::report
