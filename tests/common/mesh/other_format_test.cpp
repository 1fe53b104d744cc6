#include "common/mesh/other_format.hpp"

#include <gtest/gtest.h>

#include "common/mesh/stl.hpp"
#include "tests/common/input_errors.hpp"

namespace dipper::mesh {
namespace {

std::string refusal_of(const std::string& begin) {
  return test::findings_of([&] { parse_stl(begin + std::string(200, '\n')); }).at(0).message;
}

TEST(OtherFormat, IsNamed) {
  struct Beginning {
    std::string bytes, format;
  };
  const std::string iges_line = std::string(72, ' ') + "S      1\n";
  for (const Beginning& file :
       {Beginning{"ply\nformat binary_little_endian 1.0\n", "PLY"},
        Beginning{"# made by hand\n\nv 0 0 0\nv 1 0 0\n", "OBJ"}, Beginning{"\x1F\x8B\x08", "gzip"},
        Beginning{"\xFF\xFEs", "UTF-16"}, Beginning{"ISO-10303-21;\n", "STEP"},
        Beginning{"Kaydara FBX Binary  ", "FBX"}, Beginning{"; FBX 7.3.0 project file\n", "FBX"},
        Beginning{"  0\nSECTION\n  2\nHEADER\n", "DXF"},
        Beginning{"999\r\nmade by hand\r\n0\r\nSECTION\r\n", "DXF"}, Beginning{iges_line, "IGES"},
        Beginning{"a title" + iges_line.substr(7), "IGES"},
        Beginning{"<!DOCTYPE html><html>404</html>", "HTML"}})
    EXPECT_EQ(refusal_of(file.bytes), "is a " + file.format + " file; export the mesh as STL");
}

TEST(OtherFormat, AFileThatGitDidNotBring) {
  EXPECT_EQ(refusal_of("version https://git-lfs.github.com/spec/v1\noid sha256:abcdef\nsize 12\n"),
            "is a pointer of Git LFS to a file; git lfs pull brings the file");
}

TEST(OtherFormat, AnStlIsNone) {
  EXPECT_EQ(other_format("solid x\n facet normal 0 0 1\n"), "");
  EXPECT_EQ(other_format("x_m,z_m\n0,0\n"), "");
  EXPECT_EQ(other_format(""), "");
}

}  // namespace
}  // namespace dipper::mesh
