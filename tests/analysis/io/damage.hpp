// Damaged files for the readers of dumps: every one is read, or refused with an InputError.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "analysis/io/dump_folder.hpp"
#include "analysis/io/vtp_writer.hpp"
#include "analysis/rock/rocks.hpp"
#include "analysis/rock/wall_fields.hpp"
#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::io {

/// A sound file and what reads it; the file's name says which of a folder's files it is.
struct Sample {
  std::string name, bytes;
};

/// Numbers that readers trip over, in place of one that is there.
inline const std::vector<std::string>& awkward_numbers() {
  static const std::vector<std::string> numbers = {"0",
                                                   "-1",
                                                   "2147483648",
                                                   "4294967295",
                                                   "9223372036854775807",
                                                   "-9223372036854775808",
                                                   "1e9",
                                                   "1e300",
                                                   "nan",
                                                   "-inf",
                                                   "1e-310",
                                                   "18446744073709551615",
                                                   "",
                                                   "7",
                                                   "1000000000",
                                                   "3.5"};
  return numbers;
}

/// One to four changes: a bit, a byte, a piece left out, doubled or put elsewhere, an end cut off,
/// a number exchanged.
template <typename Random>
std::string damaged(std::string bytes, Random& random) {
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::size_t changes = 1 + below(4);
  for (std::size_t k = 0; k < changes && !bytes.empty(); ++k) {
    const std::size_t at = below(bytes.size()),
                      n = 1 + below(std::min<std::size_t>(64, bytes.size() - at));
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 2:
        bytes.erase(at, n);
        break;
      case 3:
        bytes.insert(below(bytes.size()), bytes.substr(at, n));
        break;
      case 4:
        bytes.resize(at);
        break;
      default: {
        const std::size_t from = bytes.find_first_of("0123456789", at);
        if (from == std::string::npos) break;
        std::size_t to = bytes.find_first_not_of("0123456789.eE+-", from);
        if (to == std::string::npos) to = bytes.size();
        bytes.replace(from, to - from, awkward_numbers()[below(awkward_numbers().size())]);
      }
    }
  }
  return bytes;
}

