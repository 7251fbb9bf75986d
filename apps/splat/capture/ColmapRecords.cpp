#include "capture/ColmapRecords.h"

#include "io/CameraLens.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {
namespace {

/// Of COLMAP's src/colmap/sensor/models.h, those that lens/ does not have yet:
/// they are refused by name. A record in lens/ with such a number replaces the
/// row. Tests of the message use RAD_TAN_THIN_PRISM_FISHEYE.
constexpr ColmapLens WithoutLens[] = {
    {7, "FOV", 2, 1},
    {10, "THIN_PRISM_FISHEYE", 2, 8},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 2, 12},
};

bool allFinite(std::span<const double> Values) {
  return std::ranges::all_of(Values, [](double V) { return std::isfinite(V); });
}

} // namespace

std::vector<ColmapCameraModel>
colmapCameraModelsOf(std::span<const LensModel *const> Lenses) {
  std::vector<ColmapCameraModel> Models;
  for (const LensModel *Lens : Lenses)
    for (const ColmapLens &M : Lens->Colmap)
      Models.push_back({M, Lens});
  for (const ColmapLens &M : WithoutLens)
    if (std::ranges::find(Models, M.Id, &ColmapCameraModel::Id) == Models.end())
      Models.push_back({M, nullptr});
  std::ranges::sort(Models, {}, &ColmapCameraModel::Id);
  return Models;
}

std::span<const ColmapCameraModel> colmapCameraModels() {
  static const std::vector<ColmapCameraModel> Models =
      colmapCameraModelsOf(lenses::all());
  return Models;
}

std::string knownColmapModels() {
  std::vector<std::string_view> Names;
  for (const ColmapCameraModel &M : colmapCameraModels())
    if (M.Lens)
      Names.push_back(M.Name);
  return fmt::format("{}", fmt::join(Names, ", "));
}

Expected<Success> ColmapBuilder::checkModel(const std::string &Where,
                                            int64_t Id,
                                            const ColmapCameraModel &Kind) {
  if (!Kind.Lens)
    return Error{Where,
                 fmt::format("camera {} has the model {}, expected one of {}: "
                             "undistort the capture first (colmap "
                             "image_undistorter)",
                             Id, Kind.Name, knownColmapModels())};
  return Success{};
}

/// Gives \p V, whose size is there, the lens of \p Kind. The error's place is
/// empty.
static Expected<Success> seeThrough(const ColmapCameraModel &Kind,
                                    std::span<const double> Parameters,
                                    CaptureView &V) {
  Camera &C = V.Pose;
  const std::size_t Focals = Kind.FocalLengths;
  if (Focals == 0) {
    if (Parameters[0] != C.Width || Parameters[1] != C.Height)
      return Error{"", fmt::format("parameters {} and {}, expected the width "
                                   "and the height of its pictures, {} and {}",
                                   Parameters[0], Parameters[1], C.Width,
                                   C.Height)};
    setSphere(C);
    V.Optics = {Kind.Lens};
    return Success{};
  }
  C.Fx = Parameters[0];
  C.Fy = Parameters[Focals - 1];
  C.Cx = Parameters[Focals];
  C.Cy = Parameters[Focals + 1];
  if (!allFinite(Parameters) || !(C.Fx > 0) || !(C.Fy > 0))
    return Error{"", "invalid parameters, expected a positive focal "
                     "length and a finite principal point"};
  CameraModel Optics{Kind.Lens};
  std::ranges::copy(Parameters.subspan(Focals + 2), Optics.K.begin());
  const std::string_view Range = Kind.Lens->ExpectedCoefficients(Optics.K);
  if (!Range.empty())
    return Error{"", fmt::format("coefficients of {} out of range, expected {}",
                                 Kind.Name, Range)};
  V.Optics = simplified(Optics);
  return Success{};
}

