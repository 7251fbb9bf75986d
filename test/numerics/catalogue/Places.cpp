// Where fp32 has too few digits for a place on the picture: beside the
// principal point, through long lenses, on wide pictures.
#include "Places.h"

#include "Lenses.h"
#include "lens/Lenses.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::test {

using splat::CameraModel;
namespace lenses = splat::lenses;

namespace {

splat::Camera viewOf(int Width, int Height, double Focal,
                     const CameraModel &Optics = {}) {
  splat::Camera C = turnedView(frontView(Width, Height, Focal));
  C.Position = {1.7, -0.4, 0.9};
  C.Optics = Optics;
  return C;
}

/// What a pixel shows, in the camera's axes.
struct Sight {
  std::array<double, 3> At;
  double Pixel; ///< the side of a pixel there
};

Sight sightAt(const splat::Camera &C, double Column, double Row, double Depth) {
  const double A = (Column - C.Cx) / C.Fx, B = (Row - C.Cy) / C.Fy;
  if (C.Optics.Model->IsParallel)
    return {{A, B, Depth}, 1 / C.Fx};
  if (C.Optics.Model->CoversSphere)
    return {{Depth * std::sin(A) * std::cos(B), Depth * std::sin(B),
             Depth * std::cos(A) * std::cos(B)},
            Depth / C.Fx};
  Sight S{{A * Depth, B * Depth, Depth}, Depth / C.Fx};
  if (!C.Optics.isPinhole()) {
    const auto Seen = C.Optics.direction(A, B);
    for (std::size_t K = 0; K < 3; ++K)
      S.At[K] = Depth * Seen.value()[K];
  }
  return S;
}

HardCase caseOf(std::string Name, std::string Why, const splat::Camera &View,
                std::vector<std::string> FoundIn) {
  HardCase C{
      std::move(Name), std::move(Why), smallOnPicture(View, 60, 26), View, {}};
  C.Options.Optics = View.Optics.Model;
  C.Cap = 5e-6;
  C.FoundIn = std::move(FoundIn);
  return C;
}

/// A window of a picture of 24,000 by 16,000 pixels, far beside the principal
/// point, through \p Optics.
HardCase crop(std::string Name, const std::string &What,
              const CameraModel &Optics, std::vector<std::string> FoundIn) {
  splat::Camera View = viewOf(96, 64, 9000, Optics);
  View.Cx = -11000.25;
  View.Cy = 7000.75;
  return caseOf(std::move(Name),
                "the principal point 11,000 px beside the picture" + What, View,
                std::move(FoundIn));
}

/// Those of models that are added later: with small coefficients.
void addCropsThroughOthers(std::vector<HardCase> &Cases) {
  for (const splat::LensModel *M : lenses::all())
    if (!M->CoversSphere && std::ranges::none_of(Cases, [&](const HardCase &C) {
          return C.Name.starts_with("crop-") && C.View.Optics.Model == M;
        }))
      Cases.push_back(crop(fmt::format("crop-through-{}", M->EffectName),
                           fmt::format(", through {}", M->EffectText),
                           {M, someCoefficients(M)}, {}));
}

/// Lenses that bend at 11,000 px, with every term of theirs.
const CameraModel Bending{&lenses::OpenCv,
                          {-0.06, 0.01, 0.002, -0.001, -0.0007, 0.02, 0.003,
                           0.0002, 0.003, -0.0005, -0.002, 0.0004, 0.00001}};
const CameraModel BendingFisheye{&lenses::Fisheye,
                                 {-0.02, 0.004, -0.0006, 0.00002}};

/// From 80 units away.
splat::Camera farView(double Focal, const CameraModel &Optics) {
  splat::Camera C = viewOf(96, 64, Focal, Optics);
  for (double &P : C.Position)
    P *= 40;
  return C;
}

splat::Camera sphereView() {
  splat::Camera C = viewOf(16384, 48, 1, {&lenses::Equirectangular});
  C.Fx = C.Width / (2 * M_PI);
  C.Fy = C.Height / M_PI;
  return C;
}

} // namespace

splat::Camera longView() { return farView(4e5, {}); }

splat::Camera wideView() {
  splat::Camera C = viewOf(16384, 16, 9000);
  C.Cx = 5000.25;
  return C;
}