inline std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Three rocks, or a square wall of two triangles, in every format that is read.
inline std::vector<Sample> samples(const std::filesystem::path& folder) {
  std::vector<Sample> all;
  all.push_back(
      {"rocks_7.dump", text_frame(7, 3, "id type x y z radius density id_multisphere vx vy vz",
                                  "1 1 1 2 0.5 0.1 2500 -1 0 0 0\n"
                                  "2 1 2 2 0.5 0.2 2500 4 0.1 0 0\n"
                                  "3 2 3 2 0.5 0.3 2500 4 0.1 0 0\n")});
  all.push_back({"rocks_7.vtk",
                 "# vtk DataFile Version 5.1\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
                 "0 0 0.5 1 2 0.5 2 4 0.5\nMETADATA\nINFORMATION 0\n\nVERTICES 4 3\n"
                 "OFFSETS vtktypeint64\n0 1 2 3\nCONNECTIVITY vtktypeint64\n0 1 2\nPOINT_DATA 3\n"
                 "SCALARS radius double 1\nLOOKUP_TABLE default\n0.1 0.2 0.3\nVECTORS v double\n"
                 "0 0 0 1 0 -1 2 0 -2\nFIELD FieldData 2\nid 1 3 int\n1 2 3\n"
                 "density 1 3 double\n2500 2500 2500\n"});
  all.push_back(
      {"rocks_8.vtk", "# vtk DataFile Version 4.2\nx\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
                          big_endian<float>({0, 0, .5, 1, 2, .5, 2, 4, .5}) + "\nVERTICES 3 6\n" +
                          big_endian<std::int32_t>({1, 0, 1, 1, 1, 2}) +
                          "\nPOINT_DATA 3\nFIELD FieldData 3\nradius 1 3 double\n" +
                          big_endian<double>({.1, .2, .3}) + "\nid 1 3 int\n" +
                          big_endian<std::int32_t>({1, 2, 3}) + "\ndensity 1 3 double\n" +
                          big_endian<double>({2500, 2500, 2500}) + "\n"});
  VtpWriter rocks(3, 3, 0);
  const auto three = [](double a, double b, double c) {
    return [=](const VtpWriter::Put& put) {
      for (const double v : {a, b, c}) put(v);
    };
  };
  using Type = VtkArray::Type;
  rocks.add("PointData", {"id", Type::i32, 1, 3}, three(1, 2, 3));
  rocks.add("PointData", {"radius", Type::f32, 1, 3}, three(.1, .2, .3));
  rocks.add("PointData", {"density", Type::f32, 1, 3}, three(2500, 2500, 2500));
  rocks.add("Points", {"Points", Type::f32, 3, 3}, [](const VtpWriter::Put& put) {
    for (int i = 0; i < 9; ++i) put(i);
  });
  rocks.write(folder / "made.vtp");
  all.push_back({"rocks_9.vtp", file_bytes(folder / "made.vtp")});
  std::filesystem::remove(folder / "made.vtp");
  all.push_back({"rocks_10.vtp",
                 R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
<PolyData><Piece NumberOfPoints="3" NumberOfPolys="0"><PointData>
<DataArray type="Int32" Name="id" format="ascii">1 2 3</DataArray>
<DataArray type="Float64" Name="density" format="ascii">2500 2500 2500</DataArray>
<DataArray type="Float64" Name="radius" format="ascii">0.1 0.2 0.3</DataArray></PointData><Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">0 0 1 1 0 1 2 0 1
</DataArray></Points></Piece></PolyData></VTKFile>)"});
  all.push_back({"wall_7.vtp",
                 R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
<PolyData><Piece NumberOfPoints="4" NumberOfPolys="2"><CellData>
<DataArray type="Float32" Name="wear" format="ascii">1 2</DataArray></CellData><Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">0 0 1 1 0 1 2 0 1 2 2 1
</DataArray></Points><Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 0 2 3
</DataArray><DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray></Polys></Piece>
</PolyData></VTKFile>)"});
  all.push_back(
      {"wall_7.vtk",
       "# vtk DataFile Version 4.2\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
       "0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 2\n"
       "SCALARS meshid int 1\nLOOKUP_TABLE default\n1 0\nVECTORS f double\n0 0 1 0 1 0\n"});
  all.push_back({"wall_8.vtk",
                 "# vtk DataFile Version 5.1\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
                 "0 0 0 1 0 0 1 1 0 0 1 0\nPOLYGONS 3 6\nOFFSETS vtktypeint64\n0 3 6\n"
                 "CONNECTIVITY vtktypeint64\n0 1 2 0 2 3\nCELL_DATA 2\nFIELD FieldData 1\n"
                 "wear 1 2 float\n1 2\n"});
  all.push_back(
      {"rocks.vtp.series",
       R"({"file-series-version": "1.0", "files": [{"name": "rocks_7.dump", "time": 0.7}]})"});
  return all;
}

/// Reads a file as `dipper report` would. Throws InputError for a damaged one.
inline void read_all(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (name.rfind("wall_", 0) == 0) {
    rock::read_wall_frame(file);
  } else if (file.extension() == ".series") {
    open_dump_folder(file.parent_path(), 0.1);
  } else {
    const DumpReader reader({file});
    for (const DumpFrame& frame : reader.frames())
      rock::for_each_fragment(frame, {}, [](const rock::Fragment&) {});
  }
}

/// Damages a sample and reads it. Returns what went wrong other than an InputError; empty: nothing.
template <typename Random>
std::string try_damage(const Sample& sample, const std::filesystem::path& folder, Random& random) {
  const auto file = folder / sample.name;
  std::ofstream(file, std::ios::binary) << damaged(sample.bytes, random);
  try {
    read_all(file);
  } catch (const InputError& e) {
    if (std::string(e.what()).find(folder.string()) == std::string::npos)
      return std::string("names no file: ") + e.what();
    if (std::string(e.what()).size() > 1000) return "an endless message";
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

}  // namespace dipper::analysis::io
