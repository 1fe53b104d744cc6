#include "dem/place_rocks.hpp"

#include <atom.h>
#include <fix_multisphere.h>
#include <fix_template_multisphere.h>
#include <fix_template_sphere.h>
#include <lammps.h>
#include <modify.h>
#include <particleToInsert_multisphere.h>

#include <cstring>
#include <map>
#include <stdexcept>

#include "dem/parked_rock.hpp"

namespace dipper::dem {
namespace {

using LAMMPS_NS::FixMultisphere;
using LAMMPS_NS::FixTemplateMultisphere;
using LAMMPS_NS::FixTemplateSphere;

/// The template's rock at the origin, not rotated.
LAMMPS_NS::ParticleToInsert& drawn(FixTemplateSphere& kind) {
  kind.randomize_single();
  return *kind.pti;
}

Eigen::Matrix3d columns(const double* x, const double* y, const double* z) {
  Eigen::Matrix3d m;
  m << Eigen::Map<const Vector3d>(x), Eigen::Map<const Vector3d>(y), Eigen::Map<const Vector3d>(z);
  return m;
}

/// The deck's templates.
class Templates {
 public:
  struct Kind {
    std::string name;
    FixTemplateSphere* fix;
    Eigen::Matrix3d principal_axes;  ///< in the template's frame; of a multisphere
  };

  explicit Templates(LAMMPS_NS::LAMMPS& lmp) {
    for (int k = 0; k < lmp.modify->nfix; ++k) {
      LAMMPS_NS::Fix* fix = lmp.modify->fix[k];
      if (auto* clump = dynamic_cast<FixTemplateMultisphere*>(fix)) {
        auto& rock = static_cast<ParticleToInsertMultisphere&>(drawn(*clump));
        clumps_[clump->type()] = {fix->id, clump,
                                  columns(rock.ex_space, rock.ey_space, rock.ez_space)};
      } else if (std::strcmp(fix->style, "particletemplate/sphere") == 0) {
        auto* sphere = static_cast<FixTemplateSphere*>(fix);
        spheres_[drawn(*sphere).atom_type] = {fix->id, sphere, Eigen::Matrix3d::Identity()};
      }
    }
    for (const auto* kinds : {&spheres_, &clumps_})
      for (const auto& entry : *kinds) by_name_[entry.second.name] = entry.second.fix;
  }

  FixTemplateSphere& named(const std::string& name) const { return *found(by_name_, name); }
  const Kind& of_sphere(int atom_type) const { return found(spheres_, atom_type); }
  const Kind& of_clump(int type) const { return found(clumps_, type); }

 private:
  template <class Map, class Key>
  static const typename Map::mapped_type& found(const Map& map, const Key& key) {
    const auto at = map.find(key);
    if (at != map.end()) return at->second;
    if constexpr (std::is_same_v<Key, int>)
      throw std::runtime_error("the deck has no rock template of type " + std::to_string(key));
    else
      throw std::runtime_error("the deck has no rock template '" + key + "'");
  }

  std::map<int, Kind> spheres_, clumps_;
  std::map<std::string, FixTemplateSphere*> by_name_;
};

}  // namespace

void place_rocks(LAMMPS_NS::LAMMPS& lmp, const std::vector<setup::PlacedRock>& rocks) {
  const Templates templates(lmp);
  LAMMPS_NS::Modify* modify = lmp.modify;
  for (int k = 0; k < modify->nfix; ++k)
    if (modify->fix[k]->create_attribute != 0) modify->fix[k]->pre_set_arrays();
  double still[3] = {0, 0, 0};
  for (const setup::PlacedRock& rock : rocks) {
    LAMMPS_NS::ParticleToInsert& placed = drawn(templates.named(rock.kind));
    Vector3d p_W = rock.X_WR.p;
    const Quaterniond& R = rock.X_WR.R;
    double q[4] = {R.w(), R.x(), R.y(), R.z()};
    placed.set_x_v_omega(p_W.data(), still, still, q);
    placed.insert();
  }
  LAMMPS_NS::Atom* atom = lmp.atom;
  atom->tag_extend();
  atom->natoms = atom->nlocal;
  atom->nghost = 0;
  if (FixMultisphere* bodies = multisphere_of(lmp)) {
    atom->map_init();
    atom->map_set();
    bodies->add_body_finalize();
    // Wraps rock that reaches beyond a periodic side of the box: LIGGGHTS does not read it back
    // from a restart file otherwise.
    int one, two;
    bodies->data().remap_bodies(static_cast<int*>(bodies->extract("body", one, two)));
  }
}

std::vector<setup::PlacedRock> placed_rocks(LAMMPS_NS::LAMMPS& lmp) {
  const Templates templates(lmp);
  const LAMMPS_NS::Atom* atom = lmp.atom;
  FixMultisphere* bodies = multisphere_of(lmp);
  std::vector<setup::PlacedRock> rocks;
  for (int i = 0; i < atom->nlocal; ++i)
    if (bodies == nullptr || bodies->belongs_to(i) < 0)
      rocks.push_back({templates.of_sphere(atom->type[i]).name,
                       {Quaterniond::Identity(), Eigen::Map<const Vector3d>(atom->x[i])}});
  if (bodies == nullptr) return rocks;
  LAMMPS_NS::Multisphere& data = bodies->data();
  double** ex = data.extract_double_vector("ex_space");
  double** ey = data.extract_double_vector("ey_space");
  double** ez = data.extract_double_vector("ez_space");
  int one, two;
  const int* type = static_cast<int*>(data.extract("clumptype", one, two));
  for (int b = 0; b < data.n_body(); ++b) {
    const Templates::Kind& kind = templates.of_clump(type[b]);
    Vector3d p_W;
    data.xcm(p_W.data(), b);
    const Eigen::Matrix3d R = columns(ex[b], ey[b], ez[b]) * kind.principal_axes.transpose();
    rocks.push_back({kind.name, {Quaterniond(R).normalized(), p_W}});
  }
  return rocks;
}

}  // namespace dipper::dem
