#include "analysis/report/packing.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

namespace dipper::analysis::report {
namespace {

std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }

TEST(Base64, TestVectorsOfRfc4648) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : vectors) EXPECT_EQ(base64(bytes(plain)), coded);
}

TEST(Gzip, ReadBackByZlib) {
  std::vector<std::uint8_t> data(300000);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i * i >> 7);
  const auto packed = gzip(data.data(), data.size());
  std::vector<std::uint8_t> back(data.size() + 1);
  z_stream z{};
  ASSERT_EQ(inflateInit2(&z, 16 + MAX_WBITS), Z_OK);
  z.next_in = const_cast<Bytef*>(packed.data());
  z.avail_in = static_cast<uInt>(packed.size());
  z.next_out = back.data();
  z.avail_out = static_cast<uInt>(back.size());
  EXPECT_EQ(inflate(&z, Z_FINISH), Z_STREAM_END);
  back.resize(z.total_out);
  inflateEnd(&z);
  EXPECT_EQ(back, data);
}

TEST(Gzip, SameBytesEveryTime) {
  const auto data = bytes("rock rock rock");
  EXPECT_EQ(gzip(data.data(), data.size()), gzip(data.data(), data.size()));
}

}  // namespace
}  // namespace dipper::analysis::report
