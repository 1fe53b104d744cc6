#include "analysis/io/dump_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "analysis/io/kept_rows.hpp"
#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// All rows of a frame, a vector a column.
std::vector<std::vector<double>> all(const DumpFrame& frame,
                                     const std::vector<std::string>& columns) {
  std::vector<std::vector<double>> out(columns.size());
  DumpReader::read(frame, columns, [&](const ParticleChunk& chunk) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      out[k].insert(out[k].end(), chunk.columns[k].begin(),
                    chunk.columns[k].begin() + static_cast<long>(chunk.rows));
  });
  return out;
}

TEST(TextDump, ColumnsComeByNameInAnyOrder) {
  const Scratch scratch;
  const fs::path file = scratch.write(
      "rocks_30.dump", text_frame(30, 2, "radius id z y x", "0.5 7 3 2 1\n2.5e-1 8 -3 -2 -1\n"));
  const DumpReader reader({file});
  ASSERT_EQ(reader.frames().size(), 1u);
  const DumpFrame& frame = reader.frames()[0];
  EXPECT_EQ(frame.step, 30);
  EXPECT_EQ(frame.particles, 2u);
  EXPECT_DOUBLE_EQ(frame.box->max_m.y(), 20);
  EXPECT_THAT(all(frame, {"x", "radius", "id"}),
              ElementsAre(ElementsAre(1, -1), ElementsAre(0.5, 0.25), ElementsAre(7, 8)));
}

TEST(TextDump, FramesOfSeveralFilesComeByStep) {
  const Scratch scratch;
  const auto two = text_frame(200, 1, "x", "2\n") + text_frame(100, 2, "x", "10\n11\n");
  const DumpReader reader(
      {scratch.write("a.dump", two), scratch.write("b.dump", text_frame(150, 1, "x", "3\n"))});
  ASSERT_EQ(reader.frames().size(), 3u);
  EXPECT_EQ(reader.frames()[0].step, 100);
  EXPECT_EQ(reader.frames()[1].step, 150);
  EXPECT_THAT(all(reader.frames()[0], {"x"}), ElementsAre(ElementsAre(10, 11)));
  EXPECT_THAT(all(reader.frames()[2], {"x"}), ElementsAre(ElementsAre(2)));
}

TEST(TextDump, LammpsHasTimesUnwrappedAndScaledPositions) {
  const Scratch scratch;
  std::string text = text_frame(5, 1, "xu ys zs", "99 0.25 0.5\n");
  text = "ITEM: UNITS\nsi\nITEM: TIME\n0.125\n" + text;
  const DumpReader reader({scratch.write("dump.lammpstrj", text)});
  EXPECT_DOUBLE_EQ(*reader.frames()[0].time_s, 0.125);
  EXPECT_THAT(all(reader.frames()[0], {"x", "y", "z"}),
              ElementsAre(ElementsAre(99), ElementsAre(5), ElementsAre(0)));
}

TEST(TextDump, PositionsScaledToATiltedBoxAreRefused) {
  const Scratch scratch;
  const auto tilted = [](const std::string& columns, const std::string& tilt) {
    return "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n"
           "0 10 " +
           tilt + "\n0 20 0\n0 30 0\nITEM: ATOMS " + columns + "\n0.5\n";
  };
  const DumpReader scaled({scratch.write("scaled_5.dump", tilted("xs", "2.5"))});
  EXPECT_THAT(test::message_of([&] { all(scaled.frames()[0], {"x"}); }),
              HasSubstr("xs is scaled to a tilted box, which is not read"));
  const DumpReader upright({scratch.write("upright_5.dump", tilted("xs", "0"))});
  EXPECT_THAT(all(upright.frames()[0], {"x"}), ElementsAre(ElementsAre(5)));
  const DumpReader plain({scratch.write("plain_5.dump", tilted("x", "2.5"))});
  EXPECT_THAT(all(plain.frames()[0], {"x"}), ElementsAre(ElementsAre(0.5)));
}

