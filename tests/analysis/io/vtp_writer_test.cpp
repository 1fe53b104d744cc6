#include "analysis/io/vtp_writer.hpp"

#include <gtest/gtest.h>

#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::io {
namespace {

using Type = VtkArray::Type;

/// Points (i, 2i, -i), and numbers of two types under a name that XML has to escape.
VtpWriter points(std::size_t n, const std::string& name) {
  VtpWriter w(n, n, 0);
  w.add("PointData", {name, Type::i32, 1, n}, [n](const auto& put) {
    for (std::size_t i = 0; i < n; ++i) put(static_cast<double>(i) - 1);
  });
  w.add("PointData", {"wide", Type::i64, 1, n}, [n](const auto& put) {
    for (std::size_t i = 0; i < n; ++i) put(5e9);
  });
  w.add("Points", {"Points", Type::f32, 3, n}, [n](const auto& put) {
    for (std::size_t i = 0; i < n; ++i)
      for (const double k : {1.0, 2.0, -1.0}) put(k * static_cast<double>(i));
  });
  return w;
}

TEST(VtpWriter, IsReadBackWhateverTheNumberOfValues) {
  const Scratch s;
  const std::string name = "a <b> & \"c\"";
  for (const std::size_t n : {0U, 1U, 2U, 3U, 1023U, 4096U, 10000U}) {
    const auto file = s.folder() / "p_1.vtp";
    points(n, name).write(file);
    const VtkFile vtk = index_vtk(file);
    ASSERT_NE(vtk.point_array(name), nullptr);
    EXPECT_EQ(vtk.points.tuples, n);
    const auto numbers = read_array(vtk, *vtk.point_array(name));
    const auto wide = read_array(vtk, *vtk.point_array("wide"));
    const auto xyz = read_array(vtk, vtk.points);
    ASSERT_EQ(xyz.size(), 3 * n);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(numbers[i], static_cast<double>(i) - 1);
      EXPECT_EQ(wide[i], 5e9);
      EXPECT_EQ(xyz[3 * i + 2], -static_cast<double>(i));
    }
  }
}

TEST(VtpWriter, MillionsOfValuesTakeNoMemoryWrittenOrRead) {
  const Scratch s;
  const auto file = s.folder() / "p_1.vtp";
  const long before = peak_kB();
  points(2'000'000, "id").write(file);  // 64 MB
  const VtkFile vtk = index_vtk(file);
  VtkCursor xyz(vtk, vtk.points);
  double last = 0;
  for (std::size_t i = 0; i < 3 * vtk.points.tuples; ++i) xyz.read(&last, 1);
  EXPECT_EQ(last, -1'999'999);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(peak_kB() - before, 8'000);
#endif
}

TEST(VtpWriter, AFullDiskIsAnError) {
  EXPECT_THROW(points(100'000, "id").write("/dev/full"), std::runtime_error);
}

}  // namespace
}  // namespace dipper::analysis::io
