// Removes rock from LIGGGHTS and puts it back unchanged.
#pragma once

#include <unordered_map>
#include <vector>

#include "dem/bytes.hpp"
#include "dem/hold_policy.hpp"

namespace LAMMPS_NS {
class LAMMPS;
class FixMultisphere;
class FixContactHistory;
class Multisphere;
}  // namespace LAMMPS_NS

namespace dipper::dem {

class RockDump;

/// The fix that moves the multispheres; null when the deck has none.
LAMMPS_NS::FixMultisphere* multisphere_of(LAMMPS_NS::LAMMPS& lmp);

/// Packs a multisphere of this rank as for migration, and unpacks it.
std::vector<double> packed_body(LAMMPS_NS::Multisphere& bodies, int body);
void add_body(LAMMPS_NS::Multisphere& bodies, std::vector<double> packed);

/// Rebuilds LIGGGHTS's maps of ids for its spheres and multispheres. Its own maps reach to the
/// largest id so far, which after a resume may be less than that of rock that is put back.
/// Collective.
void renew_maps(LAMMPS_NS::LAMMPS& lmp);

/// Numbers of the rocks: a single sphere's is its id, a multisphere's follows on the largest id.
/// The same on every rank, and for as long as no rock is inserted.
class RockNumbers {
 public:
  /// Collective.
  explicit RockNumbers(LAMMPS_NS::LAMMPS& lmp);
  explicit RockNumbers(ByteReader& in);
  void save(ByteWriter& out) const;
  std::size_t size() const { return size_; }
  std::size_t of_body(int tag) const { return spheres_ + static_cast<std::size_t>(tag); }
  /// The rock of the sphere with this id.
  std::size_t of_sphere(int tag) const { return rock_[static_cast<std::size_t>(tag)]; }

 private:
  std::size_t spheres_ = 0, size_ = 0;
  std::vector<std::size_t> rock_;
};

/// A sphere leaves and returns as one that migrates between ranks does: with all that every fix
/// keeps of it, its wall contacts included. Contact history is kept by both partners, each under
/// the other's id; the partner that stays would lose its half when the lists are built, so it is
/// kept here.
class ParkedRock {
 public:
  struct Sphere {
    std::size_t rock;
    Vector3d p_W;
    double radius_m;
    std::vector<double> packed;
    std::vector<double> shown;  ///< its row in the dump, if any
  };
  /// A rock's mass, where it is weighed.
  struct Mass {
    std::size_t rock;
    Vector3d p_W;
    double mass_kg;
    std::vector<double> packed;  ///< of a body; a single sphere's is with the sphere
  };

  /// \param dump  that shows it; null for none
  ParkedRock(LAMMPS_NS::LAMMPS& lmp, const RockNumbers& numbers, RockDump* dump);
  ~ParkedRock();
  ParkedRock(const ParkedRock&) = delete;
  ParkedRock& operator=(const ParkedRock&) = delete;

  /// Leaves in LIGGGHTS exactly the rock that is not `parked` in `rest`. Call between the storing
  /// of contact history (Modify::setup_pre_exchange) and the building of lists, both by the caller.
  void change(const std::vector<Rest>& rest);

  void save(ByteWriter& out) const;
  void load(ByteReader& in);

  const std::vector<Sphere>& spheres() const { return spheres_; }
  const std::vector<Mass>& masses() const { return masses_; }

 private:
  void take_out(const std::vector<Rest>& rest);
  void put_back(const std::vector<Rest>& rest);
  void keep_history(const std::vector<Rest>& rest);

  /// Partner's id, and the history with it.
  using History = std::vector<std::pair<int, std::vector<double>>>;

  LAMMPS_NS::LAMMPS& lmp_;
  const RockNumbers& numbers_;
  RockDump* dump_;
  LAMMPS_NS::FixMultisphere* bodies_;
  LAMMPS_NS::FixContactHistory* history_;
  std::vector<Sphere> spheres_;
  std::vector<Mass> masses_;
  std::unordered_map<int, History> kept_;  ///< by sphere id: contacts with a parked partner
};

}  // namespace dipper::dem