TEST(TextDump, ARadiusIsHalfADiameter) {
  const Scratch scratch;
  const DumpReader reader(
      {scratch.write("dump.lammpstrj", text_frame(5, 2, "x diameter", "1 0.25\n2 0.5\n"))});
  EXPECT_THAT(all(reader.frames()[0], {"radius"}), ElementsAre(ElementsAre(0.125, 0.25)));
}

TEST(TextDump, AFrameIsReadFromItsFileOnce) {
  const Scratch scratch;
  const fs::path file =
      scratch.write("rocks_30.dump", text_frame(30, 2, "x element id", "1 Si 7\n2 Si 8\n"));
  const DumpReader reader({file});
  const DumpFrame& frame = reader.frames()[0];
  EXPECT_THAT(all(frame, {"id"}), ElementsAre(ElementsAre(7, 8)));
  fs::remove(file);
  EXPECT_THAT(all(frame, {"id", "x"}), ElementsAre(ElementsAre(7, 8), ElementsAre(1, 2)));
  EXPECT_THAT(test::message_of([&] { all(frame, {"element"}); }),
              HasSubstr("rocks_30.dump:10: element 'Si' is not a number"));
}

TEST(TextDump, WhatMemoryHasNoRoomForIsReadAgain) {
  const Scratch scratch;
  const fs::path first = scratch.write("rocks_1.dump", text_frame(1, 1, "x", "1\n"));
  const fs::path second = scratch.write("rocks_2.dump", text_frame(2, 1, "x", "2\n"));
  std::vector<DumpFrame> frames = DumpReader({first, second}).frames();
  const auto kept_by = [&](const KeptRows& rows) {
    for (DumpFrame& frame : frames) frame.kept = std::make_shared<KeptRows>(rows);
    frames[1].kept = frames[0].kept;
    all(frames[0], {"x"});
    all(frames[1], {"x"});
  };
  kept_by(KeptRows(0, 8));  // the last one alone
  fs::remove(second);
  EXPECT_THAT(all(frames[1], {"x"}), ElementsAre(ElementsAre(2)));
  EXPECT_THAT(all(frames[0], {"x"}), ElementsAre(ElementsAre(1)));
  EXPECT_THROW(all(frames[1], {"x"}), InputError);
  scratch.write("rocks_2.dump", text_frame(2, 1, "x", "2\n"));
  kept_by(KeptRows(8, 8));  // the first for good
  fs::remove(first);
  EXPECT_THAT(all(frames[0], {"x"}), ElementsAre(ElementsAre(1)));
}

