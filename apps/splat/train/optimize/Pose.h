/// Corrections of the poses of training pictures, optimized with the scene.
#pragma once

#include "device/Launcher.h"
#include "io/Cameras.h"
#include "train/optimize/GradientRenderer.h"
#include "train/optimize/HostAdam.h"

#include <array>
#include <vector>

namespace vorion::splat {

ProgramSpec poseProgram();

/// The gradient of the loss by a camera's position (x, y, z in world
/// coordinates), and by its rotation about its centre (an axis in world
/// coordinates times an angle).
using PoseSlope = std::array<double, 6>;

/// The size of the corrections: angles in radians, translations in world units.
struct PoseChange {
  double MeanTurn = 0, MostTurn = 0, MeanShift = 0, MostShift = 0;
};

/// For each picture, a translation in camera coordinates, divided by the
/// cameras' extent, and a rotation, an axis times an angle. After each step,
/// the common translation, rotation and scaling of all cameras (by least
/// squares) is removed, so that scene and held-out views stay aligned.
class Poses {
public:
  /// For pictures with the cameras \p Given. With a rate of 0 nothing is
  /// corrected.
  Poses(Launcher &Launch, const TrainSettings &Rules, std::vector<Camera> Given,
        double CamerasExtent);

  bool areOn() const { return arePosesOn(Settings); }
  /// Resets all corrections.
  void restart();

  /// The corrected camera of picture \p View.
  Camera at(std::size_t View) const;
  /// The gradient by its corrected pose, computed from the results of the
  /// backward pass, which needs BackwardOptions::Poses.
  PoseSlope slope(std::size_t View, const PlanePair &Parameters,
                  const GradientRenderer::Backward &Back, uint32_t Count);

  struct Slope {
    std::size_t View;
    PoseSlope Gradient;
  };
  /// A step of Adam by the mean of \p Slopes, on the host in double.
  void step(const std::vector<Slope> &Slopes, unsigned Iteration);

  /// Corrections and both moments, 6 floats per picture each; empty if off.
  std::vector<float> save() const { return State.save(); }
  /// Restores the result of \c save; no correction if the number of pictures
  /// differs.
  void restore(const std::vector<float> &Saved);
  PoseChange change() const;

private:
  void settle(std::vector<double> &Stepped) const;

  Launcher &Launch;
  const TrainSettings &Settings;
  std::vector<Camera> Cameras;
  double Extent;
  HostAdam State;
};

} // namespace vorion::splat
