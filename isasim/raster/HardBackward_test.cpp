// Numerically hard input of the rasterizer's backward mode: the part of the
// catalogue (docs/numerics.md) that is about its own arithmetic. A scalar fp32
// loop is the contract; the loop with a guard or a rounding changed must
// differ.
#include "raster/BackwardLoop.h"
#include "raster/UnitTables.h"

#include <algorithm>

namespace vorion::raster {
namespace {

/// \p Layers of \p Alpha over a small tile, with a loss that sees the colours:
/// rendered in fp32 without a cut-off.
Scene stackOf(std::size_t Layers, float Alpha) {
  Scene S;
  S.X = S.Y = 0;
  S.Width = 16;
  S.Height = 2;
  float T = 1;
  for (std::size_t I = 0; I != Layers; ++I) {
    Gaussian G{};
    G.Extent[0] = G.Extent[1] = 100;
    G.Opacity = Alpha;
    G.Color[0] = 0.5F;
    S.Gaussians.push_back(G);
    T *= 1.0F - Alpha;
  }
  const std::size_t Pixels = std::size_t{S.Width} * S.Height;
  S.Rendered.assign(Pixels, {0, 0, 0, T});
  S.Upstream.assign(Pixels, {1, 0, 0, 0});
  S.Last.assign(Pixels, static_cast<uint32_t>(Layers));
  return S;
}

bool same(const std::vector<GradientSums> &A,
          const std::vector<GradientSums> &B) {
  return std::ranges::equal(A, B, [](const auto &X, const auto &Y) {
    return std::memcmp(&X, &Y, sizeof(X)) == 0;
  });
}

class HardBackward : public testing::TestWithParam<unsigned> {};

/// T in front of all layers is 1; a unit that errs upwards passes it, and the
/// front one's gradient with it. Held at 1 it would be another gradient than
/// that of the layers behind.
TEST_P(HardBackward, TransmittanceMayRiseAbove1) {
  const ReciprocalUnit &Unit = ReciprocalUnits[GetParam()];
  BackwardOptions O;
  O.Unit = static_cast<Reciprocal>(GetParam());
  constexpr std::size_t Layers = 40;
  // The alpha whose front T comes out largest.
  float Most = 0, At = 0;
  for (float Alpha = 0.02F; Alpha < 0.3F; Alpha += 0.0037F) {
    const auto Is = scalarLoop(stackOf(Layers, Alpha), O);
    // All pixels have one weight, alpha T.
    const float T = Is[0].Sums[0] / 32 / Alpha;
    if (T > Most) {
      Most = T;
      At = Alpha;
    }
    const double Bound =
        std::pow(1 + Unit.MaxRelativeError + 0x1p-22, Layers) - 1;
    EXPECT_NEAR(T, 1, Bound) << Alpha;
  }
  EXPECT_GT(Most, 1) << Unit.Name << " at " << At;
  const Scene S = stackOf(Layers, At);
  const auto Want = scalarLoop(S, O);
  EXPECT_FALSE(same(Want, scalarLoop(S, O, {.HoldsT = true})));
  for (const BackwardDatapath *Level : backwardDatapaths())
    EXPECT_TRUE(same(Want, onLevel(*Level, S, O))) << Level->Name;
}

INSTANTIATE_TEST_SUITE_P(Reciprocals, HardBackward,
                         testing::Range(0U, unsigned{ReciprocalUnitCount}));

} // namespace
} // namespace vorion::raster
