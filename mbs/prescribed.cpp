#include "mbs/prescribed.hpp"

namespace dipper::mbs {
namespace {

class DriveMotion : public SimTK::Motion::Custom::Implementation {
 public:
  DriveMotion(Sent sent, double machine::Drives::*which, double scale)
      : sent_(std::move(sent)), which_(which), scale_(scale) {}

  DriveMotion* clone() const override { return new DriveMotion(*this); }
  SimTK::Motion::Level getLevel(const SimTK::State&) const override {
    return SimTK::Motion::Position;
  }
  void calcPrescribedPosition(const SimTK::State& s, int, double* q) const override {
    q[0] = scale_ * (sent_(s.getTime()).position.*which_);
  }
  void calcPrescribedPositionDot(const SimTK::State& s, int, double* qdot) const override {
    qdot[0] = scale_ * (sent_(s.getTime()).rate.*which_);
  }
  void calcPrescribedPositionDotDot(const SimTK::State& s, int, double* qdotdot) const override {
    qdotdot[0] = scale_ * (sent_(s.getTime()).acceleration.*which_);
  }

 private:
  Sent sent_;
  double machine::Drives::*which_;
  double scale_;
};

}  // namespace

void prescribe(SimTK::MobilizedBody& joint, Sent sent, double machine::Drives::*which,
               double scale) {
  SimTK::Motion::Custom(joint, new DriveMotion(std::move(sent), which, scale));
}

SimTK::Vector drive_forces(const SimTK::SimbodyMatterSubsystem& matter, const SimTK::State& state) {
  SimTK::Vector multipliers;
  matter.findMotionForces(state, multipliers);
  return -multipliers;  // Simbody's appear on the left of M udot + tau = f
}

}  // namespace dipper::mbs
