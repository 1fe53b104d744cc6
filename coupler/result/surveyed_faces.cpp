#include "coupler/result/surveyed_faces.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/signals/phases.hpp"
#include "common/height_map.hpp"
#include "common/input_error.hpp"
#include "common/json_text.hpp"
#include "common/text_file.hpp"

namespace dipper::result {
namespace fs = std::filesystem;
namespace {

struct Face {
  HeightMap map;
  double t_s;
  Vector3d axis_W;
};

Face read_face(const fs::path& file) {
  try {
    const nlohmann::json j = read_json(file);
    return {
        height_map_from(j.dump()), j.at("t_s"), {j.at("axis_m").at(0), j.at("axis_m").at(1), 0}};
  } catch (const std::exception& e) {
    throw InputError({{file, 0, "", fmt::format("is not the face of a run: {}", e.what())}});
  }
}

std::string rows_of(const Face& face, double heading_rad, std::size_t pass, int after) {
  Pose X_WBoom;
  X_WBoom.R = from_rotation_vector({0, 0, heading_rad});
  X_WBoom.p = face.axis_W;
  std::string rows;
  for (const Eigen::Vector2d& p : face.map.profile(X_WBoom, kLaneHalf_m))
    rows += fmt::format("{},{:.2f},{:.3f},{}\n", pass, p.x(), p.y(), after);
  return rows;
}

}  // namespace

fs::path face_file(const fs::path& folder, int number) {
  return folder / fmt::format("face_{}.json", number);
}

int keep_faces_until(const fs::path& folder, double t_s) {
  int kept = 0;
  while (fs::exists(face_file(folder, kept)) && read_face(face_file(folder, kept)).t_s <= t_s)
    ++kept;
  for (int k = kept; fs::remove(face_file(folder, k)); ++k) {
  }
  return kept;
}

bool write_profiles(const fs::path& folder, const analysis::signals::DriveSignals& drives,
                    const std::vector<analysis::signals::Pass>& passes, const fs::path& out) {
  std::string rows;
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const fs::path before = face_file(folder, static_cast<int>(k)),
                   after = face_file(folder, static_cast<int>(k) + 1);
    if (!passes[k].dumped || !fs::exists(before) || !fs::exists(after)) break;
    const double heading =
        analysis::signals::dig_heading_rad(drives, passes[k].t_start_s, passes[k].t_end_s);
    rows += rows_of(read_face(before), heading, k + 1, 0);
    rows += rows_of(read_face(after), heading, k + 1, 1);
  }
  if (rows.empty()) return false;
  write_text(out / "profile.csv", "pass,x_m,z_m,after\n" + rows);
  return true;
}

}  // namespace dipper::result
