// The moving bodies of the replay as JSON: meshes to the millimetre, poses to a tenth of it.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/run/figure.hpp"
#include "common/frames.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::report {

/// To `per_unit` parts of a unit; the quotient prints short, a product need not.
double rounded(double x, double per_unit);

/// Nine numbers a triangle [m].
nlohmann::json json_of_triangles(const mesh::TriangleMesh& mesh);

/// [px, py, pz, qw, qx, qy, qz]
nlohmann::json json_of_pose(const Pose& X);

/// {bodies: [{name, parts: [{name, triangles_m}], poses}], ropes: [{radius_m, ways}]}. Poses and
/// ways (points [m] in W, x, y and z in turn) are one a time; one alone for a body that never
/// moves.
nlohmann::json json_of_figure(const run::Figure& figure, const std::vector<double>& times_s);

}  // namespace dipper::analysis::report
