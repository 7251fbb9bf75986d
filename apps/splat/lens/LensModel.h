/// A camera model: how a camera maps directions to its picture
/// (docs/cameras.md). Each has one record, in a file of its own here, and one
/// file of kernels/; everything else asks the record
/// (docs/adding-a-camera-model.md).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace vorion::splat {

/// What a model has coefficients for, in the order of its record; the rest is
/// 0. As many as OpenCV's distortion has.
using LensCoefficients = std::array<double, 13>;
/// The largest that is drawn: no product of a few of them is beyond fp32.
inline constexpr double MostLensCoefficient = 1e6;

/// A place on the picture in units of the focal lengths, from the principal
/// point.
using LensPlace = std::array<double, 2>;
/// Of length 1, in the camera's axes: x right, y down, z forward.
using Direction = std::array<double, 3>;

/// What Gaussians are ordered by and the near plane is compared with.
enum class DepthRule {
  AlongAxis, ///< z
  Distance   ///< from the camera, which then sees what is beside and behind it
};

/// What a place is measured from where fp32 has too few digits: a ray, as the
/// kernels' `crop_mean` takes it (splat_crop of kernels/layout.h).
struct RayFrame {
  /// Two vectors in the camera's axes: how far a point is beside the ray.
  std::array<std::array<double, 3>, 2> Beside{};
  /// What the model's kernels have to know of the ray.
  std::array<double, 5> Ray{};
  /// Of parallel rays: how far this one passes beside the axis; else 0.
  LensPlace Start{};
};

/// One of COLMAP's names for a model, as its files have it.
struct ColmapLens {
  int Id;
  std::string_view Name;
  /// Focal lengths, which the parameters begin with: 2, or 1 for both axes. 0:
  /// the parameters are the picture's width and height.
  std::size_t FocalLengths;
  /// Coefficients behind the principal point, those that the record begins
  /// with.
  std::size_t Coefficients;

  std::size_t parameters() const {
    return FocalLengths == 0 ? 2 : FocalLengths + 2 + Coefficients;
  }
};

struct LensModel;

/// \name What a record has where its model says nothing else
/// @{
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
  /// As reports and cameras.json have it: COLMAP's where it has one.
  std::string_view Name = {};

  /// \name In files
  /// @{
  /// What files call it, in any case of letters: COLMAP's, nerfstudio's and
  /// gsplat's names; those that messages list, and others.
  std::span<const std::string_view> Names = {}, OtherNames = {};
  /// A key of files that is true for this model; empty if there is none.
  std::string_view Flag = {};
  /// What nerfstudio's viewer calls it; empty if it does not know it.
  std::string_view ViewerName = {};
  std::span<const ColmapLens> Colmap = {};
  /// Names of the coefficients.
  std::span<const std::string_view> Keys = {};
  /// Those of the lists dist_coeffs and radial_coeffs.
  std::span<const std::string_view> ListKeys = OpenCvKeys,
                                    RadialListKeys = OpenCvRadialKeys;
  /// Coefficients that mean different things to different programs: as keys of
  /// their own they need the model's own name.
  std::span<const std::string_view> AmbiguousKeys = {};
  /// What nerfstudio calls k4 without that name; empty: k4.
  std::string_view KeyOfFourthTerm = {};
  /// What a pinhole with coefficients is.
  const LensModel *WithCoefficients = nullptr;
  /// @}

  /// \name Properties
  /// @{
  DepthRule Depth = DepthRule::AlongAxis;
  /// Its rays are parallel: focal lengths are pixels a unit.
  bool IsParallel = false;
  /// It shows the full sphere at any size: it has no focal length, and the
  /// picture's left and right sides are one line.
  bool CoversSphere = false;
  /// The Jacobian is held at slopes x/z and y/z around those that the picture
  /// shows.
  bool HoldsSlopes = false;
  /// Without coefficients it is a pinhole: a program for it draws those, too.
  bool IsDistortion = false;
  /// @}

  /// \name The effect of its kernels (effects/Effect.h); a pinhole has none
  /// @{
  std::string_view EffectName = {}, EffectText = {}, Macro = {};
  /// @}

  /// \name Equations
  /// @{
  /// Up to where the model is one to one: a radius before distortion, or an
  /// angle from the axis.
  double (*Limit)(const LensCoefficients &K) = noLimit;
  /// Where the radial part shows what a pinhole shows at \p Radius.
  double (*Radius)(const LensCoefficients &K, double Radius) = sameRadius;
  /// Where the lens shows what a pinhole shows at (\p X, \p Y).
  LensPlace (*Distorted)(const LensModel &Model, const LensCoefficients &K,
                         double X, double Y) = distortedRadially;
  /// Up to which radius a pinhole shows what this lens shows.
  double (*Reach)(double Limit) = asFarAsTheLimit;
  /// What is seen at (\p X, \p Y); nothing where the lens shows nothing.
  std::optional<Direction> (*Ray)(const LensCoefficients &K, double X,
                                  double Y) = rayThroughPlane;
  /// That of \p Ray, which is seen at (\p X, \p Y).
  RayFrame (*Frame)(const Direction &Ray, double X, double Y) = frameInPlane;
  /// `limit` of splat_lens (kernels/layout.h) for a picture so high.
  double (*KernelLimit)(double Limit, int Height) = squaredLimit;
  /// @}

  /// A program for it needs nothing beside the view.
  bool isPinhole() const { return Macro.empty(); }
  bool byDistance() const { return Depth == DepthRule::Distance; }
};
// NOLINTEND(readability-redundant-member-init)

/// The radius before distortion that the radial part takes to \p Distorted: at
/// most the limit and 1000.
double undistortedRadius(const LensModel &Model, const LensCoefficients &K,
                         double Distorted);

/// The direction to (\p X, \p Y, 1).
Direction directionTo(double X, double Y);

} // namespace vorion::splat
