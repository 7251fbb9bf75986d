/// A camera model: the projection of directions to the picture
/// (docs/cameras.md). Each model has one record, in its own file in this
/// folder, and one file of kernels/. All other code uses the record
/// (docs/adding-a-camera-model.md).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace vorion::splat {

/// The coefficients of a model, in the order of its record, padded with 0. The
/// size is that of OpenCV's distortion.
using LensCoefficients = std::array<double, 13>;
/// The largest supported magnitude: products of a few coefficients do not
/// overflow in fp32.
inline constexpr double MostLensCoefficient = 1e6;

/// A position in the picture relative to the principal point, in units of the
/// focal lengths.
using LensPlace = std::array<double, 2>;
/// A unit vector in camera coordinates: x right, y down, z forward.
using Direction = std::array<double, 3>;

/// The depth for sorting Gaussians and for the near plane.
enum class DepthRule {
  AlongAxis, ///< z
  Distance   ///< from the camera, for fields of view above 180 degrees
};

/// The ray to which positions are relative if fp32 is not precise enough, for
/// `crop_mean` of the kernels (splat_crop of kernels/layout.h).
struct RayFrame {
  /// Two vectors in camera coordinates, whose products with a point are its
  /// distances from the ray.
  std::array<std::array<double, 3>, 2> Beside{};
  /// Parameters of the ray for the model's kernels.
  std::array<double, 5> Ray{};
  /// Distance of a parallel ray from the axis; otherwise 0.
  LensPlace Start{};
};

/// A camera model of COLMAP, as stored in its files.
struct ColmapLens {
  int Id;
  std::string_view Name;
  /// Number of focal lengths at the start of the parameters: 2, or 1 for both
  /// axes. 0: the parameters are the picture's width and height.
  std::size_t FocalLengths;
  /// Number of coefficients after the principal point, which are the first of
  /// the record.
  std::size_t Coefficients;

  std::size_t parameters() const {
    return FocalLengths == 0 ? 2 : FocalLengths + 2 + Coefficients;
  }
};

struct LensModel;

/// \name Defaults of records
/// @{
std::string_view anyCoefficients(const LensCoefficients &K);
double noLimit(const LensCoefficients &K);
double sameRadius(const LensCoefficients &K, double Radius);
LensPlace distortedRadially(const LensModel &Model, const LensCoefficients &K,
                            double X, double Y);
double asFarAsTheLimit(double Limit);
std::optional<Direction> rayThroughPlane(const LensCoefficients &K, double X,
                                         double Y);
RayFrame frameInPlane(const Direction &Ray, double X, double Y);
double squaredLimit(double Limit, int Height);
inline constexpr std::array<std::string_view, 12> OpenCvKeys{
    "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"};
inline constexpr std::array<std::string_view, 6> OpenCvRadialKeys{
    "k1", "k2", "k3", "k4", "k5", "k6"};
/// @}

// A record's designated initializers leave out what the model does not have,
// which -Wmissing-designated-field-initializers allows where a member says so.
// NOLINTBEGIN(readability-redundant-member-init)
struct LensModel {
  /// The name in reports and cameras.json: that of COLMAP if it has the model.
  std::string_view Name = {};

  /// \name In files
  /// @{
  /// Names in files of COLMAP, nerfstudio and gsplat, not case-sensitive: those
  /// that messages list, and others.
  std::span<const std::string_view> Names = {}, OtherNames = {};
  /// A key of files that is true for this model; empty if there is none.
  std::string_view Flag = {};
  /// The name in nerfstudio's viewer; empty if it lacks the model.
  std::string_view ViewerName = {};
  std::span<const ColmapLens> Colmap = {};
  /// Names of the coefficients.
  std::span<const std::string_view> Keys = {};
  /// Names of the elements of dist_coeffs and radial_coeffs.
  std::span<const std::string_view> ListKeys = OpenCvKeys,
                                    RadialListKeys = OpenCvRadialKeys;
  /// Coefficients whose meaning differs between programs: as separate keys they
  /// need the model's name.
  std::span<const std::string_view> AmbiguousKeys = {};
  /// The meaning of nerfstudio's k4 without that name; empty: k4.
  std::string_view KeyOfFourthTerm = {};
  /// The model of a pinhole with coefficients.
  const LensModel *WithCoefficients = nullptr;
  /// @}

  /// \name Properties
  /// @{
  DepthRule Depth = DepthRule::AlongAxis;
  /// Rays are parallel, and focal lengths are pixels per unit.
  bool IsParallel = false;
  /// The picture is the full sphere at any size: there is no focal length, and
  /// the left and right edges of the picture coincide.
  bool CoversSphere = false;
  /// The Jacobian is clamped to slopes x/z and y/z around those of the picture.
  bool HoldsSlopes = false;
  /// Without coefficients it is a pinhole, which its programs also render.
  bool IsDistortion = false;
  /// @}

  /// \name The effect of its kernels (effects/Effect.h); a pinhole has none
  /// @{
  std::string_view EffectName = {}, EffectText = {}, Macro = {};
  /// @}

  /// \name Equations
  /// @{
  /// What messages say is expected of the coefficients, if \p K is outside the
  /// range in which the equations hold; otherwise empty.
  std::string_view (*ExpectedCoefficients)(const LensCoefficients &K) =
      anyCoefficients;
  /// The limit up to which the model is one-to-one: a radius before distortion,
  /// or an angle from the axis.
  double (*Limit)(const LensCoefficients &K) = noLimit;
  /// The radial part of the distortion: maps a pinhole's \p Radius.
  double (*Radius)(const LensCoefficients &K, double Radius) = sameRadius;
  /// The distortion: maps a pinhole's position (\p X, \p Y).
  LensPlace (*Distorted)(const LensModel &Model, const LensCoefficients &K,
                         double X, double Y) = distortedRadially;
  /// The radius of a pinhole's picture that covers this lens.
  double (*Reach)(double Limit) = asFarAsTheLimit;
  /// The direction of the position (\p X, \p Y); empty if it is outside the
  /// projection.
  std::optional<Direction> (*Ray)(const LensCoefficients &K, double X,
                                  double Y) = rayThroughPlane;
  /// The frame of \p Ray, whose position is (\p X, \p Y).
  RayFrame (*Frame)(const Direction &Ray, double X, double Y) = frameInPlane;
  /// `limit` of splat_lens (kernels/layout.h) for a picture of this height.
  double (*KernelLimit)(double Limit, int Height) = squaredLimit;
  /// @}

  /// Its programs need no data besides the view.
  bool isPinhole() const { return Macro.empty(); }
  bool byDistance() const { return Depth == DepthRule::Distance; }
};
// NOLINTEND(readability-redundant-member-init)

/// The inverse of the radial part at \p Distorted, at most the limit and 1000.
double undistortedRadius(const LensModel &Model, const LensCoefficients &K,
                         double Distorted);

/// The direction to (\p X, \p Y, 1).
Direction directionTo(double X, double Y);

} // namespace vorion::splat
