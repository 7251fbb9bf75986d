/// Density control by Markov chain Monte Carlo (Kheradmand et al. 2024, as in
/// gsplat): relocation, sampling, random steps. Kernels are in kernels/mcmc.cl.
#pragma once

#include "render/Sorter.h"
#include "train/optimize/Density.h"
#include "train/optimize/DeviceScene.h"
#include "train/settings/Settings.h"

#include <vector>

namespace vorion::splat {

ProgramSpec mcmcProgram();

/// Also needs the programs scan and sort. Random numbers depend on seed,
/// iteration and the identity of the Gaussian or the index of the sample.
class McmcControl {
public:
  McmcControl(Launcher &Launch, const TrainSettings &Rules, uint64_t RandomSeed)
      : Launch(Launch), Settings(Rules), Seed(RandomSeed), Sort(Launch) {}

  /// Relocates nearly transparent Gaussians to positions sampled by opacity,
  /// then samples new Gaussians, up to Settings.MostGaussians. Moments of
  /// relocated Gaussians, of their targets and of new Gaussians are 0.
  DensityChange change(DeviceScene &S, unsigned Iteration);
  /// Adds a random step to each Gaussian, of up to \p Rate times the
  /// covariance.
  void addNoise(DeviceScene &S, unsigned Iteration, double Rate);

private:
  /// Samples: the source Gaussians, and the count of each.
  struct Draw {
    cl::Buffer Sources, Drawn;
  };
  struct Weights {
    cl::Buffer Sums, Dead;
    uint32_t Total = 0;
  };
  /// Weights of the Gaussians whose logit is above \p DeadLogit.
  Weights weigh(const DeviceScene &S, float DeadLogit);
  Draw draw(const DeviceScene &S, const Weights &W, uint32_t Draws,
            uint32_t Kind, unsigned Iteration);
  void share(DeviceScene &S, const Draw &D);
  void relocate(DeviceScene &S, unsigned Iteration);
  void grow(DeviceScene &S, uint32_t After, unsigned Iteration);
  void identify(const cl::Buffer &Identities, const Draw &D,
                const cl::Buffer *List, uint32_t Count, uint32_t Draws,
                unsigned Iteration);
  uint32_t total(const cl::Buffer &Values, const cl::Buffer &Sums,
                 uint32_t Count);
  cl::Buffer words(std::string_view What, uint64_t N) {
    return Launch.allocate(What, 4 * N);
  }
  uint32_t seedLow() const { return static_cast<uint32_t>(Seed); }
  uint32_t seedHigh() const { return static_cast<uint32_t>(Seed >> 32); }

  Launcher &Launch;
  const TrainSettings &Settings;
  uint64_t Seed;
  Sorter Sort;
};

} // namespace vorion::splat
