#include "dem/deflated.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

namespace dipper::dem {
namespace {

/// What zlib makes of one gzip member; "" when it is none, or when anything stands behind it.
std::string unpacked(const std::string& file, std::size_t size) {
  std::string out(size + 1, '\0');
  z_stream stream{};
  inflateInit2(&stream, 15 + 16);  // gzip only
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(file.data()));
  stream.avail_in = static_cast<uInt>(file.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const bool whole = inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_in == 0;
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return whole ? out : "";
}

TEST(Deflated, PartsOfSeveralRanksAreOneMember) {
  std::string all, file = gzip_head();
  GzipTail tail;
  for (const std::string& text : {std::string(300000, 'a'), std::string("of another rank\n"),
                                  std::string(), std::string("12.3456 7.89\n12.3457 7.89\n")}) {
    const Deflated part = deflated(text, 4);
    file += part.bytes;
    tail.add(part.length, part.crc);
    all += text;
  }
  file += tail.bytes();
  EXPECT_EQ(unpacked(file, all.size()), all);
  EXPECT_LT(file.size(), 1000u);
  file[file.size() - 5] ^= 1;  // the sum is of all parts
  EXPECT_EQ(unpacked(file, all.size()), "");
}

TEST(Deflated, InflatesToWhatItWas) {
  std::string bytes;
  for (int k = 0; k < 100000; ++k) bytes.push_back(static_cast<char>(k * k / 7));
  for (const std::string& before : {bytes, std::string()}) {
    const Deflated part = deflated(before, 1);
    EXPECT_EQ(inflated(part), before);
  }
  Deflated damaged = deflated(bytes, 1);
  damaged.bytes[damaged.bytes.size() / 2] ^= 1;
  EXPECT_THROW(inflated(damaged), std::runtime_error);
  damaged = deflated(bytes, 1);
  damaged.bytes.resize(damaged.bytes.size() / 2);
  EXPECT_THROW(inflated(damaged), std::runtime_error);
}

}  // namespace
}  // namespace dipper::dem
