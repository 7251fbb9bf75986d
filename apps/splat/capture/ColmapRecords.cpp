#include "capture/ColmapRecords.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {
namespace {

Lens pinhole(std::span<const double> /*P*/) { return {}; }

/// \p First: where k1 is; tangential terms follow k2.
Lens radialTangential(std::span<const double> P, std::size_t First,
                      std::size_t Count) {
  Lens L{Lens::Model::RadialTangential, {}, {}, {}};
  for (std::size_t I = 0; I < Count; ++I)
    L.Radial[I] = P[First + I];
  return L;
}

Lens simpleRadial(std::span<const double> P) {
  return radialTangential(P, 3, 1);
}
Lens radial(std::span<const double> P) { return radialTangential(P, 3, 2); }
Lens openCv(std::span<const double> P) {
  Lens L = radialTangential(P, 4, 2);
  L.Tangential = {P[6], P[7]};
  return L;
}
/// fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6
Lens fullOpenCv(std::span<const double> P) {
  Lens L = openCv(P);
  L.Radial[2] = P[8];
  L.Denominator = {P[9], P[10], P[11]};
  return L;
}

Lens fisheye(std::span<const double> Terms) {
  Lens L{Lens::Model::Fisheye, {}, {}, {}};
  std::ranges::copy(Terms, L.Radial.begin());
  return L;
}
Lens openCvFisheye(std::span<const double> P) {
  return fisheye(P.subspan(4, 4));
}
Lens radialFisheye(std::span<const double> P) { return fisheye(P.subspan(3)); }

/// Numbers, names and counts of COLMAP's src/colmap/sensor/models.h.
constexpr ColmapCameraModel Models[] = {
    {0, "SIMPLE_PINHOLE", 3, pinhole, true},
    {1, "PINHOLE", 4, pinhole, false},
    {2, "SIMPLE_RADIAL", 4, simpleRadial, true},
    {3, "RADIAL", 5, radial, true},
    {4, "OPENCV", 8, openCv, false},
    {5, "OPENCV_FISHEYE", 8, openCvFisheye, false},
    {6, "FULL_OPENCV", 12, fullOpenCv, false},
    {7, "FOV", 5, nullptr, false},
    {8, "SIMPLE_RADIAL_FISHEYE", 4, radialFisheye, true},
    {9, "RADIAL_FISHEYE", 5, radialFisheye, true},
    {10, "THIN_PRISM_FISHEYE", 12, nullptr, false},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16, nullptr, false},
};

bool allFinite(std::span<const double> Values) {
  return std::ranges::all_of(Values, [](double V) { return std::isfinite(V); });
}

} // namespace

std::span<const ColmapCameraModel> colmapCameraModels() { return Models; }

std::string knownColmapModels() {
  std::vector<std::string_view> Names;
  for (const ColmapCameraModel &M : Models)
    if (M.LensOf)
      Names.push_back(M.Name);
  return fmt::format("{}", fmt::join(Names, ", "));
}

Expected<Success> ColmapBuilder::checkModel(const std::string &Where,
                                            int64_t Id,
                                            const ColmapCameraModel &Kind) {
  if (!Kind.LensOf)
    return Error{Where,
                 fmt::format("camera {} has the model {}, expected one of {}: "
                             "undistort the capture first (colmap "
                             "image_undistorter)",
                             Id, Kind.Name, knownColmapModels())};
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
  const bool OneFocal = Kind.OneFocal;
  CaptureView Taken;
  Camera &C = Taken.Pose;
  C.Width = static_cast<int>(Width);
  C.Height = static_cast<int>(Height);
  C.Fx = Parameters[0];
  C.Fy = Parameters[OneFocal ? 0 : 1];
  C.Cx = Parameters[OneFocal ? 1 : 2];
  C.Cy = Parameters[OneFocal ? 2 : 3];
  if (!allFinite(Parameters) || !(C.Fx > 0) || !(C.Fy > 0))
    return Error{Where,
                 fmt::format("camera {} has parameters that are no camera, "
                             "expected a positive focal length and a finite "
                             "principal point",
                             Id)};
  Taken.Optics = simplified(Kind.LensOf(Parameters));
  if (!Cameras.emplace(Id, Taken).second)
    return Error{Where, fmt::format("camera {} is there twice, expected it "
                                    "once",
                                    Id)};
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
    return Error{Where, fmt::format("image {} has an unreadable pose, expected "
                                    "a unit quaternion and a finite "
                                    "translation",
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
  Model.Views.push_back(std::move(V));
  return Success{};
}

Expected<Success>
ColmapBuilder::addPoint(const std::string &Where,
                        const std::array<double, 3> &Position,
                        const std::array<uint8_t, 3> &Colour) {
  CapturePoints &P = Model.Points;
  for (const double V : Position) {
    const auto Rounded = static_cast<float>(V);
    if (!std::isfinite(Rounded))
      return Error{Where, fmt::format("point {} holds a NaN or an infinity, "
                                      "expected finite coordinates",
                                      P.size())};
    P.Positions.push_back(Rounded);
  }
  P.Colours.insert(P.Colours.end(), Colour.begin(), Colour.end());
  return Success{};
}

Expected<ColmapModel> ColmapBuilder::finish(const ColmapFiles &Files) {
  if (Model.Views.empty())
    return Error{Files.Images.Where, "no image, expected at least one"};
  if (!Files.PosesOnly && Model.Points.size() == 0)
    return Error{Files.Points.Where,
                 "no points, expected those that training starts from"};
  return std::move(Model);
}

} // namespace vorion::splat