TEST(TextDump, WhatIsWrongIsReportedWithFileAndLine) {
  const Scratch s;
  const auto opening = [](const fs::path& file) {
    return test::message_of([&] { DumpReader({file}); });
  };
  EXPECT_THAT(opening(s.write("cut.dump", text_frame(7, 3, "x", "1\n2\n"))),
              HasSubstr("cut.dump:12: the frame of step 7 ends after 2 of 3 particles"));
  EXPECT_THAT(opening(s.write("half.dump", text_frame(7, 2, "x", "1\n2."))),
              HasSubstr("half.dump:11: the last line has no end"));
  EXPECT_THAT(
      opening(s.write("short.dump", text_frame(7, 2, "x", "1\n") + text_frame(8, 1, "x", "1\n"))),
      HasSubstr("short.dump:11: the frame of step 7 ends after 1 of 2"));
  EXPECT_THAT(opening(s.write("head.dump", "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n")),
              HasSubstr("head.dump:4: the file ends where"));
  EXPECT_THAT(opening(s.write("other.dump", "hello\n")), HasSubstr("other.dump:1: 'hello'"));
  EXPECT_THAT(opening(s.write("empty.dump", "")), HasSubstr("empty.dump:1: empty"));
  EXPECT_THAT(opening(s.folder() / "none.dump"), HasSubstr("none.dump: cannot be read: No such"));
  const auto a = s.write("a.dump", text_frame(7, 1, "x", "1\n"));
  EXPECT_THAT(test::message_of([&] {
                DumpReader({a, s.write("b.dump", text_frame(7, 1, "x", "1\n"))});
              }),
              HasSubstr("b.dump:9: step 7 is also in a.dump"));
  const auto reading = [&](const std::string& rows, const std::string& column) {
    const DumpReader reader({s.write("r.dump", text_frame(7, 2, "x radius", rows))});
    return test::message_of([&] { all(reader.frames()[0], {column}); });
  };
  EXPECT_THAT(reading("1 2\n3 4\n", "radius"), "");
  EXPECT_THAT(reading("1 2\n3 4x\n", "radius"),
              HasSubstr("r.dump:11: radius '4x' is not a number"));
  EXPECT_THAT(reading("1 2\n3\n", "x"), HasSubstr("r.dump:11: 1 values, but 2 columns"));
  EXPECT_THAT(reading("1 2 3\n3 4\n", "x"), HasSubstr("r.dump:10: more values"));
  EXPECT_THAT(reading("nan 2\n3 4\n", "x"), HasSubstr("r.dump:10: x 'nan'"));
  EXPECT_THAT(reading("1 2\n3 4\n", "vx"), HasSubstr("r.dump:9: particles without vx"));
}

// As vtkXMLPolyDataWriter of VTK 9.1 wrote it: 5 points (i, 2i, 0.5), radius 0.1 (i + 1), id i + 1,
// v (i, 0, -i).
constexpr const char* kBinaryXml = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
  <PolyData>
    <Piece NumberOfPoints="5" NumberOfVerts="5" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0">
      <PointData>
        <DataArray type="Float64" Name="radius" format="binary" RangeMin="0.1" RangeMax="0.5">
          KAAAAJqZmZmZmbk/mpmZmZmZyT80MzMzMzPTP5qZmZmZmdk/AAAAAAAA4D8=
        </DataArray>
        <DataArray type="Int32" Name="id" format="binary" RangeMin="1" RangeMax="5">
          FAAAAAEAAAACAAAAAwAAAAQAAAAFAAAA
        </DataArray>
        <DataArray type="Float64" Name="v" NumberOfComponents="3" format="binary">
          eAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAAAAAAAAAAAADwvwAAAAAAAABAAAAAAAAAAAAAAAAAAAAAwAAAAAAAAAhAAAAAAAAAAAAAAAAAAAAIwAAAAAAAABBAAAAAAAAAAAAAAAAAAAAQwA==
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0
            </Value>
          </InformationKey>
        </DataArray>
      </PointData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="binary">
          PAAAAAAAAAAAAAAAAAAAPwAAgD8AAABAAAAAPwAAAEAAAIBAAAAAPwAAQEAAAMBAAAAAPwAAgEAAAABBAAAAPw==
        </DataArray>
      </Points>
    </Piece>
  </PolyData>
</VTKFile>
)";

void expect_five(const DumpFrame& frame) {
  EXPECT_EQ(frame.step, 7);
  EXPECT_EQ(frame.particles, 5u);
  const auto c = all(frame, {"y", "vz", "id", "radius"});
  for (std::size_t i = 0; i < 5; ++i) {
    const auto k = static_cast<double>(i);
    EXPECT_DOUBLE_EQ(c[0][i], 2 * k);
    EXPECT_DOUBLE_EQ(c[1][i], -k);
    EXPECT_DOUBLE_EQ(c[2][i], k + 1);
    EXPECT_NEAR(c[3][i], 0.1 * (k + 1), 1e-15);
  }
}

TEST(VtkDump, XmlBinary) {
  const Scratch s;
  expect_five(DumpReader({s.write("b_7.vtp", kBinaryXml)}).frames().at(0));
}

