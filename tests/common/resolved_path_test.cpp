#include "common/resolved_path.hpp"

#include <gtest/gtest.h>

#include "common/input_error.hpp"
#include "common/temporary_folder.hpp"

namespace dipper {
namespace {

namespace fs = std::filesystem;

TEST(ResolvedPath, DotsAreTakenBehindLinks) {
  const TemporaryFolder temporary("resolved");
  const fs::path root = fs::canonical(temporary.path());
  fs::create_directories(root / "store/cases/one");
  fs::create_directories(root / "desk");
  fs::create_directory_symlink(root / "store/cases/one", root / "desk/mine");
  EXPECT_EQ(resolved(root / "desk/mine/../../x.stl"), root / "store/x.stl");
  EXPECT_EQ(resolved(root / "desk/mine/.."), root / "store/cases");
  EXPECT_EQ(resolved(root / "desk/./../desk/x.stl"), root / "desk/x.stl");
}

TEST(ResolvedPath, TheLastNameIsKept) {
  const TemporaryFolder temporary("resolved");
  const fs::path root = fs::canonical(temporary.path());
  fs::create_directories(root / "one");
  fs::create_directory_symlink(root / "one", root / "mine");
  EXPECT_EQ(resolved(root / "mine"), root / "mine");
  EXPECT_EQ(resolved(root / "mine/"), root / "mine");
  EXPECT_EQ(resolved(root / "mine/none/../x"), root / "one/x");
  fs::create_symlink(root / "ring", root / "ring");
  EXPECT_EQ(resolved(root / "ring/../x"), root / "x");
}

TEST(ResolvedPath, AnEmptyNameIsTheUsersMistake) { EXPECT_THROW(resolved(""), InputError); }

}  // namespace
}  // namespace dipper
