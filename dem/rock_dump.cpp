#include "dem/rock_dump.hpp"

#include <atom.h>
#include <domain.h>
#include <fmt/format.h>
#include <output.h>
#include <update.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>

#include "common/draft_file.hpp"
#include "dem/deflated.hpp"
#include "dem/parked_rock.hpp"

namespace dipper::dem {
namespace {

std::vector<std::string> words_of(const char* text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

double smallest_radius(const LAMMPS_NS::LAMMPS& lmp) {
  const LAMMPS_NS::Atom& atom = *lmp.atom;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < atom.nlocal; ++i) least = std::min(least, atom.radius[i]);
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, lmp.world);
  return least;
}

// zlib's highest level at which a frame takes no longer than LIGGGHTS's own text
// (docs/benchmarks.md, "Frames").
constexpr int kLevel = 4;

/// The size of a rank's part, sent before the part.
struct Part {
  std::uint64_t bytes, length;
  std::uint32_t crc;
};

}  // namespace

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

// A class can read a protected member of another object of its base through a pointer to its own
// member.
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
  const std::vector<std::string> columns = words_of(dump.*(&RockDump::columns));
  words.insert(words.end(), columns.begin(), columns.end());
  std::vector<char*> args;
  for (auto& w : words) args.push_back(w.data());
  auto* own = new RockDump(&lmp, static_cast<int>(args.size()), args.data());
  own->init();
  own->text_ = std::make_unique<RowText>(columns, smallest_radius(lmp));
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

std::string RockDump::header(LAMMPS_NS::bigint spheres) {
  char* text = nullptr;
  std::size_t size = 0;
  fp = open_memstream(&text, &size);
  if (fp == nullptr) throw std::bad_alloc();
  write_header(spheres);
  std::fclose(fp);
  fp = nullptr;
  std::string out(text, size);
  std::free(text);
  return out;
}

std::string RockDump::file_now() const {
  std::string name = filename;
  return name.replace(name.find('*'), 1, std::to_string(update->ntimestep)) + ".gz";
}

void RockDump::write() {
  std::tie(boxxlo, boxylo, boxzlo) =
      std::tuple(domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]);
  std::tie(boxxhi, boxyhi, boxzhi) =
      std::tuple(domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]);
  LAMMPS_NS::bigint all = count();
  std::vector<double> packed(static_cast<std::size_t>(all) * width());
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  double* const kept = buf;
  buf = packed.data();
  pack(nullptr);
  buf = kept;
  const Deflated mine = deflated((me == 0 ? header(all) : "") + text_->of(packed), kLevel);
  if (mine.bytes.size() > std::numeric_limits<int>::max())
    throw std::runtime_error(
        fmt::format("{}: a rank's part of it is {} bytes, and MPI sends 2^31; use more ranks",
                    file_now(), mine.bytes.size()));
  const Part own{mine.bytes.size(), mine.length, mine.crc};
  std::vector<Part> parts(static_cast<std::size_t>(nprocs));
  MPI_Gather(&own, sizeof own, MPI_BYTE, parts.data(), sizeof own, MPI_BYTE, 0, world);
  if (me != 0) {
    MPI_Send(mine.bytes.data(), static_cast<int>(mine.bytes.size()), MPI_BYTE, 0, 0, world);
    return;
  }
  const DraftFile draft(file_now());
  std::ofstream out(draft.path(), std::ios::binary);
  out << gzip_head() << mine.bytes;
  GzipTail tail;
  tail.add(own.length, own.crc);
  for (int rank = 1; rank < nprocs; ++rank) {
    const Part& part = parts[static_cast<std::size_t>(rank)];
    std::string bytes(part.bytes, '\0');
    MPI_Recv(bytes.data(), static_cast<int>(part.bytes), MPI_BYTE, rank, 0, world,
             MPI_STATUS_IGNORE);
    out << bytes;
    tail.add(part.length, part.crc);
  }
  out << tail.bytes();
  out.close();
  std::error_code failed;
  if (out) draft.keep(failed);
  if (!out || failed)
    throw std::runtime_error(file_now() +
                             ": cannot be written; is the disk full, or the folder not yours?");
}

}  // namespace dipper::dem