TEST(VtkDump, XmlAscii) {
  const Scratch s;
  const char* text = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
  <PolyData><Piece NumberOfPoints="5" NumberOfVerts="5" NumberOfPolys="0">
      <PointData>
        <DataArray type="Int32" Name="id" format="ascii">1 2 3 4
          5</DataArray>
        <DataArray type="Float64" Name="v" NumberOfComponents="3" format="ascii">
          0 0 0 1 0 -1 2 0 -2 3 0 -3 4 0 -4
        </DataArray>
        <DataArray type="Float64" Name="radius" format="ascii">0.1 0.2 0.3 0.4 0.5</DataArray>
      </PointData>
      <Points><DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
          0 0 .5 1 2 .5 2 4 .5 3 6 .5 4 8 .5
      </DataArray></Points>
      <Verts><DataArray type="Int64" Name="offsets" format="ascii">1 2 3 4 5</DataArray></Verts>
  </Piece></PolyData>
</VTKFile>
)";
  expect_five(DumpReader({s.write("rocks_7.vtp", text)}).frames().at(0));
}

/// The same in the legacy format, ascii, of VTK 4.2 or 5.1.
std::string legacy(bool new_cells) {
  return std::string("# vtk DataFile Version ") + (new_cells ? "5.1" : "4.2") +
         "\nGenerated by LIGGGHTS\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
         "0 0 0.5 1 2 0.5 2 4 0.5 \n3 6 0.5 4 8 0.5 \nMETADATA\nINFORMATION 0\n\n" +
         (new_cells
              ? "VERTICES 6 5\nOFFSETS vtktypeint64\n0 1 2 3 4 5 \nCONNECTIVITY vtktypeint64\n"
                "0 1 2 3 4 \n"
              : "VERTICES 5 10\n1 0 \n1 1 \n1 2 \n1 3 \n1 4 \n\n") +
         "POINT_DATA 5\nSCALARS radius double 1\nLOOKUP_TABLE default\n0.1 0.2 0.3 0.4 0.5\n"
         "VECTORS v double\n0 0 0 1 0 -1 2 0 -2 3 0 -3 4 0 -4\n"
         "FIELD FieldData 1\nid 1 5 int\n1 2 3 4 5 \nMETADATA\nINFORMATION 0\n\n";
}

TEST(VtkDump, LegacyAscii) {
  const Scratch s;
  expect_five(DumpReader({s.write("a_7.vtk", legacy(true))}).frames().at(0));
  expect_five(DumpReader({s.write("b_7.vtk", legacy(false))}).frames().at(0));
}

TEST(VtkDump, LegacyBinary) {
  const Scratch s;
  for (const bool new_cells : {true, false}) {
    const std::string cells =
        new_cells ? "VERTICES 6 5\nOFFSETS vtktypeint64\n" +
                        big_endian<std::int64_t>({0, 1, 2, 3, 4, 5}) +
                        "\nCONNECTIVITY vtktypeint64\n" + big_endian<std::int64_t>({0, 1, 2, 3, 4})
                  : "VERTICES 5 10\n" + big_endian<std::int32_t>({1, 0, 1, 1, 1, 2, 1, 3, 1, 4});
    const std::string bytes =
        std::string("# vtk DataFile Version 5.1\nvtk output\nBINARY\nDATASET POLYDATA\n") +
        "POINTS 5 float\n" + big_endian<float>({0, 0, .5, 1, 2, .5, 2, 4, .5, 3, 6, .5, 4, 8, .5}) +
        "\n" + cells + "\nPOINT_DATA 5\nFIELD FieldData 3\nradius 1 5 double\n" +
        big_endian<double>({.1, .2, .3, .4, .5}) + "\nid 1 5 int\n" +
        big_endian<std::int32_t>({1, 2, 3, 4, 5}) + "\nMETADATA\nINFORMATION 0\n\nv 3 5 double\n" +
        big_endian<double>({0, 0, 0, 1, 0, -1, 2, 0, -2, 3, 0, -3, 4, 0, -4}) + "\n";
    expect_five(DumpReader({s.write("b_7.vtk", bytes)}).frames().at(0));
    const std::string cut = bytes.substr(0, bytes.size() - 40);
    EXPECT_THAT(
        test::message_of([&] { DumpReader({s.write("cut_7.vtk", cut)}); }),
        HasSubstr("'v' says it has 5 x 3 values; 81 bytes are left of the file: cut short"));
  }
}

