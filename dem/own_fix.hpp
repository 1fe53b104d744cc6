// Adds a fix of Dipper's own to LIGGGHTS.
#pragma once

#include <fix.h>
#include <modify.h>

#include <string>
#include <vector>

namespace dipper::dem {

/// Adds a FixClass(lmp, narg, arg), which LIGGGHTS then owns; `words` are what follows `fix`: its
/// id, its group, and arguments of its own, from arg[5] on.
///
/// Modify creates fixes by style name only, and its table of styles is private. So it makes a fix
/// that does nothing, which is then replaced by ours: Modify treats it like any other.
template <class FixClass>
FixClass* add_own_fix(LAMMPS_NS::LAMMPS* lmp, std::vector<std::string> words) {
  words.insert(words.begin() + 2, {"print", "2000000000", "-"});
  std::vector<char*> args;
  for (auto& w : words) args.push_back(w.data());
  LAMMPS_NS::Modify* modify = lmp->modify;
  modify->add_fix(5, args.data());
  const int slot = modify->find_fix(words[0].c_str());
  auto* fix = new FixClass(lmp, static_cast<int>(args.size()), args.data());
  delete modify->fix[slot];
  modify->fix[slot] = fix;
  modify->fmask[slot] = fix->setmask();
  return fix;
}

}  // namespace dipper::dem
