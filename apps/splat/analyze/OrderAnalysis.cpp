#include "analyze/OrderAnalysis.h"

#include "reference/Projection.h"

#include <cmath>
#include <limits>

namespace vorion::splat {
namespace {

double psnr(const std::vector<glm::dvec3> &A,
            const std::vector<glm::dvec3> &B) {
  double Squares = 0;
  for (std::size_t I = 0; I < A.size(); ++I)
    for (int K = 0; K < 3; ++K)
      Squares += (A[I][K] - B[I][K]) * (A[I][K] - B[I][K]);
  return Squares > 0
             ? -10 * std::log10(Squares / (3 * static_cast<double>(A.size())))
             : std::numeric_limits<double>::infinity();
}

} // namespace

OrderAnalysis analyzeOrder(const reference::Gaussians<double> &G,
                           const reference::Camera<double> &C,
                           const reference::Camera<double> &Other,
                           const reference::Options &O) {
  const auto Splats = reference::project(G, C, O);
  const auto Own = reference::blend(Splats, C.Width, C.Height, O);
  const auto In = [&](const reference::PixelDepth &Depth, uint64_t &Pairs) {
    const auto R = reference::blendInOrder(Splats, C.Width, C.Height, O, Depth);
    Pairs = R.Pairs;
    return OrderChange{R.Turned, psnr(R.Render, Own.Render)};
  };
  OrderAnalysis A;
  A.ByOtherView = In(
      [&](std::size_t I, int, int) {
        double Z = Other.Translation.z;
        for (int K = 0; K < 3; ++K)
          Z += Other.Rotation[K][2] * G.Means[I][K];
        return Z;
      },
      A.Pairs);
  A.AlongRays = In(reference::depthAlongRay(G, C), A.Pairs);
  return A;
}

} // namespace vorion::splat