TEST(VtkDump, WhatIsWrongIsReportedWithFileAndLine) {
  const Scratch s;
  const auto reading = [&](const std::string& name, const std::string& bytes) {
    return test::message_of([&] {
      const DumpReader reader({s.write(name, bytes)});
      all(reader.frames()[0], {"x", "radius"});
    });
  };
  const std::string xml = kBinaryXml;
  EXPECT_THAT(reading("cut_7.vtp", xml.substr(0, 900)),
              HasSubstr("cut_7.vtp:14: the file ends before </VTKFile>"));
  std::string zip = xml;
  zip.replace(zip.find("header_type"), 0, "compressor=\"vtkZLibDataCompressor\" ");
  EXPECT_THAT(reading("zip_7.vtp", zip), HasSubstr("zip_7.vtp:2: compressed"));
  std::string bare = xml;
  bare.replace(bare.find("\"radius\""), 8, "\"radio\"");
  EXPECT_THAT(reading("bare_7.vtp", bare), HasSubstr("bare_7.vtp:22: particles without radius"));
  EXPECT_THAT(reading("noname.vtp", xml), HasSubstr("no time step in the name"));
  EXPECT_THAT(reading("a_7.vtk", legacy(true).substr(0, legacy(true).find("2 3 4 5 \nMETA"))),
              HasSubstr("cut short"));
  EXPECT_THAT(reading("t_7.vtk", "ITEM: TIMESTEP\n"), HasSubstr("t_7.vtk:2: not a VTK file"));
}

TEST(DumpReader, TenMillionParticlesTakeNoMemory) {
  const Scratch s;
  constexpr std::size_t kBlock = 10'000, kBlocks = 1'000;
  std::string block;
  for (std::size_t i = 0; i < kBlock; ++i)
    block += std::to_string(i) + " 1 " + std::to_string(i % 7) + ".5 -2 0.25 0.2\n";
  const fs::path file =
      s.write("rocks_0.dump", text_frame(0, kBlock * kBlocks, "id type x y z radius", ""));
  {
    std::ofstream out(file, std::ios::binary | std::ios::app);
    for (std::size_t b = 0; b < kBlocks; ++b) out << block;
  }
  const long before = peak_kB();
  const DumpReader reader({file});
  double radius = 0, x = 0;
  std::size_t rows = 0;
  DumpReader::read(reader.frames().at(0), {"x", "radius"}, [&](const ParticleChunk& chunk) {
    for (std::size_t i = 0; i < chunk.rows; ++i) {
      x += chunk.columns[0][i];
      radius += chunk.columns[1][i];
    }
    rows += chunk.rows;
  });
  EXPECT_EQ(rows, 10'000'000u);
  // i mod 7 over 0 ... 9999 sums to 1428 * 21 + 0 + 1 + 2 + 3.
  EXPECT_NEAR(x, (1428 * 21 + 6 + 0.5 * kBlock) * kBlocks, 1e-3);
  EXPECT_NEAR(radius, 2e6, 1e-3);
  RecordProperty("extra_kB", static_cast<int>(peak_kB() - before));
  EXPECT_LT(peak_kB() - before, 8 * 1024) << "kB more than before, for a file of 250 MB";
}

}  // namespace
}  // namespace dipper::analysis::io
