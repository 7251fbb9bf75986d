// Cameras that are no pinholes: where their models end, fold and close.
#include "Lenses.h"

#include <cmath>
#include <limits>

namespace vorion::test {

namespace lenses = splat::lenses;
using splat::LensModel;

splat::Camera lensView(const LensModel *M, splat::LensCoefficients K, int Width,
                       int Height) {
  splat::Camera C = frontView(Width, Height, 50);
  C.Optics = {M, K};
  if (M == &lenses::Equirectangular) {
    C.Fx = Width / (2 * M_PI);
    C.Fy = Height / M_PI;
  } else if (M == &lenses::Fisheye) {
    C.Fx = C.Fy = 20;
  } else if (M == &lenses::Orthographic) {
    C.Fx = C.Fy = 12;
  }
  return C;
}

splat::LensCoefficients someCoefficients(const LensModel *M) {
  if (M == &lenses::OpenCv)
    return {-0.25, 0.08,  0.004,  -0.006, -0.01, 0.02, 0.03,
            0.01,  0.003, -0.001, 0.002,  0.001, 0.005};
  if (M == &lenses::Division)
    return {-0.3};
  if (M == &lenses::Eucm)
    return {0.6, 1.2};
  if (M == &lenses::Fisheye)
    return {0.06, -0.02, 0.005, -0.0006};
  splat::LensCoefficients K{};
  for (std::size_t I = 0; I < M->Keys.size(); ++I)
    K[I] = (I % 2 == 0 ? -0.05 : 0.02) / static_cast<double>(1 + I);
  return K;
}

splat::Scene allAround(uint32_t Count, uint32_t Seed, double Scale) {
  splat::Scene S;
  Numbers R(Seed);
  while (S.size() < Count) {
    const std::array<double, 3> At{R.uniform(-4, 4), R.uniform(-4, 4),
                                   R.uniform(-4, 4)};
    const double Distance = std::hypot(At[0], At[1], At[2]);
    if (Distance < 1 || Distance > 4)
      continue;
    add(S, {.Mean = {static_cast<float>(At[0]), static_cast<float>(At[1]),
                     static_cast<float>(At[2])},
            .Scale = {Scale * R.uniform(0.3, 1), Scale * R.uniform(0.3, 1),
                      Scale * R.uniform(0.3, 1)},
            .Quat = R.turn(),
            .Opacity = R.uniform(0.2, 0.95),
            .Color = R.color()});
  }
  return S;
}

splat::Camera needleView(const LensModel *M) {
  // Short enough for the means to keep their digits.
  splat::Camera C = turnedView(frontView(96, 64, M->IsParallel ? 40 : 250));
  C.Optics = {M, someCoefficients(M)};
  return C;
}

splat::Scene pointingNeedles(const splat::Camera &C, uint32_t Seed) {
  splat::Scene S;
  Numbers R(Seed);
  const bool IsParallel = C.Optics.Model->IsParallel;
  for (int I = 0; I < 60; ++I) {
    const double Z = R.uniform(2, 6), Pixel = (IsParallel ? 1 : Z) / C.Fx;
    const double X = (R.uniform(3, C.Width - 3) - C.Cx) * Pixel;
    const double Y = (R.uniform(3, C.Height - 3) - C.Cy) * Pixel;
    const auto Mean = seenAt(C, X, Y, Z);
    const double Length = R.uniform(1000, 6000) * Pixel;
    // A point of the ray, and beside it as much as the picture is to have.
    const double Far = IsParallel ? 0 : Length / Z;
    const double Aside = R.uniform(0.5, 3) * Pixel;
    const double Angle = R.uniform(0, 6.28);
    const auto Tip = seenAt(C, X * (1 + Far) + Aside * std::cos(Angle),
                            Y * (1 + Far) + Aside * std::sin(Angle),
                            Z + (IsParallel ? Length : Z * Far));
    std::array<double, 3> Axis{};
    for (std::size_t K = 0; K < 3; ++K)
      Axis[K] = double(Tip[K]) - double(Mean[K]);
    const double Long = std::hypot(Axis[0], Axis[1], Axis[2]);
    // It turns the first axis there.
    add(S, {.Mean = Mean,
            .Scale = {Length, Pixel * R.uniform(0.3, 2),
                      Pixel * R.uniform(0.3, 2)},
            .Quat = {static_cast<float>(1 + Axis[0] / Long), 0,
                     static_cast<float>(-Axis[2] / Long),
                     static_cast<float>(Axis[1] / Long)},
            .Opacity = R.uniform(0.3, 0.95),
            .Color = R.color()});
  }
  return S;
}

namespace {

HardCase caseOf(std::string Name, std::string Why, splat::Scene S,
                splat::Camera View) {
  HardCase C{
      std::move(Name), std::move(Why), std::move(S), std::move(View), {}};
  C.Options.Optics = C.View.Optics.Model;
  C.Cap = 1e-4;
  // Where depth is z, what is behind is not drawn.
  if (!C.Options.byDistance())
    for (std::size_t I = 2; I < C.Scene.Means.size(); I += 3)
      C.ExpectedCulls[0] += C.Scene.Means[I] > 0.2F ? 0 : 1;
  return C;
}

/// Appends one that is seen where the model has its \p Angle from the axis.
void addAtAngle(splat::Scene &S, double Angle, double About, double Distance) {
  const double Out = Distance * std::sin(Angle);
  add(S, {.Mean = {static_cast<float>(Out * std::cos(About)),
                   static_cast<float>(Out * std::sin(About)),
                   static_cast<float>(Distance * std::cos(Angle))},
          .Scale = {0.1, 0.05, 0.08}});
}

HardCase distorted() {
  HardCase C =
      caseOf("opencv-distortion",
             "all thirteen coefficients; Gaussians all around, half of "
             "them behind the camera",
             allAround(160, 71),
             lensView(&lenses::OpenCv, someCoefficients(&lenses::OpenCv)));
  C.ExpectedCulls[3] = 43;
  return C;
}

/// k1 = -0.3: r (1 - 0.3 r^2) turns back at r = 1.054.
HardCase opencvFold() {
  HardCase C = caseOf("opencv-fold",
                      "means beside the radius at which the polynomial turns "
                      "back, from where it would show them mirrored inside",
                      {}, lensView(&lenses::OpenCv, {-0.3}, 128, 96));
  const double Fold = std::atan(C.View.Optics.limit());
  for (const double Off : {-0.3, -0.1, -1e-3, 1e-3, 0.1, 0.3})
    addAtAngle(C.Scene, Fold + Off, 4 * Off, 2);
  C.ExpectedCulls[3] = 3;
  C.FoundIn = {"opencv-folds"};
  return C;
}

/// r (1 - 0.5 r^2 + 0.08 r^4) turns back at r = 0.93, comes down to 0.49 and
/// rises again from r = 1.70 on.
HardCase opencvUnfold() {
  HardCase C = caseOf("opencv-unfold",
                      "means where the polynomial rises again behind its fold, "
                      "and would show a second picture upright",
                      {}, lensView(&lenses::OpenCv, {-0.5, 0.08}, 128, 96));
  for (const double Radius : {0.3, 0.7, 0.92, 0.95, 1.7, 1.8, 2.0, 2.2})
    addAtAngle(C.Scene, std::atan(Radius), 2 * Radius, 2);
  C.ExpectedCulls[3] = 5;
  C.FoundIn = {"opencv-folds", "opencv-unfolds"};
  return C;
}

HardCase fisheyeFold() {
  HardCase C = caseOf("fisheye-fold",
                      "means beside the angle at which a fisheye's polynomial "
                      "turns back, which is behind the camera",
                      {}, lensView(&lenses::Fisheye, {-0.1}, 128, 96));
  const double Fold = C.View.Optics.limit();
  for (const double Off : {-0.5, -0.2, -1e-3, 1e-3, 0.2, 0.9})
    addAtAngle(C.Scene, Fold + Off, 5 * Off, 2);
  C.ExpectedCulls[3] = 3;
  C.FoundIn = {"fisheye-folds"};
  return C;
}

/// t (1 - 0.2 t^2 + 0.015 t^4) turns back at t = 1.54 and rises again from 2.37
/// on.
HardCase fisheyeUnfold() {
  HardCase C = caseOf("fisheye-unfold",
                      "the same of a fisheye's angle: what is behind the "
                      "camera would stand beside what is in front",
                      {}, lensView(&lenses::Fisheye, {-0.2, 0.015}, 128, 96));
  for (const double Angle : {0.3, 1.0, 1.5, 1.6, 2.4, 2.6, 2.8, 3.1})
    addAtAngle(C.Scene, Angle, 2 * Angle, 2);
  C.ExpectedCulls[3] = 5;
  C.FoundIn = {"fisheye-folds", "fisheye-unfolds"};
  return C;
}

HardCase fisheyeAxis() {
  HardCase C = caseOf(
      "fisheye-axis",
      "on the axis and 1e-30 to 1e-3 beside it, where angle "
      "over radius is 0 over 0, and straight behind",
      {}, lensView(&lenses::Fisheye, someCoefficients(&lenses::Fisheye)));
  Numbers R(72);
  for (const double Off : {0., 1e-30, 1e-20, 1e-10, 1e-6, 1e-4, 1e-3})
    add(C.Scene,
        {.Mean = {static_cast<float>(Off), static_cast<float>(-0.5 * Off),
                  static_cast<float>(R.uniform(1, 3))},
         .Scale = {0.2, 0.05, 0.1},
         .Quat = R.turn(),
         .Opacity = 0.3,
         .Color = R.color()});
  add(C.Scene, {.Mean = {0, 0, -2}});
  C.ExpectedCulls[3] = 1;
  return C;
}

HardCase fisheyeAround() {
  return caseOf("fisheye-all-around",
                "Gaussians beside and behind a camera that sees them: z below "
                "0, depth by distance",
                allAround(160, 73), lensView(&lenses::Fisheye, {}, 140, 140));
}

HardCase orthographic() {
  HardCase C = caseOf("orthographic",
                      "parallel rays: what is far is as large as what is near",
                      allAround(160, 74), lensView(&lenses::Orthographic));
  C.ExpectedCulls[3] = 27;
  return C;
}

HardCase seam() {
  HardCase C = caseOf("equirectangular-seam",
                      "Gaussians behind the camera that cross the seam, one of "
                      "them twice as wide as the picture",
                      {}, lensView(&lenses::Equirectangular, {}, 96, 48));
  Numbers R(75);
  for (const double Angle : {M_PI, -3.1, 3.0, -2.9, 3.14159, 2.2})
    add(C.Scene, {.Mean = {static_cast<float>(2 * std::sin(Angle)),
                           static_cast<float>(R.uniform(-0.8, 0.8)),
                           static_cast<float>(2 * std::cos(Angle))},
                  .Scale = {0.5, 0.2, 0.3},
                  .Opacity = 0.5,
                  .Color = R.color()});
  add(C.Scene, {.Mean = {0.1F, 0.3F, -2.5F}, .Scale = {40, 0.1, 0.1}});
  return C;
}

HardCase poles() {
  HardCase C = caseOf("equirectangular-poles",
                      "straight up and down and 1e-20 to 0.1 beside it, where "
                      "a longitude is anything",
                      {}, lensView(&lenses::Equirectangular, {}, 96, 48));
  Numbers R(76);
  for (const double Off : {0., 1e-20, 1e-6, 1e-3, 0.1})
    for (const float Up : {-2.0F, 2.0F})
      add(C.Scene, {.Mean = {static_cast<float>(-Off), Up,
                             static_cast<float>(0.5 * Off)},
                    .Scale = {0.05, 0.1, 0.08},
                    .Quat = R.turn(),
                    .Opacity = 0.4,
                    .Color = R.color()});
  return C;
}

HardCase sphere() {
  return caseOf("equirectangular-all-around",
                "Gaussians all around on a full sphere, turned",
                allAround(200, 77),
                turnedView(lensView(&lenses::Equirectangular, {}, 120, 60)));
}

HardCase hugeCoefficients() {
  // Everything but what is within r = 1e-3 of the axis lies beyond the fold.
  HardCase C = caseOf("huge-coefficients",
                      "k1 of -1e6: the polynomial turns back at r = 5.8e-4, "
                      "and its powers reach 1e24",
                      allAround(40, 78),
                      lensView(&lenses::OpenCv, {-1e6, 1e6, 0, 0, 1e6}));
  add(C.Scene, {.Mean = {1e-4F, 2e-4F, 2}});
  C.ExpectedCulls[3] = 17;
  return C;
}

HardCase unscentedWide() {
  HardCase C = caseOf(
      "unscented-wide",
      "Gaussians as wide as they are far through a fisheye as "
      "seven points, some of which it does not see",
      allAround(60, 79, 1.2),
      lensView(&lenses::Fisheye, someCoefficients(&lenses::Fisheye), 128, 96));
  C.Options.Through = splat::Spread::Unscented;
  C.ExpectedCulls[3] = 8;
  return C;
}

HardCase unscentedSeam() {
  HardCase C = seam();
  C.Name = "unscented-seam";
  C.Why = "the points of one Gaussian on both sides of the seam";
  C.Options.Through = splat::Spread::Unscented;
  return C;
}

HardCase unscentedBeside() {
  HardCase C = caseOf("unscented-beside",
                      "large Gaussians beside a pinhole's picture as seven "
                      "points, one of each just in front of the near plane and "
                      "far away: footprints must not cover the picture",
                      allAround(60, 85), frontView(128, 96, 50));
  Numbers R(86);
  for (const auto &[X, Y, Z] : {std::array{2.0F, 0.3F, 1.2F},
                                {-2.4F, -1.0F, 1.5F},
                                {0.5F, -2.2F, 1.6F}})
    add(C.Scene, {.Mean = {X, Y, Z},
                  .Scale = {0.4, 0.3, (Z - 0.25) / std::sqrt(3.)},
                  .Opacity = 0.9,
                  .Color = R.color()});
  C.Options.Through = splat::Spread::Unscented;
  C.ExpectedCulls[3] = 14;
  C.FoundIn = {"points-anywhere"};
  return C;
}

/// Half a radian and a third of the way to what it sees in one exposure.
splat::Camera rollingView(const LensModel *M) {
  splat::Camera C = lensView(M, someCoefficients(M), 128, 96);
  C.Optics.Shutter = {-0.1, 0.2, 1, {0.4, -0.5, 0.2}, {0.2, -0.3, 0.4}};
  return C;
}

HardCase rolling(const LensModel *M, std::string Name, std::string Why,
                 uint32_t Seed) {
  HardCase C = caseOf(std::move(Name), std::move(Why), allAround(160, Seed),
                      rollingView(M));
  C.Options.Rolling = true;
  return C;
}

HardCase rollingPinhole() {
  HardCase C = rolling(&lenses::Pinhole, "rolling-pinhole",
                       "a shutter that rolls down and across while the camera "
                       "moves and turns; Gaussians all around",
                       81);
  // Those of the pose, but for what moves across the near plane.
  C.ExpectedCulls[0] = 80;
  C.ExpectedCulls[3] = 48;
  return C;
}

HardCase rollingOpenCv() {
  HardCase C = rolling(&lenses::OpenCv, "rolling-opencv",
                       "the same through all thirteen coefficients", 82);
  C.ExpectedCulls[0] = 94;
  C.ExpectedCulls[3] = 30;
  return C;
}

HardCase rollingFisheye() {
  HardCase C = rolling(&lenses::Fisheye, "rolling-fisheye",
                       "the same of what is beside and behind a fisheye", 83);
  C.ExpectedCulls[3] = 28;
  return C;
}

HardCase rollingUnscented() {
  HardCase C = rolling(&lenses::Fisheye, "rolling-unscented",
                       "seven points, each at a moment of its own", 84);
  C.Options.Through = splat::Spread::Unscented;
  C.ExpectedCulls[3] = 34;
  return C;
}

/// What is z away moves down by 150 / z px in 96 rows: from 2.08 on, a quarter
/// of the shutter's way is left.
HardCase rollingFollowed() {
  HardCase C = caseOf("rolling-followed",
                      "a picture that runs after its shutter: most of the "
                      "near Gaussians have no moment of their own",
                      {}, frontView(128, 96, 50));
  C.View.Optics.Shutter = {0, 0, 1, {0, -3, 0}, {}};
  C.Options.Rolling = true;
  for (const float Z : {0.5F, 1.0F, 1.5F, 2.0F, 2.2F, 3.0F, 5.0F, 20.0F})
    add(C.Scene, {.Mean = {0.02F * Z, -0.1F * Z, Z},
                  .Scale = {0.05 * Z, 0.02 * Z, 0.03 * Z},
                  .Opacity = 0.5});
  C.ExpectedCulls[3] = 4;
  return C;
}

HardCase rollingBeside() {
  HardCase C = caseOf("rolling-beside",
                      "large Gaussians far beside a pinhole's picture, whose "
                      "own drift in an exposure is many pictures wide: "
                      "footprints must not cover the picture",
                      {}, frontView(120, 68, 104));
  C.View.Optics.Shutter = {0, 0, 1, {0.02, 0, 0.03}, {0.01, 0.05, 0.01}};
  C.Options.Rolling = true;
  add(C.Scene, {.Mean = {31, -2.5F, 4.5F}, .Scale = {1.5, 1.4, 1.6}});
  add(C.Scene, {.Mean = {0.1F, -0.1F, 2}, .Scale = {0.1, 0.05, 0.08}});
  C.ExpectedCulls[3] = 1;
  C.FoundIn = {"drift-not-held"};
  return C;
}

/// The picture moves up by 50 px in 96 rows, so that the picture
/// is pressed together by a third; to the right it is sheared by as much.
HardCase rollingDilation() {
  HardCase C = caseOf("rolling-dilation",
                      "needles and points thinner than a pixel behind a fast "
                      "shutter: nearly all that is seen is dilation, which is "
                      "round in each row's own picture",
                      {}, frontView(128, 96, 100));
  C.View.Optics.Shutter = {0, 0.1, 1, {}, {-0.5, 0.5, 0.2}};
  C.Options.Rolling = true;
  Numbers R(88);
  for (int I = 0; I < 40; ++I)
    add(C.Scene, {.Mean = {float(R.uniform(-1, 1)), float(R.uniform(-0.7, 0.7)),
                           float(R.uniform(2, 3))},
                  .Scale = {1e-4, I % 2 == 0 ? 1e-4 : 0.1, 1e-3},
                  .Quat = R.turn(),
                  .Opacity = 0.9,
                  .Color = R.color()});
  C.FoundIn = {"dilation-not-sheared"};
  return C;
}

HardCase rollingNearPlane() {
  HardCase C = caseOf("rolling-near-plane",
                      "a camera that moves forward while it exposes: means "
                      "come before the near plane of its pose, and leave it, "
                      "before the moment at which they are seen",
                      {}, frontView(64, 48, 55));
  C.View.Optics.Shutter = {0, 0, 1, {0, 0, 0.5}, {}};
  C.Options.Rolling = true;
  for (const auto &[Y, Z] : {std::array{-0.04F, 0.15F},
                             {-0.04F, 0.3F},
                             {-0.04F, 0.6F},
                             {0.02F, 0.24F},
                             {0.02F, 0.25F},
                             {0.02F, 0.3F},
                             {0.02F, 0.6F}})
    add(C.Scene,
        {.Mean = {0, Y, Z}, .Scale = {0.002, 0.003, 0.001}, .Opacity = 0.5});
  C.ExpectedCulls[0] = 2;
  C.FoundIn = {"near-plane-of-the-pose"};
  return C;
}

HardCase pointing(std::string Name, const std::string &Where,
                  const LensModel *M) {
  const splat::Camera View = needleView(M);
  HardCase C = caseOf(std::move(Name),
                      "needles of 1,000 to 6,000 px that point at the camera" +
                          Where + ": the picture has 3 px of them",
                      pointingNeedles(View, 84), View);
  C.ExpectedCulls = {}; // the camera is turned
  C.Cap = 5e-6;
  C.FoundIn = {"needles-by-plain-sums"};
  return C;
}

HardCase unscentedNeedle() {
  HardCase C =
      caseOf("unscented-needles",
             "needles as seven points through OpenCV's model: the "
             "determinant is a sum of 21 squares",
             {}, lensView(&lenses::OpenCv, someCoefficients(&lenses::OpenCv)));
  Numbers R(80);
  for (int I = 0; I < 12; ++I)
    add(C.Scene, {.Mean = {static_cast<float>(R.uniform(-0.6, 0.6)),
                           static_cast<float>(R.uniform(-0.4, 0.4)),
                           static_cast<float>(R.uniform(2, 3))},
                  .Scale = {0.6, 1e-4, 1e-4},
                  .Quat = R.turn(),
                  .Color = R.color()});
  C.Options.Through = splat::Spread::Unscented;
  C.Cap = 1e-3;
  return C;
}

HardCase ownNearPlane() {
  HardCase C = caseOf("own-near-plane",
                      "a near plane of 2 by option: means on it and one ulp "
                      "either side",
                      {}, frontView(64, 48, 50));
  C.Options.Near = 2;
  for (const float Z : {0.5F, std::nextafter(2.0F, 0.0F), 2.0F,
                        std::nextafter(2.0F, 3.0F), 3.0F})
    add(C.Scene, {.Mean = {0.1F, 0, Z}, .Opacity = 0.4});
  C.ExpectedCulls[0] = 3;
  return C;
}

} // namespace

void addLenses(std::vector<HardCase> &Cases) {
  for (HardCase (*const Make)() :
       {distorted,       opencvFold,       opencvUnfold,
        fisheyeFold,     fisheyeUnfold,    fisheyeAxis,
        fisheyeAround,   orthographic,     seam,
        poles,           sphere,           hugeCoefficients,
        unscentedWide,   unscentedSeam,    unscentedNeedle,
        unscentedBeside, rollingPinhole,   rollingOpenCv,
        rollingFisheye,  rollingUnscented, rollingFollowed,
        rollingBeside,   rollingDilation,  rollingNearPlane,
        ownNearPlane})
    Cases.push_back(Make());
  Cases.push_back(pointing("needles-at-the-camera", "", &lenses::Pinhole));
  Cases.push_back(pointing("needles-at-opencv", " with OpenCV's distortion",
                           &lenses::OpenCv));
  Cases.push_back(
      pointing("needles-at-a-fisheye", ", a fisheye", &lenses::Fisheye));
  Cases.push_back(pointing("needles-along-parallel-rays",
                           ", with parallel rays", &lenses::Orthographic));
}

} // namespace vorion::test
