#include "Convert.h"

#include "reference/SphericalHarmonics.h"

#include <cmath>
#include <glm/matrix.hpp>

namespace vorion::test {
namespace {

template <typename To, typename From>
std::vector<To> converted(const std::vector<From> &V) {
  std::vector<To> Result;
  Result.reserve(V.size());
  for (const From &E : V)
    Result.push_back(static_cast<To>(E));
  return Result;
}

} // namespace

reference::Gaussians<float> toSingle(const reference::Gaussians<double> &G) {
  reference::Gaussians<float> S;
  S.Means = converted<glm::vec3>(G.Means);
  S.Scales = converted<glm::vec3>(G.Scales);
  S.Quats = converted<glm::vec4>(G.Quats);
  S.Opacities = converted<float>(G.Opacities);
  S.ShDegree = G.ShDegree;
  S.Sh = converted<glm::vec3>(G.Sh);
  S.Colors = converted<glm::vec3>(G.Colors);
  return S;
}

/// What rounding to fp32 takes away.
float low(double Value) {
  return static_cast<float>(Value -
                            static_cast<double>(static_cast<float>(Value)));
}

reference::Camera<float> toSingle(const reference::Camera<double> &C) {
  return {C.Width,
          C.Height,
          glm::mat3(C.Rotation),
          glm::vec3(C.Translation),
          glm::vec3(C.Centre),
          glm::vec2(C.Focal),
          glm::vec2(C.Principal),
          glm::vec3(low(C.Rotation[0][2]), low(C.Rotation[1][2]),
                    low(C.Rotation[2][2])),
          low(C.Translation.z),
          glm::vec3(low(C.Centre.x), low(C.Centre.y), low(C.Centre.z)),
          C.Optics};
}

splat::Scene sceneOf(const Fixture &F) {
  const auto &G = F.Gaussians;
  splat::Scene S;
  const auto Put = [](std::vector<float> &To, const glm::dvec3 &V) {
    for (int K = 0; K < 3; ++K)
      To.push_back(static_cast<float>(V[K]));
  };
  for (std::size_t I = 0; I < G.size(); ++I) {
    Put(S.Means, G.Means[I]);
    Put(S.LogScales,
        glm::dvec3(std::log(G.Scales[I].x), std::log(G.Scales[I].y),
                   std::log(G.Scales[I].z)));
    S.OpacityLogits.push_back(splat::opacityLogit(G.Opacities[I]));
  }
  // As stored, before they were made unit: no rounding at all.
  S.Quats = F.Arrays.at("in_quats").toFloats();
  if (G.Colors.empty()) {
    S.ShDegree = G.ShDegree;
    for (const glm::dvec3 &C : G.Sh)
      Put(S.Sh, C);
  } else {
    const double Constant = reference::shBasis(glm::dvec3(0), 0)[0];
    for (const glm::dvec3 &C : G.Colors)
      Put(S.Sh, (C - 0.5) / Constant);
  }
  return S;
}

splat::Camera cameraOf(const Fixture &F) {
  const glm::dvec3 Centre =
      -(glm::inverse(F.Camera.Rotation) * F.Camera.Translation);
  splat::Camera C;
  C.Name = "view";
  C.Width = F.Camera.Width;
  C.Height = F.Camera.Height;
  for (int I = 0; I < 3; ++I) {
    for (int J = 0; J < 3; ++J)
      C.Rotation[static_cast<std::size_t>(J)][static_cast<std::size_t>(I)] =
          F.Camera.Rotation[J][I];
    C.Position[static_cast<std::size_t>(I)] = Centre[I];
  }
  C.Fx = F.Camera.Focal.x;
  C.Fy = F.Camera.Focal.y;
  C.Cx = F.Camera.Principal.x;
  C.Cy = F.Camera.Principal.y;
  return C;
}

template <typename Real>
std::vector<double> renderOf(const reference::Picture<Real> &P) {
  std::vector<double> V;
  V.reserve(P.Render.size() * 3);
  for (const auto &Pixel : P.Render)
    for (int K = 0; K < 3; ++K)
      V.push_back(Pixel[K]);
  return V;
}

template <typename Real> splat::Npz toNpz(const reference::Picture<Real> &P) {
  const auto H = static_cast<std::size_t>(P.Height);
  const auto W = static_cast<std::size_t>(P.Width);
  std::vector<Real> Alpha;
  std::vector<uint8_t> Threshold, Order, Surface;
  Alpha.reserve(P.Transmittance.size());
  for (const Real T : P.Transmittance)
    Alpha.push_back(1 - T);
  Threshold.reserve(P.Doubts.size());
  Order.reserve(P.Doubts.size());
  Surface.reserve(P.Doubts.size());
  for (const uint8_t D : P.Doubts) {
    Threshold.push_back((D & reference::DoubtThreshold) != 0);
    Order.push_back((D & reference::DoubtOrder) != 0);
    Surface.push_back((D & reference::DoubtSurface) != 0);
  }
  using splat::NpyArray;
  return {{"render", NpyArray::of({H, W, 3}, converted<Real>(renderOf(P)))},
          {"alpha", NpyArray::of({H, W}, Alpha)},
          {"last", NpyArray::of({H, W}, P.Last)},
          {"mask_threshold", NpyArray::fromBools({H, W}, Threshold)},
          {"mask_order", NpyArray::fromBools({H, W}, Order)},
          {"mask_surface", NpyArray::fromBools({H, W}, Surface)}};
}

template <typename Real>
splat::Npz toNpz(const reference::TileLists &T,
                 const std::vector<reference::Splat<Real>> &Splats) {
  std::vector<int32_t> Tiles, Depths, Indices;
  for (std::size_t Tile = 0; Tile < T.Lists.size(); ++Tile)
    for (const uint32_t I : T.Lists[Tile]) {
      Tiles.push_back(static_cast<int32_t>(Tile));
      Depths.push_back(
          static_cast<int32_t>(reference::depthBits(Splats[I].Depth)));
      Indices.push_back(static_cast<int32_t>(I));
    }
  const std::vector<std::size_t> Shape{Tiles.size()};
  using splat::NpyArray;
  return {{"tile", NpyArray::of(Shape, Tiles)},
          {"depth_bits", NpyArray::of(Shape, Depths)},
          {"index", NpyArray::of(Shape, Indices)}};
}

template std::vector<double> renderOf(const reference::Picture<float> &);
template std::vector<double> renderOf(const reference::Picture<double> &);
template splat::Npz toNpz(const reference::Picture<float> &);
template splat::Npz toNpz(const reference::Picture<double> &);
template splat::Npz toNpz(const reference::TileLists &,
                          const std::vector<reference::Splat<float>> &);
template splat::Npz toNpz(const reference::TileLists &,
                          const std::vector<reference::Splat<double>> &);

} // namespace vorion::test
