/// Density control on the device: clones, splits, drops, resets of opacity.
#pragma once

#include "render/Sorter.h"
#include "train/optimize/DeviceScene.h"
#include "train/settings/Settings.h"

#include <vector>

namespace vorion::splat {

/// Adds up views (kernels/batch.cl).
ProgramSpec batchProgram();
/// The programs that density control runs; scan and sort among them.
std::vector<ProgramSpec> densityPrograms();

/// What one view gives density control to note.
struct SeenView {
  cl::Buffer Records;     ///< splat_gaussian of each Gaussian
  cl::Buffer Depths;      ///< their keys: CULLED or above where not seen
  cl::Buffer Gradients;   ///< planes of floats, among them those by
  uint32_t MeanPlane = 0; ///< the projected mean, px: this and the next
  int Width = 0, Height = 0;
};

/// What was noted since the last change; part of a checkpoint.
struct DensityNotes {
  std::vector<float> GradientSums;
  std::vector<uint32_t> Views;
  std::vector<float> Radii;
};

/// What a change did.
struct DensityChange {
  uint32_t Before = 0, After = 0;
  /// Of those before, how many no picture gave a gradient since the change
  /// before this one. Classic density control alone counts them.
  uint32_t WithoutGradient = 0;
};

class DensityControl {
public:
  DensityControl(Launcher &Launch, const TrainSettings &Rules,
                 uint64_t RandomSeed, double CameraExtent)
      : Launch(Launch), Settings(Rules), Seed(RandomSeed), Extent(CameraExtent),
        Sort(Launch) {}

  /// Forgets everything; \p Count Gaussians from now on.
  void restart(uint32_t Count);
  void note(const SeenView &V, uint32_t Count);
  /// What \c note would add to nothing, for another process, whose \c merge has
  /// the effect of \c note to the bit.
  DensityNotes noteAlone(const SeenView &V, uint32_t Count);
  void merge(const DensityNotes &OfAView);
  /// Clones, splits and drops by what was noted, and begins to note anew.
  /// Moments of what is kept are kept; new Gaussians begin with 0. The random
  /// numbers depend on seed, iteration and the Gaussian's identity only.
  DensityChange densify(DeviceScene &S, unsigned Iteration);
  /// Opacities down to at most Settings.ResetOpacity, their moments to 0.
  void resetOpacity(DeviceScene &S);

  DensityNotes save(uint32_t Count) { return download(Noted, Count); }
  void restore(const DensityNotes &Notes) { Noted = upload(Notes); }

private:
  /// On the device.
  struct Notebook {
    cl::Buffer GradientSums, Views, Radii;
  };
  Notebook upload(const DensityNotes &N);
  DensityNotes download(const Notebook &From, uint32_t Count);
  void note(const Notebook &In, const SeenView &V, uint32_t Count);
  uint32_t decide(const DeviceScene &S, unsigned Iteration);
  uint32_t withoutGradient(uint32_t Count);
  uint32_t total(const cl::Buffer &Counts, uint32_t Count);
  void limit(uint32_t Count, uint32_t Total);
  cl::Buffer words(std::string_view What, uint64_t N) {
    return Launch.allocate(What, 4 * N);
  }

  Launcher &Launch;
  const TrainSettings &Settings;
  uint64_t Seed;
  double Extent;
  Sorter Sort;
  Notebook Noted;
  cl::Buffer Fates, Counts, Places, Keys, Order;
};

} // namespace vorion::splat
