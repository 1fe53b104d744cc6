#include "coupler/setup/placed_rocks.hpp"

#include <fmt/format.h>

#include <iterator>

#include "common/csv_table.hpp"
#include "common/input_error.hpp"
#include "common/text_file.hpp"

namespace dipper::setup {

void write_placed_rocks(const std::filesystem::path& file, const std::vector<PlacedRock>& rocks) {
  std::string out = "kind,x_m,y_m,z_m,qw,qx,qy,qz\n";
  for (const PlacedRock& rock : rocks) {
    const Vector3d& p = rock.X_WR.p;
    const Quaterniond& q = rock.X_WR.R;
    fmt::format_to(std::back_inserter(out),
                   "{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", rock.kind, p.x(),
                   p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
  }
  write_text(file, out);
}

std::vector<PlacedRock> read_placed_rocks(const std::filesystem::path& file) {
  std::vector<Finding> faults;
  std::vector<PlacedRock> rocks;
  for (const CsvRow& row :
       read_csv(file, {"kind", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}, faults, "kind")) {
    const std::vector<double>& v = row.values;
    rocks.push_back({row.name, {Quaterniond(v[4], v[5], v[6], v[7]), Vector3d(v[1], v[2], v[3])}});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return rocks;
}

}  // namespace dipper::setup
