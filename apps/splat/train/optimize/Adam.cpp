#include "train/optimize/Adam.h"

#include "picture/Layout.h"
#include "render/Pipeline.h"

#include <cmath>
#include <vector>

namespace vorion::splat {

ProgramSpec adamProgram(MomentsOn Where) {
  ProgramSpec P{AdamProgram, "adam.cl", {}};
  if (Where == MomentsOn::Host)
    P.Defines.emplace_back("MOMENTS_BY_PLANE");
  return P;
}

ProgramSpec regularizeProgram() {
  return {RegularizeProgram, "regularize.cl", {}};
}

void regularize(Launcher &L, const TrainSettings &Settings,
                const DeviceScene &S, const PlanePair &Gradients) {
  L.run(RegularizeProgram, "regularize", itemsFor(S.Count), GroupSize,
        S.Parameters.Geometry, Gradients.Geometry, S.Count,
        static_cast<float>(Settings.OpacityWeight / S.Count),
        static_cast<float>(Settings.ScaleWeight / (3.0 * S.Count)));
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
                         uint32_t Planes, auto... Plane) {
      L.run(AdamProgram, "adam", cl::NDRange(itemsFor(S.Count)[0], Planes),
            cl::NDRange(GroupSize, 1), P, G, First, Second, RateBuffer, S.Count,
            static_cast<float>(Settings.Beta1),
            static_cast<float>(1 - Settings.Beta1),
            static_cast<float>(Settings.Beta2),
            static_cast<float>(1 - Settings.Beta2),
            static_cast<float>(1 / std::sqrt(Rest)),
            static_cast<float>(Settings.Epsilon), Plane...);
    };
    MomentPlanes::changeBoth(L, M, V, S.Count,
                             static_cast<uint32_t>(Rates.size()),
                             [&](const cl::Buffer &OfM, const cl::Buffer &OfV,
                                 uint32_t First, uint32_t Planes) {
                               M.areOn() == MomentsOn::Host
                                   ? Run(OfM, OfV, Planes, First)
                                   : Run(OfM, OfV, Planes);
                             });
  };
  Step(Geometry, S.Parameters.Geometry, Gradients.Geometry, S.First.Geometry,
       S.Second.Geometry);
  Step(Sh, S.Parameters.Sh, Gradients.Sh, S.First.Sh, S.Second.Sh);
}

} // namespace vorion::splat