splat::Scene smallOnPicture(const splat::Camera &C, uint32_t Count,
                            uint32_t Seed) {
  splat::Scene S;
  Numbers R(Seed);
  const double Near = std::max(2.0, std::abs(C.Position[0]));
  for (uint32_t I = 0; I < Count; ++I) {
    const double Depth = R.uniform(Near, 3 * Near);
    const double Column = R.uniform(2, C.Width - 2);
    const double Row = R.uniform(2, C.Height - 2);
    const Sight Seen = sightAt(C, Column, Row, Depth);
    add(S, {.Mean = seenAt(C, Seen.At[0], Seen.At[1], Seen.At[2]),
            .Scale = {Seen.Pixel * R.uniform(0.5, 3),
                      Seen.Pixel * R.uniform(0.5, 3),
                      Seen.Pixel * R.uniform(0.5, 3)},
            .Quat = R.turn(),
            .Opacity = R.uniform(0.3, 0.95),
            .Color = R.color()});
  }
  return S;
}

void addPlaces(std::vector<HardCase> &Cases) {
  Cases.push_back(crop("crop-of-a-large-picture",
                       ": f x / z + c cancels, and pixels keep 1e-3 px", {},
                       {"crop-by-plain-sum", "crop-by-plain-axes"}));
  Cases.push_back(crop("crop-through-opencv",
                       ", behind a lens that bends there", Bending,
                       {"crop-by-plain-squares"}));
  Cases.push_back(crop("crop-through-fisheye",
                       ", 75 degrees from a fisheye's axis", BendingFisheye,
                       {"crop-by-plain-bend"}));
  Cases.push_back(crop("crop-through-division", ", through a division",
                       {&lenses::Division, {-0.1}}, {}));
  Cases.push_back(crop("crop-through-eucm",
                       ", through the enhanced unified camera model",
                       {&lenses::Eucm, {0.5, 1.2}}, {}));
  Cases.push_back(crop("crop-of-parallel-rays", ", of parallel rays",
                       {&lenses::Orthographic}, {"crop-by-plain-start"}));
  addCropsThroughOthers(Cases);

  Cases.push_back(caseOf("long-lens",
                         "a focal length of 400,000 px: of a place, the sum "
                         "R (m - c) keeps 0.1 px",
                         longView(),
                         {"crop-by-plain-sum", "crop-by-plain-axes"}));
  Cases.push_back(caseOf("long-lens-opencv",
                         "a focal length of a million px behind OpenCV's lens",
                         farView(1e6, Bending), {"crop-by-plain-axes"}));
  Cases.push_back(caseOf("long-lens-fisheye", "a fisheye of 100,000 px",
                         farView(1e5, BendingFisheye), {"crop-by-plain-axes"}));
  Cases.push_back(caseOf(
      "long-parallel-rays", "parallel rays of 20,000 px a unit, 80 units away",
      farView(2e4, {&lenses::Orthographic}), {"crop-by-plain-axes"}));

  Cases.push_back(caseOf("wide-picture",
                         "16,384 px wide, the principal point beside its "
                         "middle: fp32 keeps 1e-3 px of a place",
                         wideView(), {"windows-by-plain-places"}));
  Cases.push_back(
      caseOf("tall-picture-opencv", "16,384 px high, through OpenCV's lens",
             viewOf(16, 16384, 9000, Bending), {"windows-by-plain-places"}));
  Cases.push_back(caseOf(
      "wide-picture-fisheye", "16,384 px wide, through a fisheye",
      viewOf(16384, 16, 9000, BendingFisheye), {"windows-by-plain-places"}));
  Cases.push_back(caseOf("wide-parallel-rays", "16,384 px wide, parallel rays",
                         viewOf(16384, 16, 9000, {&lenses::Orthographic}),
                         {"windows-by-plain-places"}));
  Cases.push_back(caseOf("wide-sphere", "a full sphere 16,384 px around",
                         sphereView(), {"windows-by-plain-places"}));
  Cases.push_back(caseOf("wide-long-lens",
                         "16,384 px wide, a focal length of 500,000 px",
                         viewOf(16384, 16, 5e5), {"windows-by-plain-places"}));
}

} // namespace vorion::test
