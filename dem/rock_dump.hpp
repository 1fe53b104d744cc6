// A dump that shows the rock which is not in LIGGGHTS, too.
#pragma once

// LIGGGHTS's headers count on what comes before them.
#include <lammps.h>
//
#include <dump_custom.h>

#include <memory>
#include <vector>

#include "dem/row_text.hpp"

namespace dipper::dem {

class ParkedRock;

/// LIGGGHTS's `dump custom`, gzipped into FILE.gz: each rank its own rows, by id. A frame is there
/// whole or not at all. Of a sphere that leaves LIGGGHTS its row is kept, and written until it is
/// back: parked rock stands still.
class RockDump final : public LAMMPS_NS::DumpCustom {
 public:
  /// The one in this LIGGGHTS: put in the place of the deck's first `dump custom` that has a file a
  /// frame, columns which a sphere has of itself, and no dump_modify. Null if there is none.
  /// Collective.
  static RockDump* of(LAMMPS_NS::LAMMPS& lmp);

  /// What it would write of these spheres of this rank: a row each, one after the other.
  std::vector<double> rows(std::vector<int> spheres);
  std::size_t width() const { return static_cast<std::size_t>(size_one); }

  /// Whose rows it writes beside LIGGGHTS's own; null for none.
  void show(const ParkedRock* parked) { parked_ = parked; }

  /// Collective. Throws std::runtime_error naming the file, as when the disk is full.
  void write() override;

 private:
  using DumpCustom::DumpCustom;
  static bool is_plain(const DumpCustom& dump);
  static RockDump* in_place_of(const DumpCustom& dump, int every, LAMMPS_NS::LAMMPS& lmp);
  int count() override;
  void pack(int* ids) override;
  std::string header(LAMMPS_NS::bigint spheres);
  std::string file_now() const;

  const ParkedRock* parked_ = nullptr;
  std::unique_ptr<RowText> text_;
};

}  // namespace dipper::dem
