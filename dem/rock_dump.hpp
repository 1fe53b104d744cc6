// A dump that includes the rock which is parked outside LIGGGHTS.
#pragma once

// LIGGGHTS's headers depend on those before them.
#include <lammps.h>
//
#include <dump_custom.h>

#include <memory>
#include <vector>

#include "dem/row_text.hpp"

namespace dipper::dem {

class ParkedRock;

/// LIGGGHTS's `dump custom`, gzipped into FILE.gz; each rank writes its own rows, by id. Only
/// complete frames appear in the folder. The row of a sphere that leaves LIGGGHTS is kept and
/// written until it returns: parked rock does not move.
class RockDump final : public LAMMPS_NS::DumpCustom {
 public:
  /// Replaces the deck's first `dump custom` with one file for each frame, per-sphere columns only
  /// and no dump_modify. Null if there is none.
  /// Collective.
  static RockDump* of(LAMMPS_NS::LAMMPS& lmp);

  /// The rows of these spheres of this rank, one after the other.
  std::vector<double> rows(std::vector<int> spheres);
  std::size_t width() const { return static_cast<std::size_t>(size_one); }

  /// The source of further rows; null: none.
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