Expected<Success> ColmapBuilder::addCamera(const std::string &Where, int64_t Id,
                                           const ColmapCameraModel &Kind,
                                           double Width, double Height,
                                           std::span<const double> Parameters) {
  const auto IsSide = [](double Side) {
    return Side >= 1 && Side <= MaxImageSize && Side == std::floor(Side);
  };
  if (!IsSide(Width) || !IsSide(Height))
    return Error{Where,
                 fmt::format("camera {} has pictures of {}x{} pixels, expected "
                             "sides of 1 to {}",
                             Id, Width, Height, MaxImageSize)};
  CaptureView Taken;
  Camera &C = Taken.Pose;
  C.Width = static_cast<int>(Width);
  C.Height = static_cast<int>(Height);
  if (auto Seen = seeThrough(Kind, Parameters, Taken); !Seen)
    return Error{Where, fmt::format("camera {} has {}", Id, Seen.error().What)};
  if (!Cameras.emplace(Id, Taken).second)
    return Error{Where,
                 fmt::format("duplicate camera {}, expected unique ids", Id)};
  return Success{};
}

Expected<Success> ColmapBuilder::addImage(const std::string &Where,
                                          const ColmapImage &I) {
  const std::string Shown = printable(I.Name);
  const auto Known = Cameras.find(I.Camera);
  if (Known == Cameras.end())
    return Error{Where, fmt::format("image {} has camera {}, expected one of "
                                    "the {} cameras of the model",
                                    Shown, I.Camera, Cameras.size())};
  const auto &Q = I.Quaternion;
  const double Norm =
      std::sqrt(Q[0] * Q[0] + Q[1] * Q[1] + Q[2] * Q[2] + Q[3] * Q[3]);
  // Files of few decimals pass; what is no quaternion at all does not.
  if (!(std::abs(Norm - 1) < 1e-2) || !allFinite(I.Translation))
    return Error{Where, fmt::format("image {} has an invalid pose, expected a "
                                    "unit quaternion and a finite translation",
                                    Shown)};
  const double W = Q[0] / Norm, X = Q[1] / Norm, Y = Q[2] / Norm,
               Z = Q[3] / Norm;
  CaptureView V = Known->second;
  V.Pose.Id = static_cast<int>(Model.Views.size());
  V.Pose.Name = I.Name;
  // Camera to world: the transpose of the stored rotation.
  V.Pose.Rotation = {
      {{1 - 2 * (Y * Y + Z * Z), 2 * (X * Y + W * Z), 2 * (X * Z - W * Y)},
       {2 * (X * Y - W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z + W * X)},
       {2 * (X * Z + W * Y), 2 * (Y * Z - W * X), 1 - 2 * (X * X + Y * Y)}}};
  for (std::size_t R = 0; R < 3; ++R)
    for (std::size_t K = 0; K < 3; ++K)
      V.Pose.Position[R] -= V.Pose.Rotation[R][K] * I.Translation[K];
  ImageOf.emplace(I.Id, Model.Views.size());
  Model.Views.push_back(std::move(V));
  return Success{};
}

Expected<Success> ColmapBuilder::addPoint(const std::string &Where,
                                          const std::array<double, 3> &Position,
                                          const std::array<uint8_t, 3> &Colour,
                                          std::span<const int64_t> Track) {
  CapturePoints &P = Model.Points;
  for (const double V : Position) {
    if (!std::isfinite(static_cast<float>(V)))
      return Error{Where, fmt::format("point {} has a NaN or an infinity, "
                                      "expected finite coordinates",
                                      P.size())};
    P.Positions.push_back(V);
  }
  const auto Own = static_cast<uint32_t>(P.size());
  for (const int64_t Id : Track)
    if (const auto Image = ImageOf.find(Id); Image != ImageOf.end()) {
      std::vector<uint32_t> &Sees = Model.Views[Image->second].Sees;
      if (Sees.empty() || Sees.back() != Own) // some tracks name one twice
        Sees.push_back(Own);
    }
  P.Colours.insert(P.Colours.end(), Colour.begin(), Colour.end());
  return Success{};
}

Expected<ColmapModel> ColmapBuilder::finish(const ColmapFiles &Files) {
  if (Model.Views.empty())
    return Error{Files.Images.Where, "no image, expected at least one"};
  return std::move(Model);
}

} // namespace vorion::splat
