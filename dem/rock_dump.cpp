#include "dem/rock_dump.hpp"

#include <output.h>

#include <algorithm>
#include <cstring>
#include <sstream>
#include <string>
#include <tuple>

#include "dem/parked_rock.hpp"

namespace dipper::dem {

RockDump* RockDump::of(LAMMPS_NS::LAMMPS& lmp) {
  const LAMMPS_NS::Output& output = *lmp.output;
  for (int k = 0; k < output.ndump; ++k)
    if (auto* own = dynamic_cast<RockDump*>(output.dump[k])) return own;
  for (int k = 0; k < output.ndump; ++k) {
    auto* theirs = dynamic_cast<DumpCustom*>(output.dump[k]);
    if (theirs == nullptr || !is_plain(*theirs)) continue;
    RockDump* own = in_place_of(*theirs, output.every_dump[k], lmp);
    delete theirs;
    output.dump[k] = own;
    return own;
  }
  return nullptr;
}

// A class may read what is protected in another object of its base through pointers to its own
// members.
bool RockDump::is_plain(const DumpCustom& dump) {
  const bool own_columns = dump.*(&RockDump::ncompute) == 0 && dump.*(&RockDump::nfix) == 0 &&
                           dump.*(&RockDump::nvariable) == 0 &&
                           std::strstr(dump.*(&RockDump::columns), "element") == nullptr;
  const bool modified = dump.*(&RockDump::format_user) != nullptr ||
                        dump.*(&RockDump::sortBuffer) != nullptr ||
                        dump.*(&RockDump::label) != nullptr || dump.*(&RockDump::nthresh) != 0 ||
                        dump.*(&RockDump::iregion) != -1 || dump.*(&RockDump::padflag) != 0 ||
                        dump.*(&RockDump::buffer_flag) != 1;
  return std::strcmp(dump.style, "custom") == 0 && dump.*(&RockDump::multifile) == 1 &&
         dump.igroup == 0 && own_columns && !modified;
}

RockDump* RockDump::in_place_of(const DumpCustom& dump, int every, LAMMPS_NS::LAMMPS& lmp) {
  std::vector<std::string> words = {dump.id, "all", dump.style, std::to_string(every),
                                    dump.*(&RockDump::filename)};
  std::istringstream columns(dump.*(&RockDump::columns));
  for (std::string word; columns >> word;) words.push_back(word);
  std::vector<char*> args;
  for (auto& w : words) args.push_back(w.data());
  auto* own = new RockDump(&lmp, static_cast<int>(args.size()), args.data());
  own->init();
  return own;
}

std::vector<double> RockDump::rows(std::vector<int> spheres) {
  std::vector<double> found(spheres.size() * width());
  const auto kept = std::tuple(buf, clist, nchoose);
  buf = found.data();
  clist = spheres.data();
  nchoose = static_cast<int>(spheres.size());
  DumpCustom::pack(nullptr);
  std::tie(buf, clist, nchoose) = kept;
  return found;
}

int RockDump::count() {
  const std::size_t parked = parked_ == nullptr ? 0 : parked_->spheres().size();
  return DumpCustom::count() + static_cast<int>(parked);
}

void RockDump::pack(int* ids) {
  DumpCustom::pack(ids);
  if (parked_ == nullptr) return;
  double* to = buf + static_cast<std::size_t>(nchoose) * width();
  for (const ParkedRock::Sphere& s : parked_->spheres())
    to = std::copy(s.shown.begin(), s.shown.end(), to);
}

}  // namespace dipper::dem
