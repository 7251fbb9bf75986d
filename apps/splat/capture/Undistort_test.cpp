#include "capture/Undistort.h"
#include "lens/Models.h"

#include "vorion/support/Hash.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

constexpr int Width = 48, Height = 40;

Camera pinhole() {
  Camera C = Camera::ahead(Width, Height, 40);
  C.Fy = 44;
  C.Cx = 22.5;
  C.Cy = 21;
  return C;
}

/// Whose red says in which column a place is, and whose green the row; linear,
/// so that what lies between pixels is known.
MaskedPlane places() {
  MaskedPlane P{{Width, Height, {}}, {}};
  for (int Row = 0; Row < Height; ++Row)
    for (int Column = 0; Column < Width; ++Column)
      for (const int V : {5 * Column, 5 * Row, 7, 255})
        P.Picture.Rgba.push_back(static_cast<std::byte>(V));
  return P;
}

/// That each pixel that counts shows the place that \p Want gives for the ray
/// of (x, y), and that those outside do not count. How many count.
int expectPlaces(
    const CameraModel &L,
    const std::function<std::array<double, 2>(double, double)> &Want) {
  const Camera C = pinhole();
  const MaskedPlane To = undistorted(places(), C, L);
  int Counted = 0;
  for (int Row = 0; Row < Height; ++Row)
    for (int Column = 0; Column < Width; ++Column) {
      const auto [X, Y] =
          Want((Column + 0.5 - C.Cx) / C.Fx, (Row + 0.5 - C.Cy) / C.Fy);
      const double U = C.Fx * X + C.Cx, V = C.Fy * Y + C.Cy;
      const auto At = static_cast<std::size_t>(Row * Width + Column);
      const bool Inside = U >= 0 && U <= Width && V >= 0 && V <= Height;
      EXPECT_EQ(To.Counts[At] != 0, Inside) << Column << " " << Row;
      if (!Inside)
        continue;
      ++Counted;
      EXPECT_NEAR(To.Picture.at(At, 0),
                  5 * std::clamp(U - 0.5, 0.0, Width - 1.0), 0.5001);
      EXPECT_NEAR(To.Picture.at(At, 1),
                  5 * std::clamp(V - 0.5, 0.0, Height - 1.0), 0.5001);
      EXPECT_EQ(To.Picture.at(At, 2), 7U);
      EXPECT_EQ(To.Picture.at(At, 3), 255U);
    }
  return Counted;
}

TEST(Undistort, FollowsOpenCvsPolynomials) {
  // The terms as OpenCV's documentation of calib3d writes them.
  const double K1 = 0.2, K2 = -0.1, K3 = 0.05, K4 = 0.1, K5 = 0.02, K6 = 0.01;
  const double P1 = 0.01, P2 = -0.02;
  const int Counted = expectPlaces(
      {&lenses::OpenCv, {K1, K2, P1, P2, K3, K4, K5, K6}},
      [&](double X, double Y) -> std::array<double, 2> {
        const double R2 = X * X + Y * Y;
        const double Scale =
            (1 + K1 * R2 + K2 * R2 * R2 + K3 * std::pow(R2, 3)) /
            (1 + K4 * R2 + K5 * R2 * R2 + K6 * std::pow(R2, 3));
        return {X * Scale + 2 * P1 * X * Y + P2 * (R2 + 2 * X * X),
                Y * Scale + P1 * (R2 + 2 * Y * Y) + 2 * P2 * X * Y};
      });
  EXPECT_GT(Counted, Width * Height / 2);
  EXPECT_LT(Counted, Width * Height);
}

TEST(Undistort, AFisheyesPolynomialIsOfTheAngle) {
  const double K[] = {0.05, -0.02, 0.01, -0.003};
  EXPECT_EQ(expectPlaces({&lenses::Fisheye, {K[0], K[1], K[2], K[3]}},
                         [&](double X, double Y) -> std::array<double, 2> {
                           const double R = std::hypot(X, Y), A = std::atan(R);
                           const double Out =
                               A *
                               (1 + K[0] * A * A + K[1] * std::pow(A, 4) +
                                K[2] * std::pow(A, 6) + K[3] * std::pow(A, 8));
                           return R > 0 ? std::array{X * Out / R, Y * Out / R}
                                        : std::array{X, Y};
                         }),
            Width * Height);
}

