#include "train/optimize/Adam.h"

#include "kernels/adam.cl.h"
#include "kernels/regularize.cl.h"
#include "picture/Layout.h"
#include "render/Pipeline.h"

#include <cmath>
#include <optional>
#include <vector>

namespace vorion::splat {

ProgramSpec adamProgram(MomentsOn Where) {
  return kernels::adam::Program{.MOMENTS_BY_PLANE = Where == MomentsOn::Host};
}

ProgramSpec regularizeProgram() { return kernels::regularize::Program{}; }

void regularize(Launcher &L, const TrainSettings &Settings,
                const DeviceScene &S, const PlanePair &Gradients) {
  L.run(
      itemsFor(S.Count), GroupSize,
      kernels::regularize::regularize{
          .geometry = S.Parameters.Geometry,
          .gradients = Gradients.Geometry,
          .count = S.Count,
          .opacity = static_cast<float>(Settings.OpacityWeight / S.Count),
          .scale = static_cast<float>(Settings.ScaleWeight / (3.0 * S.Count))});
}

void stepAdam(Launcher &L, const TrainSettings &Settings, DeviceScene &S,
              const PlanePair &Gradients, unsigned Iteration, double Extent,
              int ActiveDegree) {
  const double First = 1 - std::pow(Settings.Beta1, Iteration);
  const double Rest = 1 - std::pow(Settings.Beta2, Iteration);
  const auto Rate = [&](double R) { return static_cast<float>(R / First); };

  std::vector<float> Geometry(GEOMETRY_PLANES);
  for (std::size_t K = 0; K < 3; ++K) {
    Geometry[PLANE_MEAN + K] = Rate(positionRate(Settings, Iteration) * Extent);
    Geometry[PLANE_LOG_SCALE + K] = Rate(Settings.ScaleRate);
  }
  for (std::size_t K = 0; K < 4; ++K)
    Geometry[PLANE_QUATERNION + K] = Rate(Settings.RotationRate);
  Geometry[PLANE_LOGIT] = Rate(Settings.OpacityRate);
  std::vector<float> Sh(3 * shCoefficients(ActiveDegree),
                        Rate(Settings.LaterColourRate));
  for (std::size_t K = 0; K < 3; ++K)
    Sh[K] = Rate(Settings.ColourRate);

  const auto Step = [&](const std::vector<float> &Rates, const cl::Buffer &P,
                        const cl::Buffer &G, MomentPlanes &M, MomentPlanes &V) {
    const cl::Buffer RateBuffer = L.allocate("rates", 4 * Rates.size());
    L.write("rates", RateBuffer, Rates.data(), 4 * Rates.size());
    const auto Run = [&](const cl::Buffer &First, const cl::Buffer &Second,
                         uint32_t Planes, std::optional<uint32_t> Own) {
      L.run(cl::NDRange(itemsFor(S.Count)[0], Planes),
            cl::NDRange(GroupSize, 1),
            kernels::adam::adam{.parameters = P,
                                .gradients = G,
                                .first = First,
                                .second = Second,
                                .rates = RateBuffer,
                                .count = S.Count,
                                .beta1 = static_cast<float>(Settings.Beta1),
                                .rest1 = static_cast<float>(1 - Settings.Beta1),
                                .beta2 = static_cast<float>(Settings.Beta2),
                                .rest2 = static_cast<float>(1 - Settings.Beta2),
                                .correction =
                                    static_cast<float>(1 / std::sqrt(Rest)),
                                .epsilon = static_cast<float>(Settings.Epsilon),
                                .own_plane = Own});
    };
    MomentPlanes::changeBoth(
        L, M, V, S.Count, static_cast<uint32_t>(Rates.size()),
        [&](const cl::Buffer &OfM, const cl::Buffer &OfV, uint32_t First,
            uint32_t Planes) {
          Run(OfM, OfV, Planes,
              M.areOn() == MomentsOn::Host ? std::optional(First)
                                           : std::nullopt);
        });
  };
  Step(Geometry, S.Parameters.Geometry, Gradients.Geometry, S.First.Geometry,
       S.Second.Geometry);
  Step(Sh, S.Parameters.Sh, Gradients.Sh, S.First.Sh, S.Second.Sh);
}

} // namespace vorion::splat
