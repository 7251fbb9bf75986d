/// Density control on the device: cloning, splitting, pruning, opacity resets.
#pragma once

#include "picture/Options.h"
#include "render/Sorter.h"
#include "train/optimize/DeviceScene.h"
#include "train/settings/Settings.h"

#include <vector>

namespace vorion::splat {

/// Sums views (kernels/batch.cl).
ProgramSpec batchProgram();
/// The programs of density control, including scan and sort.
std::vector<ProgramSpec> densityPrograms(RendererKind Of = RendererKind::Splat);

/// The results of a view for the statistics of density control.
struct SeenView {
  cl::Buffer Records;     ///< splat_record of each Gaussian
  cl::Buffer Depths;      ///< their keys: CULLED or above if invisible
  cl::Buffer Gradients;   ///< planes of floats, which include gradients by
  uint32_t MeanPlane = 0; ///< the projected mean, px: this and the next
  int Width = 0, Height = 0;
};

/// The statistics since the last change; part of a checkpoint.
struct DensityNotes {
  std::vector<float> GradientSums;
  std::vector<uint32_t> Views;
  std::vector<float> Radii;
};

/// The result of a change.
struct DensityChange {
  uint32_t Before = 0, After = 0;
  /// Number of Gaussians before the change that have received no gradient since
  /// the previous change. Only classic density control counts them.
  uint32_t WithoutGradient = 0;
};

class DensityControl {
public:
  DensityControl(Launcher &Launch, const TrainSettings &Rules,
                 uint64_t RandomSeed, double CameraExtent)
      : Launch(Launch), Settings(Rules), Seed(RandomSeed), Extent(CameraExtent),
        Sort(Launch) {}

  /// Resets the statistics for \p Count Gaussians.
  void restart(uint32_t Count);
  void note(const SeenView &V, uint32_t Count);
  /// Clones, splits and prunes by the statistics, and resets them. Moments of
  /// remaining Gaussians are kept; those of new Gaussians are 0. Random numbers
  /// depend only on seed, iteration and the identity of the Gaussian.
  DensityChange densify(DeviceScene &S, unsigned Iteration);
  /// Limits opacities to Settings.ResetOpacity, and sets their moments to 0.
  void resetOpacity(DeviceScene &S);

  DensityNotes save(uint32_t Count) { return download(Noted, Count); }
  void restore(const DensityNotes &Notes) { Noted = upload(Notes); }

private:
  /// Statistics on the device.
  struct Notebook {
    cl::Buffer GradientSums, Views, Radii;
  };
  Notebook upload(const DensityNotes &N);
  DensityNotes download(const Notebook &From, uint32_t Count);
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