TEST(Undistort, WhereALensFoldsBackNothingCounts) {
  // r - r^3 / 2 grows up to the root of 2/3.
  const CameraModel L{&lenses::OpenCv, {-0.5}};
  Camera C = pinhole();
  C.Fx = C.Fy = 10;
  const MaskedPlane To = undistorted(places(), C, L);
  for (int Column = 0; Column < Width; ++Column) {
    const std::size_t At = 20 * Width + static_cast<std::size_t>(Column);
    const double X = (Column + 0.5 - C.Cx) / 10, Y = -0.5 / 10;
    EXPECT_EQ(To.Counts[At] != 0, X * X + Y * Y <= 2.0 / 3) << Column;
  }
  const CameraModel None{&lenses::OpenCv, {std::nan("")}};
  for (const uint8_t Counts : undistorted(places(), C, None).Counts)
    EXPECT_EQ(Counts, 0);
}

TEST(Undistort, WhatDoesNotCountStaysSo) {
  MaskedPlane From = places();
  From.Counts.assign(From.Picture.pixels(), 1);
  From.Counts[10 * Width + 12] = 0;
  // Shifts by half a pixel, nearly: two pixels are made of it.
  const CameraModel L{&lenses::OpenCv, {1e-9}};
  Camera C = pinhole();
  const MaskedPlane To = undistorted(From, C, L);
  EXPECT_EQ(To.Counts[10 * Width + 12], 0);
  EXPECT_EQ(To.Counts[20 * Width + 20], 1);
}

// What is trained on must not change with how the lens is written.
TEST(Undistort, KeepsItsBits) {
  CameraModel OfNerfstudio{&lenses::OpenCv, {-0.1, 0.05, 0.01, -0.02, 0.01}};
  OfNerfstudio.K[12] = 0.02;
  const CameraModel Lenses[] = {
      {&lenses::OpenCv, {0.1}},
      {&lenses::OpenCv, {-0.08, 0.02, 0.004, -0.003}},
      {&lenses::OpenCv, {0.2, -0.1, 0.01, -0.02, 0.05, 0.1, 0.02, 0.01}},
      OfNerfstudio,
      {&lenses::Fisheye, {0.05, -0.02, 0.01, -0.003}}};
  std::string Hashes;
  for (const CameraModel &L : Lenses) {
    const MaskedPlane To = undistorted(places(), pinhole(), L);
    std::string Bytes(To.Counts.begin(), To.Counts.end());
    for (const std::byte B : To.Picture.Rgba)
      Bytes += static_cast<char>(B);
    Hashes += vorion::fnv1a64(Bytes) + "\n";
  }
  EXPECT_EQ(Hashes, "7a70f38f1712daef\n2d87191155a23d9e\nc9f2def7c196cd1d\n"
                    "140f1d36f5cb3f6a\nf3518fd6eb0d2547\n");
}

TEST(Undistort, ASmallPixelCountsWhereAllOfItCounts) {
  const std::vector<uint8_t> Counts{1, 1, 1, 1, 0, //
                                    1, 1, 1, 1, 1, //
                                    1, 0, 1, 1, 1};
  EXPECT_EQ(shrinkCounts(Counts, 5, 3, 5, 3), Counts);
  EXPECT_EQ(shrinkCounts(Counts, 5, 3, 1, 1), std::vector<uint8_t>{0});
  // Columns 0 to 2.5 and 2.5 to 5, rows 0 to 1.5 and 1.5 to 3.
  EXPECT_EQ(shrinkCounts(Counts, 5, 3, 2, 2),
            (std::vector<uint8_t>{1, 0, 0, 1}));
  EXPECT_TRUE(shrinkCounts({}, 5, 3, 2, 2).empty());
}

} // namespace
