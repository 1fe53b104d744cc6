// The shovel's dimensions, masses, ropes and limits, as read from mbs/*.yaml.
#pragma once

#include <filesystem>
#include <string>

#include "common/frames.hpp"

namespace dipper::machine {

/// SI and radians, whatever the file's units. The frames H, A, B, D are explained in the file.
struct MachineData {
  std::string machine;

  struct House {
    double mass;           ///< kg
    double swing_inertia;  ///< kg m^2 about the swing axis
  } house;

  struct Boom {
    Vector3d point;         ///< p_HP, m: centre of the boom-point sheaves' axis
    double sheave_radius;   ///< m
    double sheave_mass;     ///< kg, both together
    double sheave_inertia;  ///< kg m^2, both together, about their axis
  } boom;

  struct Saddle {
    Vector3d position;  ///< p_HS, m
    double mass;        ///< kg
    double inertia;     ///< kg m^2 about the pivot, every axis
    double damping;     ///< N m s/rad
  } saddle;

  struct Handle {
    double reach_at_zero_crowd;  ///< m, saddle to the handle's dipper end
    double mass;                 ///< kg
    double mass_center;          ///< m along A's x, from the dipper end
    Vector3d inertia;            ///< kg m^2 about the mass centre, axes of A
  } handle;

  struct Dipper {
    double struck_volume;             ///< m^3
    Vector3d inside;                  ///< m: depth, width, height
    double tooth_reach;               ///< m beyond the lip
    double base_rake;                 ///< rad
    Vector3d handle_end;              ///< p_BE, m
    Vector3d bail;                    ///< p_BL, m, left bail pin; the right one is at -y
    double mass;                      ///< kg without the door
    Vector3d mass_center;             ///< p_BBcm, m
    Vector3d inertia;                 ///< kg m^2 about the mass centre, axes of B
    double rated_load = 0;            ///< kg of rock; 0: not known
    bool rated_load_assumed = false;  ///< no maker's figure: its source begins with "assumed"
  } dipper;

  struct Door {
    Vector3d hinge;        ///< p_BD, m
    double mass;           ///< kg
    Vector3d mass_center;  ///< p_DDcm, m
    Vector3d inertia;      ///< kg m^2 about the mass centre, axes of D
  } door;

  struct Rope {
    double axial_stiffness;       ///< EA of one rope, N
    double elastic_fraction;      ///< of the free length that stretches
    double damping;               ///< N s/m, one rope
    Vector3d drum;                ///< p_HW, m, where the left rope leaves its drum
    double length_at_zero_hoist;  ///< m from there to the bail, unstretched
    /// How they are computed: elastic throughout, or rigid over the sheave with elements below it.
    bool segmented = false;
    int elements = 19;           ///< of one rope, as in Svanberg et al. 2021, Section 3.2
    double mass_per_length = 0;  ///< kg/m, of a segmented one
  } rope;

  /// Limits of the drives: force F at speed v within |F| <= min(stall, power / |v|).
  struct DriveLimit {
    double stall;  ///< N, swing N m
    double power;  ///< W
  };
  struct DriveLimits {
    DriveLimit hoist;      ///< of both ropes together, at the bail
    double hoist_inertia;  ///< kg: inertia of drum and motors, as a mass at the ropes
    DriveLimit crowd;
    DriveLimit swing;
  } drives;

  /// Not in the file: zero for a new machine. A case sets them (machine.crowd_friction_N, ...).
  struct Losses {
    double crowd_friction = 0;  ///< N, of the crowd's slide, against its motion
    double hoist_loss = 0;      ///< of the rope's tension, lost in the sheaves
  } losses;

  struct Limits {
    double hoist_min, hoist_max;    ///< m
    double crowd_min, crowd_max;    ///< m
    double hoist_speed;             ///< m/s
    double crowd_speed;             ///< m/s
    double swing_speed;             ///< rad/s
    double door_min, door_max;      ///< rad
    double saddle_min, saddle_max;  ///< rad above the horizontal
  } limits;
};

/// Drives that follow the motion with any force, or as far as their limits allow.
enum class DriveMode { prescribed, limited };

/// What an operator who plans wants most payload for.
enum class DigGoal { time, energy };

/// Reads the file. Every entry must be there as {value, unit, source} with the unit expected here;
/// unknown keys, keys given twice and numbers out of their range are errors. Throws InputError with
/// every fault and its line.
MachineData load_machine(const std::filesystem::path& file);

}  // namespace dipper::machine
