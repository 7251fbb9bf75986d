/// What the reference renders, how, and from where.
#pragma once

#include "reference/lens/LensModel.h"

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace vorion::reference {

/// The two public conventions. They differ in the near plane, the Jacobian's
/// clamp and its gradient, the stop rule, and the gradient of a cut alpha.
enum class Rules {
  Inria, ///< diff-gaussian-rasterization
  Gsplat ///< gsplat
};

/// Which pixels a Gaussian may reach; \c m is its projected mean, \c S its
/// dilated 2D covariance.
enum class Support {
  Exact,     ///< all with alpha >= 1/255
  Box3,      ///< |dx| <= 3 sqrt(S_xx) and |dy| <= 3 sqrt(S_yy)
  Square3,   ///< |dx|, |dy| <= r, r = ceil(3 sqrt(largest eigenvalue))
  Official16 ///< all pixels of the 16x16 tiles that this square touches
};

/// As on command lines and in results.
constexpr std::string_view name(Support S) {
  switch (S) {
  case Support::Exact:
    return "exact";
  case Support::Box3:
    return "box3";
  case Support::Square3:
    return "square3";
  case Support::Official16:
    return "official16";
  }
  __builtin_unreachable();
}

/// Activated Gaussians, one entry of each array a Gaussian.
template <typename Real> struct Gaussians {
  std::vector<glm::vec<3, Real>> Means;  ///< world units
  std::vector<glm::vec<3, Real>> Scales; ///< standard deviations
  std::vector<glm::vec<4, Real>> Quats;  ///< (w, x, y, z), unit length, or zero
                                         ///< for no rotation
  std::vector<Real> Opacities;           ///< 0 to 1
  int ShDegree = 0;                      ///< 0 to 3
  std::vector<glm::vec<3, Real>> Sh;     ///< (ShDegree + 1)^2 each
  /// Colours to use as they are; where not empty, \c Sh is not read.
  std::vector<glm::vec<3, Real>> Colors;

  std::size_t size() const { return Opacities.size(); }
};

/// A lens as \c setLens (Lens.h) makes it.
struct Lens {
  const LensModel *Model = &lenses::Pinhole;
  LensCoefficients K{};
  /// Up to where the model is one to one: a radius before distortion, or an
  /// angle from the axis. What lies beyond is not drawn.
  double Limit = 0;
  /// Of a model that holds slopes: least and largest x/z and y/z in the
  /// picture, without the tangential part.
  glm::dvec2 SlopesX{0}, SlopesY{0};

  /// A pinhole, whose slopes jacobian() (Projection.h) holds.
  bool isPinhole() const { return Model == &lenses::Pinhole; }
  /// Whether depth is the distance from the camera, not z.
  bool byDistance() const { return Model->ByDistance; }
};

/// How a camera moves while it exposes its picture: pixel (x, y) at the moment
/// Start + Across x / Width + Down y / Height. The camera has its pose at 1/2,
/// and from 0 to 1 moves and turns evenly, along and by the pose's axes.
struct RollingShutter {
  double Start = 0, Across = 0, Down = 1;
  glm::dvec3 Motion{0}, Turn{0}; ///< Turn is an axis times an angle
};

/// A camera: x right, y down, z forward; sample points are the pixel centres
/// (i + 0.5, j + 0.5).
template <typename Real> struct Camera {
  int Width = 0, Height = 0;
  glm::mat<3, 3, Real> Rotation; ///< world to camera
  glm::vec<3, Real> Translation; ///< p_camera = Rotation p_world + Translation
  glm::vec<3, Real> Centre;      ///< the camera in the world
  glm::vec<2, Real> Focal;       ///< pixels; a unit, or a radian
  glm::vec<2, Real> Principal;   ///< pixels
  /// What rounding to Real took from the last row of Rotation and Translation:
  /// depths are computed from the sums (see project).
  glm::vec<3, Real> DepthAxisLow{0};
  Real DepthOffsetLow = 0;
  glm::vec<3, Real> CentreLow{0}; ///< and from Centre
  Lens Optics{};
  std::optional<RollingShutter> Shutter = std::nullopt;
};

/// How a Gaussian becomes an ellipse on the picture.
enum class Spread {
  Jacobian, ///< by the camera's Jacobian at the mean
  Unscented ///< by seven points of it (3DGUT)
};

/// How to render.
struct Options {
  Rules Rule = Rules::Inria;
  Support Reach = Support::Exact;
  Spread Through = Spread::Jacobian;
  /// With Spread::Unscented: how far from the mean a point may be seen, in
  /// focal lengths and in the picture's longer side, whichever is less. The
  /// kernels have this value; others say what it is worth
  /// (bench/along_rays.py).
  double PointSpread = 0.5;
  bool Antialiased = false;
  double Dilation = 0.3; ///< added to both variances, px^2
  /// Along rays of pinholes and in parallel: a Gaussian's density is at least
  /// exp(-d^2) d px from its mean on the picture, the low-pass filter of 2D
  /// Gaussians (Huang et al. 2024, section 4.2).
  bool LowPass = false;
  /// Along rays, q being the square of the distance in standard deviations: 2,
  /// a density of exp(-q / 2), or 4, exp(-q^2 / 18) (Moenne-Loccoz et al.
  /// 2024).
  int FalloffDegree = 2;
  double Cutoff = 1e-4; ///< transmittance at which a pixel ends
  int AlphaCutoff = 1;  ///< smallest alpha that is blended, in 1/255
  int DepthBits = 32;   ///< leading bits of a depth's fp32 that order: 1 to 32
  double Near = 0;      ///< least depth that is drawn; 0: the rules' own
  int ShLimit = 3;      ///< harmonics of higher bands are left out
  std::array<double, 3> Background{};
  int TileSize = 16;    ///< pixels; of the tile lists
  unsigned Threads = 0; ///< 0: one for each processor; changes no result
};

} // namespace vorion::reference
