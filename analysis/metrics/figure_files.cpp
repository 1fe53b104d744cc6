#include "analysis/metrics/figure_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "analysis/io/vtp_writer.hpp"
#include "common/mesh/solids.hpp"

namespace dipper::analysis::metrics {
namespace {

using Type = io::VtkArray::Type;

constexpr std::size_t kRopeSides = 6;

/// A mesh with the part number of each triangle.
struct Numbered {
  mesh::TriangleMesh mesh;
  std::vector<int> part;

  void add(const mesh::TriangleMesh& more, int number) {
    append(mesh, more);
    part.resize(mesh.triangles.size(), number);
  }
};

void write(const Numbered& n, const Pose& X_WF, const std::filesystem::path& to) {
  const std::size_t cells = n.mesh.triangles.size();
  io::VtpWriter file(n.mesh.vertices.size(), 0, cells);
  file.add("CellData", {"part", Type::i32, 1, cells}, [&](const auto& put) {
    for (const int part : n.part) put(part);
  });
  file.add("Points", {"Points", Type::f32, 3, n.mesh.vertices.size()}, [&](const auto& put) {
    for (const auto& v : n.mesh.vertices) {
      const Vector3d p = X_WF * v;
      for (int k = 0; k < 3; ++k) put(p[k]);
    }
  });
  file.add("Polys", {"connectivity", Type::i32, 1, 3 * cells}, [&](const auto& put) {
    for (const auto& t : n.mesh.triangles)
      for (const std::size_t corner : t) put(static_cast<double>(corner));
  });
  file.add("Polys", {"offsets", Type::i32, 1, cells}, [&](const auto& put) {
    for (std::size_t i = 1; i <= cells; ++i) put(static_cast<double>(3 * i));
  });
  file.write(to);
}

bool same(const Pose& a, const Pose& b) { return a.p == b.p && a.R.coeffs() == b.R.coeffs(); }

}  // namespace

void write_figure_files(
    const run::Figure& figure, const std::vector<double>& times_s,
    const std::filesystem::path& folder,
    const std::function<void(const std::string&, double, const std::string&)>& list) {
  const auto file_of = [](std::string name, std::size_t k) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return fmt::format("paraview/{}_{}.vtp", name, k);
  };
  for (const run::FigureBody& body : figure.bodies) {
    Numbered shape;
    int number = 0;
    for (const machine::FigurePart& part : body.parts) shape.add(part.mesh, ++number);
    std::optional<Pose> last;
    std::string file;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      const Pose X_WF = body.X_WF(times_s[k]);
      if (!last || !same(*last, X_WF)) {
        file = file_of(body.name, k);
        write(shape, X_WF, folder / file);
      }
      last = X_WF;
      list(body.name, times_s[k], file);
    }
  }
  if (figure.ropes.empty()) return;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    Numbered ropes;
    int number = 0;
    for (const run::FigureRope& rope : figure.ropes)
      ropes.add(mesh::rod(rope.way_W(times_s[k]), rope.radius_m, kRopeSides), ++number);
    const std::string file = file_of("ropes", k);
    write(ropes, Pose{}, folder / file);
    list("ropes", times_s[k], file);
  }
}

}  // namespace dipper::analysis::metrics
