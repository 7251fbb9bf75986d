#include "picture/View.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

namespace vorion::splat {

namespace {

constexpr float Infinity = std::numeric_limits<float>::infinity();

/// \p Value as a sum of two floats: \p Low is what rounding to \p High takes
/// away.
void split(double Value, float &High, float &Low) {
  High = static_cast<float>(Value);
  Low = static_cast<float>(Value - static_cast<double>(High));
}

/// The counterpart of the pinhole's limits for a distortion: x/z and y/z
/// that the picture's corners and the middles of its sides see by the radial
/// part, and as far beyond as the rules say.
void setDistortedLimits(splat_view &V, const Camera &C, Rules Convention) {
  double Low[2] = {Infinity, Infinity}, High[2] = {-Infinity, -Infinity};
  for (int I = 0; I < 9; ++I) {
    if (I == 4)
      continue;
    const int Column = I % 3, Row = I / 3;
    const double At[2] = {(0.5 * C.Width * Column - C.Cx) / C.Fx,
                          (0.5 * C.Height * Row - C.Cy) / C.Fy};
    const double Length = std::hypot(At[0], At[1]);
    const double Scale = Length > 0 ? C.Optics.undistorted(Length) / Length : 1;
    for (int A = 0; A < 2; ++A) {
      Low[A] = std::min(Low[A], Scale * At[A]);
      High[A] = std::max(High[A], Scale * At[A]);
    }
  }
  for (int A = 0; A < 2; ++A) {
    const double Half = 0.5 * (High[A] - Low[A]);
    const bool Inria = Convention == Rules::Inria;
    V.ratio_low[A] =
        static_cast<float>(Inria ? -1.3 * Half : Low[A] - 0.3 * Half);
    V.ratio_high[A] =
        static_cast<float>(Inria ? 1.3 * Half : High[A] + 0.3 * Half);
  }
}

} // namespace

splat_view makeView(const Camera &C, const RenderOptions &Options) {
  splat_view V{};
  const auto Rotation = C.worldToCameraRotation();
  const auto Translation = C.worldToCameraTranslation();
  for (std::size_t I = 0; I < 9; ++I)
    V.rotation[I] = static_cast<float>(Rotation[I]);
  for (std::size_t I = 0; I < 3; ++I) {
    split(C.Position[I], V.position[I], V.position_low[I]);
    split(Rotation[6 + I], V.depth_axis[I], V.depth_axis_low[I]);
  }
  split(Translation[2], V.depth_offset[0], V.depth_offset[1]);

  const double Focal[2] = {C.Fx, C.Fy};
  const double Center[2] = {C.Cx, C.Cy};
  const int Size[2] = {C.Width, C.Height};
  const unsigned Tile[2] = {Options.tileSize(), Options.tileHeight()};
  for (int A = 0; A < 2; ++A) {
    V.focal[A] = static_cast<float>(Focal[A]);
    V.center[A] = static_cast<float>(Center[A]);
    V.size[A] = static_cast<uint>(Size[A]);
    V.tiles[A] = (V.size[A] + Tile[A] - 1) / Tile[A];
    // Where x/z (or y/z) is clamped in the Jacobian: INRIA at 1.3 times the
    // half field of view, gsplat 0.3 times beyond each edge of the picture. In
    // fp32, as the reference in fp32 has it.
    const auto Side = static_cast<float>(Size[A]);
    const float Tangent = Side / (2 * V.focal[A]);
    if (Options.Convention == Rules::Inria) {
      V.ratio_low[A] = -1.3F * Tangent;
      V.ratio_high[A] = 1.3F * Tangent;
    } else {
      V.ratio_low[A] = -(V.center[A] / V.focal[A] + 0.3F * Tangent);
      V.ratio_high[A] = (Side - V.center[A]) / V.focal[A] + 0.3F * Tangent;
    }
  }
  if (!Options.Optics->HoldsSlopes)
    for (int A = 0; A < 2; ++A) {
      V.ratio_low[A] = -Infinity;
      V.ratio_high[A] = Infinity;
    }
  else if (!Options.Optics->isPinhole())
    setDistortedLimits(V, C, Options.Convention);
  return V;
}

splat_lens makeLens(const Camera &C) {
  splat_lens L{};
  std::ranges::transform(C.Optics.K, L.k,
                         [](double K) { return static_cast<float>(K); });
  const LensModel &Model = *C.Optics.Model;
  L.limit = static_cast<float>(Model.KernelLimit(C.Optics.limit(), C.Height));
  // Parallel rays keep every ellipse one.
  const double Spread =
      Model.IsParallel
          ? Infinity
          : 0.5 * std::min(1.0, std::max(C.Width / C.Fx, C.Height / C.Fy));
  L.most_spread = static_cast<float>(Spread * Spread);
  return L;
}

splat_shutter makeShutter(const Camera &C) {
  const RollingShutter Of = C.Optics.Shutter.value_or(RollingShutter());
  splat_shutter S{};
  S.moment[0] = static_cast<float>(Of.Start - 0.5);
  S.moment[1] = static_cast<float>(Of.Across / C.Width);
  S.moment[2] = static_cast<float>(Of.Down / C.Height);
  const double Angle = std::hypot(Of.Turn[0], Of.Turn[1], Of.Turn[2]);
  for (std::size_t K = 0; K < 3; ++K) {
    S.motion[K] = static_cast<float>(Of.Motion[K]);
    S.axis[K] = static_cast<float>(Angle > 0 ? Of.Turn[K] / Angle : 0);
  }
  S.angle = static_cast<float>(Angle);
  return S;
}

bool isCrop(const splat_view &V) {
  const auto Outside = [&](int A) {
    return !(V.center[A] >= 0 && V.center[A] <= static_cast<float>(V.size[A]));
  };
  return Outside(0) || Outside(1);
}

namespace {

/// From the ray through \p Place, which becomes that of the axis where the lens
/// shows nothing there.
RayFrame frameAt(const Camera &C, std::array<double, 2> &Place) {
  const double Focal[2] = {C.Fx, C.Fy};
  const double Center[2] = {C.Cx, C.Cy};
  auto Ray = C.Optics.direction((Place[0] - Center[0]) / Focal[0],
                                (Place[1] - Center[1]) / Focal[1]);
  if (!Ray) {
    Ray = {0, 0, 1};
    std::ranges::copy(Center, Place.begin());
  }
  return C.Optics.Model->Frame(*Ray, (Place[0] - Center[0]) / Focal[0],
                               (Place[1] - Center[1]) / Focal[1]);
}

/// Measured from the ray through (\p X, \p Y), in pixels from \p First.
splat_crop makeCrop(const Camera &C, double X, double Y,
                    const std::array<double, 2> &First) {
  splat_crop Crop{};
  std::array Place{X, Y};
  const RayFrame Frame = frameAt(C, Place);
  std::ranges::transform(Frame.Ray, Crop.ray,
                         [](double K) { return static_cast<float>(K); });
  const auto Rotation = C.worldToCameraRotation();
  for (std::size_t A = 0; A < 2; ++A) {
    Crop.place[A] = static_cast<float>(Place[A] - First[A]);
    split(Frame.Start[A], Crop.start[A], Crop.start_low[A]);
    for (std::size_t K = 0; K < 3; ++K)
      split(Frame.Beside[A][0] * Rotation[K] +
                Frame.Beside[A][1] * Rotation[3 + K] +
                Frame.Beside[A][2] * Rotation[6 + K],
            Crop.across[A][K], Crop.across_low[A][K]);
  }
  return Crop;
}

} // namespace

splat_crop makeCrop(const Camera &C) {
  return makeCrop(C, 0.5 * C.Width, 0.5 * C.Height, {0, 0});
}

bool hasAffineRays(const Camera &C) {
  return C.Optics.isPinhole() || C.Optics.Model->IsParallel;
}

splat_ray_source makeRays(const Camera &C) {
  const auto Rotation = C.worldToCameraRotation();
  const double Focal[2] = {C.Fx, C.Fy};
  const double Start[2] = {(0.5 - C.Cx) / C.Fx, (0.5 - C.Cy) / C.Fy};
  const bool IsParallel = C.Optics.Model->IsParallel;
  splat_ray_source S{};
  for (std::size_t K = 0; K < 3; ++K) {
    // Rows are the camera's axes in the world.
    const double Axes[3] = {Rotation[K], Rotation[3 + K], Rotation[6 + K]};
    split(Axes[0] / Focal[0], S.across[0][K], S.across[1][K]);
    split(Axes[1] / Focal[1], S.down[0][K], S.down[1][K]);
    split(Start[0] * Axes[0] + Start[1] * Axes[1] + (IsParallel ? 0 : Axes[2]),
          S.start[0][K], S.start[1][K]);
    split(IsParallel ? Axes[2] : 0, S.same[0][K], S.same[1][K]);
  }
  return S;
}

std::vector<float> makeRayTable(const Camera &C, float Nearest) {
  const auto Rows = C.worldToCameraRotation();
  const auto Width = static_cast<std::size_t>(C.Width);
  const std::size_t Count = Width * static_cast<std::size_t>(C.Height);
  std::vector<float> Rays(RAY_PLANES * Count);
  for (std::size_t I = 0; I < Count; ++I) {
    const std::size_t Column = I % Width, Row = I / Width;
    const double X = static_cast<double>(Column) + 0.5,
                 Y = static_cast<double>(Row) + 0.5;
    auto Along = C.Optics.direction((X - C.Cx) / C.Fx, (Y - C.Cy) / C.Fy);
    Rays[RAY_NEAREST * Count + I] = Along ? Nearest : 0;
    Rays[RAY_FARTHEST * Count + I] = Along ? Infinity : 0;
    if (!Along)
      Along = {0, 0, 1};
    // So that depths are multiples of it.
    const double Depth = C.Optics.Model->byDistance() ? 1 : (*Along)[2];
    for (std::size_t K = 0; K < 3; ++K) {
      double Direction = 0;
      for (std::size_t A = 0; A < 3; ++A)
        Direction += Rows[3 * A + K] * (*Along)[A] / Depth;
      split(Direction, Rays[(RAY_DIRECTION + K) * Count + I],
            Rays[(RAY_DIRECTION_LOW + K) * Count + I]);
    }
  }
  return Rays;
}

float rayOriginRounding(const Camera &C) {
  if (!C.Optics.Model->IsParallel)
    return 0;
  const double Most =
      std::hypot(std::max(std::abs(C.Cx), std::abs(C.Width - C.Cx)) / C.Fx,
                 std::max(std::abs(C.Cy), std::abs(C.Height - C.Cy)) / C.Fy);
  return static_cast<float>(Most * 0x1p-22);
}

std::vector<splat_crop> makeWindows(const Camera &C, unsigned Bits) {
  const int Side = 1 << Bits;
  std::vector<splat_crop> Windows;
  for (int Y = 0; Y < C.Height; Y += Side)
    for (int X = 0; X < C.Width; X += Side)
      Windows.push_back(makeCrop(C, 0.5 * (X + std::min(X + Side, C.Width)),
                                 0.5 * (Y + std::min(Y + Side, C.Height)),
                                 {double(X), double(Y)}));
  return Windows;
}

bool isRolling(const std::vector<Camera> &Cameras) {
  return std::ranges::any_of(
      Cameras, [](const Camera &C) { return C.Optics.Shutter.has_value(); });
}

bool isDrawnBy(const LensModel &Program, const Camera &C) {
  return C.Optics.Model == &Program ||
         (Program.IsDistortion && C.Optics.isPinhole());
}

/// The models whose programs draw pinholes, too, for messages.
static std::string distortions() {
  std::vector<std::string_view> Names;
  for (const LensModel *M : lenses::all())
    if (M->IsDistortion)
      Names.push_back(M->Name);
  return fmt::format("{}", fmt::join(Names, " or "));
}

Expected<const LensModel *> commonModel(const std::string &Path,
                                        const std::vector<Camera> &Cameras) {
  const LensModel *Common = CameraModel().Model;
  for (const Camera &C : Cameras)
    if (!C.Optics.isPinhole())
      Common = C.Optics.Model;
  for (const Camera &C : Cameras)
    if (!isDrawnBy(*Common, C))
      return Error{
          Path, fmt::format("cameras {} and {} in one run, expected one "
                            "camera model (or PINHOLE beside {}): "
                            "choose views of one model",
                            Common->Name, C.Optics.Model->Name, distortions())};
  return Common;
}

Expected<Success> drawThrough(RenderOptions &O, const std::string &Path,
                              const std::vector<Camera> &Cameras) {
  const auto Model = commonModel(Path, Cameras);
  if (!Model)
    return Model.error();
  O.Optics = *Model;
  O.Rolling = isRolling(Cameras);
  return Success{};
}

} // namespace vorion::splat
