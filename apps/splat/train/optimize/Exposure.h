/// The exposure of each training picture, which is learned with the scene.
#pragma once

#include "device/Launcher.h"
#include "train/optimize/HostAdam.h"
#include "train/settings/Settings.h"

#include <array>
#include <vector>

namespace vorion::splat {

ProgramSpec exposureProgram();

/// From the scene's colours to a picture's: rows of red, green and blue, each
/// the factors of red, green, blue and 1.
using ExposureMatrix = std::array<double, 12>;

/// A matrix for each training picture; their mean is the identity, so that the
/// scene keeps the mean exposure, with which held-out views are drawn.
class Exposures {
public:
  Exposures(Launcher &Launch, const TrainSettings &Rules, std::size_t Pictures)
      : Launch(Launch), Settings(Rules), Pictures(Pictures) {
    restart();
  }

  bool areOn() const { return isExposureOn(Settings); }
  /// All are the identity.
  void restart();

  /// The picture number \p View as its exposure has it, from \p Picture of four
  /// floats a pixel.
  cl::Buffer apply(const cl::Buffer &Picture, uint32_t Pixels,
                   std::size_t View);
  /// \p Gradient by the picture that \c apply gave becomes that by \p Picture;
  /// gives that by the matrix.
  ExposureMatrix back(const cl::Buffer &Picture, const cl::Buffer &Gradient,
                      uint32_t Pixels, std::size_t View);

  struct Slope {
    std::size_t View;
    ExposureMatrix Gradient;
  };
  /// A step of Adam by the mean of \p Slopes; then the mean is the identity
  /// again. On the host, in double, rounded to floats.
  void step(const std::vector<Slope> &Slopes, unsigned Iteration);

  /// Matrices and both moments, 12 floats a picture each; nothing if off.
  std::vector<float> save() const { return State.save(); }
  /// What \c save gave; the identity if it was for other pictures.
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
