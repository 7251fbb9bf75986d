/// Corrections of the training pictures' poses, which are learned with the
/// scene.
#pragma once

#include "device/Launcher.h"
#include "io/Cameras.h"
#include "train/optimize/GradientRenderer.h"
#include "train/optimize/HostAdam.h"

#include <array>
#include <vector>

namespace vorion::splat {

ProgramSpec poseProgram();

/// The loss's gradient by a camera's place (x, y, z of the world), and by
/// turning it about its centre, by an axis of the world times an angle.
using PoseSlope = std::array<double, 6>;

/// How far corrections go: angles in radians, shifts in world units.
struct PoseChange {
  double MeanTurn = 0, MostTurn = 0, MeanShift = 0, MostShift = 0;
};

/// Of each picture a shift along its camera's own axes, over the cameras'
/// extent, and a turn by them, an axis times an angle. All together they do not
/// move, turn or scale the cameras: what least squares find of that is taken
/// out after each step, so that scene and held-out views stay where they are.
class Poses {
public:
  /// Of the pictures that \p Given took. With a rate of 0 nothing is corrected.
  Poses(Launcher &Launch, const TrainSettings &Rules, std::vector<Camera> Given,
        double CamerasExtent);

  bool areOn() const { return arePosesOn(Settings); }
  /// Nothing is corrected any more.
  void restart();

  /// The camera of picture number \p View, corrected.
  Camera at(std::size_t View) const;
  /// By its corrected pose, from what the way back from there gave; the
  /// renderer was told to keep what it takes (BackwardOptions::Poses).
  PoseSlope slope(std::size_t View, const PlanePair &Parameters,
                  const GradientRenderer::Backward &Back, uint32_t Count);

  struct Slope {
    std::size_t View;
    PoseSlope Gradient;
  };
  /// A step of Adam by the mean of \p Slopes, on the host in double.
  void step(const std::vector<Slope> &Slopes, unsigned Iteration);

  /// Corrections and both moments, 6 floats a picture each; nothing if off.
  std::vector<float> save() const { return State.save(); }
  /// What \c save gave; no correction if it was for other pictures.
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
