#include "tests/one_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace dipper::test {
namespace {

bool is_for(const std::string& name, const std::string& kind) {
  const std::string end = "/" + kind;
  return kind.empty() || (name.size() > end.size() && name.substr(name.size() - end.size()) == end);
}

}  // namespace

void start_tests(int& argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc < 2) return;
  const std::string file = std::string(argv[1]) + "_test.cpp", kind = argc > 2 ? argv[2] : "";
  std::string filter;
  const auto& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (std::filesystem::path(test.file()).filename() == file && is_for(test.name(), kind))
        filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  if (filter.empty()) {
    std::fprintf(stderr, "%s has no tests of %s %s\n", argv[0], file.c_str(), kind.c_str());
    std::exit(2);
  }
  GTEST_FLAG_SET(filter, filter);
}

}  // namespace dipper::test
