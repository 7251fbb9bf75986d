/// The exposures of training pictures, optimized with the scene.
#pragma once

#include "device/Launcher.h"
#include "train/optimize/HostAdam.h"
#include "train/settings/Settings.h"

#include <array>
#include <vector>

namespace vorion::splat {

ProgramSpec exposureProgram();

/// Transforms the scene's colours to those of a picture: rows of red, green and
/// blue, each with the factors of red, green, blue and 1.
using ExposureMatrix = std::array<double, 12>;

/// A matrix for each training picture. Their mean is the identity, so that
/// held-out views are rendered with the mean exposure.
class Exposures {
public:
  Exposures(Launcher &Launch, const TrainSettings &Rules, std::size_t Pictures)
      : Launch(Launch), Settings(Rules), Pictures(Pictures) {
    restart();
  }

  bool areOn() const { return isExposureOn(Settings); }
  /// Sets all to the identity.
  void restart();

  /// Applies the exposure of picture \p View to \p Picture, with four floats
  /// per pixel.
  cl::Buffer apply(const cl::Buffer &Picture, uint32_t Pixels,
                   std::size_t View);
  /// Replaces \p Gradient, by the result of \c apply, by that by \p Picture.
  /// Returns the gradient by the matrix.
  ExposureMatrix back(const cl::Buffer &Picture, const cl::Buffer &Gradient,
                      uint32_t Pixels, std::size_t View);

  struct Slope {
    std::size_t View;
    ExposureMatrix Gradient;
  };
  /// A step of Adam by the mean of \p Slopes, after which the mean is
  /// normalized to the identity. On the host, in double precision, rounded to
  /// floats.
  void step(const std::vector<Slope> &Slopes, unsigned Iteration);

  /// Matrices and both moments, 12 floats per picture each; empty if off.
  std::vector<float> save() const { return State.save(); }
  /// Restores the result of \c save; the identity if the number of pictures
  /// differs.
  void restore(const std::vector<float> &Saved);
  ExposureMatrix matrix(std::size_t View) const;

private:
  cl::Buffer upload(std::size_t View);

  Launcher &Launch;
  const TrainSettings &Settings;
  std::size_t Pictures;
  HostAdam State;
};

} // namespace vorion::splat
