#include "common/mesh/stl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "tests/common/input_errors.hpp"
#include "tests/common/mesh/shapes.hpp"

namespace dipper::mesh {
namespace {

using test::ascii_stl;
using test::binary_stl;

const TriangleMesh cuboid = test::box({1, 2, 3}, {2, 4, 6});

Finding fault_of(const std::string& bytes) {
  return test::findings_of([&] { parse_stl(bytes); }).at(0);
}

std::string replace(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Stl, AsciiAndBinaryGiveTheSameWeldedBox) {
  for (const std::string& bytes : {ascii_stl(cuboid), binary_stl(cuboid)}) {
    const TriangleMesh mesh = parse_stl(bytes);
    EXPECT_EQ(mesh.vertices.size(), 8U);
    EXPECT_EQ(mesh.triangles.size(), 12U);
    EXPECT_NEAR(volume(mesh), 1 * 2 * 3, 1e-12);
    EXPECT_NEAR(area(mesh), 2 * (1 * 2 + 1 * 3 + 2 * 3), 1e-12);
    EXPECT_EQ(bounding_box(mesh).min_m, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(bounding_box(mesh).max_m, Eigen::Vector3d(2, 4, 6));
  }
}

TEST(Stl, VolumeFarFromTheOriginKeepsItsDigits) {
  const Eigen::Vector3d far(1e6, -1e6, 1e6);
  EXPECT_NEAR(volume(test::box(far, far + Eigen::Vector3d(1, 2, 3))), 6, 1e-9);
}

TEST(Stl, WeldsAcrossTheEdgeOfACell) {
  // 1.5 um: rounding to micrometres would put 1.4999e-6 and 1.5001e-6 in two places.
  std::string text = ascii_stl(cuboid);
  text = replace(text, "vertex 2 2 3", "vertex 2.0000004 1.9999996 3");
  EXPECT_EQ(parse_stl(text).vertices.size(), 8U);
  EXPECT_EQ(parse_stl(replace(text, "2.0000004", "2.00001")).vertices.size(), 9U);
}

TEST(Stl, DialectsOfText) {
  std::string capitals = ascii_stl(cuboid);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string old_mac = ascii_stl(cuboid);
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (const std::string& text : {capitals, old_mac, "\xEF\xBB\xBF" + ascii_stl(cuboid),
                                  "\n  \n" + ascii_stl(cuboid), "\r\n" + ascii_stl(cuboid)}) {
    EXPECT_EQ(parse_stl(text).triangles.size(), 12U);
    const auto file = std::filesystem::path(testing::TempDir()) / "dialect.stl";
    std::ofstream(file, std::ios::binary) << text;
    EXPECT_FALSE(is_plain_stl(file));
    const TriangleMesh mesh = read_stl(file);
    std::ofstream(file, std::ios::binary) << to_stl("dipper", mesh);
    EXPECT_TRUE(is_plain_stl(file));
  }
}

/// Writes a file and asks.
bool is_plain(const std::string& bytes) {
  const auto file = std::filesystem::path(testing::TempDir()) / "plain.stl";
  std::ofstream(file, std::ios::binary) << bytes;
  return is_plain_stl(file);
}

TEST(Stl, WhatLiggghtsTakesForAnotherKindIsNotPlain) {
  EXPECT_TRUE(is_plain(ascii_stl(cuboid)));
  EXPECT_TRUE(is_plain(binary_stl(cuboid)));
  for (const std::string word : {"solid", "SOLID"}) {
    std::string bytes = binary_stl(cuboid);
    EXPECT_FALSE(is_plain(bytes.replace(0, 5, word)));
  }
  const std::string text = ascii_stl(cuboid), name = text.substr(0, text.find('\n'));
  for (const std::string keyword : {"solid facet normal", "solid my facet"}) {
    const std::string named = replace(text, name, keyword);
    EXPECT_EQ(parse_stl(named).triangles.size(), 12U);
    EXPECT_FALSE(is_plain(named)) << keyword;
  }
}

TEST(Stl, ATextThatEndsWithCtrlZ) {
  for (const std::string end : {"\x1A", "\x1A\r\n"}) {
    EXPECT_EQ(parse_stl(ascii_stl(cuboid) + end).triangles.size(), 12U);
    EXPECT_FALSE(is_plain(ascii_stl(cuboid) + end));
  }
}

TEST(Stl, AMeshWhoseDigitsDoNotReachItsSizeIsRefused) {
  const Eigen::Vector3d mine(633999.6, 7344999.8, 411.6);
  const TriangleMesh rock = test::box(mine, mine + Eigen::Vector3d(0.8, 0.7, 0.6));
  EXPECT_NEAR(volume(parse_stl(ascii_stl(rock))), 0.8 * 0.7 * 0.6, 1e-6);
  const std::string lost = fault_of(binary_stl(rock)).message;
  EXPECT_NE(lost.find("are rounded to 0.5 m"), std::string::npos) << lost;
  EXPECT_NE(lost.find("its shape is lost; move it to its own origin"), std::string::npos) << lost;
  const Eigen::Vector3d near(30, 40, 5);
  EXPECT_EQ(
      parse_stl(binary_stl(test::box(near, near + Eigen::Vector3d(1, 1, 1)))).triangles.size(),
      12U);
}

TEST(Stl, SandIsWeldedByItsOwnSize) {
  const TriangleMesh grain = test::box({0, 0, 0}, {1e-6, 2e-6, 3e-6});
  EXPECT_EQ(parse_stl(ascii_stl(grain)).vertices.size(), 8U);
}

TEST(Stl, BinaryThatBeginsWithSolidIsBinary) {
  std::string bytes = binary_stl(cuboid);
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(parse_stl(bytes).triangles.size(), 12U);
}

TEST(Stl, SeveralSolidsInOneFile) {
  EXPECT_EQ(
      parse_stl(ascii_stl(cuboid) + ascii_stl(test::box({5, 5, 5}, {6, 6, 6}))).triangles.size(),
      24U);
}

TEST(Stl, AsciiFaultsNameTheirLine) {
  const std::string good = ascii_stl(cuboid);
  struct Fault {
    std::string bytes;
    int line;
    std::string message;
  };
  const std::vector<Fault> faults = {
      {replace(good, "vertex 1 4 3", "vertex 1 4,0 3"), 5,
       "'4,0' is not a number; write decimal points"},
      {replace(good, "vertex 1 4 3", "vertex 1 4.0D+00 3"), 5,
       "'4.0D+00' is not a number; write E for D"},
      {replace(good, "vertex 1 4 3", "vertex nan 4 3"), 5, "'nan' is not a number"},
      {replace(good, "vertex 1 4 3", "vertex 1 inf 3"), 5, "'inf' is not a number"},
      {replace(good, "vertex 1 4 3", "vertex 1 4"), 6, "'vertex' is not a number"},
      {replace(good, "    endloop", "    vertex 0 0 0\n    endloop"), 7,
       "'vertex' where 'endloop' belongs"},
      {replace(good, "outer loop", "outer lop"), 3, "'lop' where 'loop' belongs"},
      {replace(good, "endsolid", ""), 87, "the file ends where 'facet' or 'endsolid' belongs"},
      {good.substr(0, good.find("endloop")), 7, "the file ends where 'endloop' belongs"},
      {good.substr(0, good.find("2 3\n")), 4, "the file ends where a number belongs"},
      {"hello", 1, "'hello' where 'solid' belongs"},
      {"", 0, "holds no facets"},
      {"solid\nendsolid\n", 0, "holds no facets"},
  };
  for (const Fault& fault : faults) {
    const Finding f = fault_of(fault.bytes);
    EXPECT_EQ(f.line, fault.line) << f.message;
    EXPECT_EQ(f.message.find("byte"), std::string::npos) << f.message;
    EXPECT_NE(f.message.find(fault.message), std::string::npos) << f.message;
  }
}

TEST(Stl, BinaryFaultsNameTheirByte) {
  const std::string good = binary_stl(cuboid);
  EXPECT_EQ(fault_of(good.substr(0, 200)).message,
            "at byte 200: the header says 12 facets, which takes 684 bytes; the file ends after "
            "200: it was cut short; write or copy it again");
  EXPECT_EQ(fault_of(good.substr(0, 84 + 50 * 7)).message,
            "at byte 80: the header says 12 facets, and the file has 7: it was not written to its "
            "end, or cut short; write or copy it again");
  std::string open = good;  // its writer never came back to the header
  open.replace(80, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_EQ(fault_of(open).message.rfind("at byte 80: the header says 4294967295 facets, and", 0),
            0U);
  EXPECT_EQ(fault_of(good + "x").message,
            "at byte 684: 1 bytes too many after the 12 facets of the header; write the file "
            "again, as plain STL");

  TriangleMesh nan = cuboid;
  nan.vertices.push_back({1, std::nan(""), 3});
  nan.triangles[2][1] = 8;  // facet 3, second corner: 84 + 2 * 50 + 12 + 12
  EXPECT_EQ(fault_of(binary_stl(nan)).message,
            "at byte 208: facet 3: a coordinate is not a finite number");
}

/// As a program on, or of, another kind of processor writes it: every word's bytes turned round.
std::string big_endian(std::string bytes, bool count, bool numbers) {
  const auto turn = [&](std::size_t at) {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + 4));
  };
  if (count) turn(80);
  for (std::size_t facet = 84; numbers && facet < bytes.size(); facet += 50)
    for (std::size_t word = 0; word < 12; ++word) turn(facet + 4 * word);
  return bytes;
}

TEST(Stl, BigEndianIsNamed) {
  for (const bool numbers : {true, false})
    EXPECT_EQ(fault_of(big_endian(binary_stl(cuboid), true, numbers)).message,
              "at byte 80: the number of facets, 12, is big-endian; a binary STL is little-endian: "
              "write the file again, as little-endian or as text");
  const std::string numbers =
      big_endian(binary_stl(test::box({0, 0, 0}, {4.2, 1, 1})), false, true);
  EXPECT_NE(fault_of(numbers).message.find("m: the numbers are big-endian, or the file is damaged"),
            std::string::npos);
}

TEST(Stl, WhatIsNoStlIsReportedWithoutANumberOfFacetsFromItsText) {
  std::string text = "Exported by a program, 2024\n";
  for (int row = 0; row < 40; ++row) text += "1.0 2.0 3.0\n";
  EXPECT_EQ(
      fault_of(text).message.rfind("at byte 0: no STL file: a text one begins with 'solid'", 0), 0U)
      << fault_of(text).message;
}

TEST(Stl, MissingFile) {
  EXPECT_THROW(read_stl("no/such/file.stl"), InputError);
  EXPECT_THROW(read_stl("."), InputError);
}

TEST(Stl, FilesAreReadAsTheirBytes) {
  const auto file = std::filesystem::path(testing::TempDir()) / "cuboid.stl";
  for (const std::string& bytes :
       {ascii_stl(cuboid), binary_stl(cuboid), to_stl("cuboid", cuboid)}) {
    std::ofstream(file, std::ios::binary) << bytes;
    const TriangleMesh read = read_stl(file);
    EXPECT_EQ(read.triangles.size(), cuboid.triangles.size());
    EXPECT_NEAR(volume(read), 6, 1e-12);
  }
}

TEST(Stl, AFaultyFileIsNamedWithTheLine) {
  const auto file = std::filesystem::path(testing::TempDir()) / "none.stl";
  std::ofstream(file) << "not a mesh";
  EXPECT_EQ(test::message_of([&] { read_stl(file); }),
            file.string() + ":1: not an ascii STL file: 'not' where 'solid' belongs");
}

TEST(Stl, WritesWhatTheDecksHold) {
  TriangleMesh mesh;
  mesh.add_loose({Eigen::Vector3d(-0.0, 0, 1.25), {1, 0, 1.25}, {0, 1, 1.25}});
  EXPECT_EQ(to_stl("roof", mesh),
            "solid roof\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 1.25\n"
            "   vertex 1 0 1.25\n   vertex 0 1 1.25\n  endloop\n endfacet\nendsolid roof\n");
}

}  // namespace
}  // namespace dipper::mesh
