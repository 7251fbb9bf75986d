// The reference in fp64 against every fixture: pictures, and what leads to
// them. Each test prints its figure.

#include "Convert.h"
#include "io/Metrics.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::test;
using reference::Support;

namespace {

/// Where the build found the project, with the data beside it.
const std::filesystem::path Folder = VORION_FIXTURES;

/// Least PSNR of the pictures, dB: an error of 1e-6 a channel. The fixtures'
/// results are within 1e-8 of exact ones where they are stored in float32.
constexpr double LeastDb = 120;

/// Some fixtures keep 32 significant bits.
constexpr double Stored = 0x1p-32 * 1.01;

const char *const Gsplat[] = {
    "garden_crop192x144",  "guitar256",           "hard_alpha_half_stack",
    "hard_behind_camera",  "hard_depth_ties",     "hard_far_offset",
    "hard_huge_scale",     "hard_near_plane",     "hard_needle",
    "hard_opaque_stack64", "hard_pancake_eps2d0", "hard_sh_clamp",
    "hard_subpixel",       "hard_thin_stack4000", "hard_zero_quat",
    "random2k_sh3",        "random2k_sh3_aa"};
const char *const Inria[] = {"inria_box_crop",
                             "inria_edge_of_fov",
                             "inria_random2k_sh3",
                             "inria_random2k_sh3_aa",
                             "inria_room7k_front",
                             "inria_tile_handover_15",
                             "inria_tile_handover_16",
                             "inria_tile_handover_17",
                             "inria_tile_handover_15_72x40",
                             "inria_tile_handover_16_72x40",
                             "inria_tile_handover_17_72x40"};

class FixtureTest : public testing::TestWithParam<const char *> {
protected:
  void SetUp() override {
    const auto Path = Folder / (std::string(GetParam()) + ".npz");
    if (!std::filesystem::exists(Path))
      GTEST_SKIP() << "no ../shared/data/reference/" << GetParam() << ".npz";
    auto Read = readFixture(Path);
    ASSERT_TRUE(Read) << Read.error().Where << ": " << Read.error().What;
    F = std::move(*Read);
    // The room's other pictures are in a file of their own.
    const auto More = Folder / (std::string(GetParam()) + "_more.npz");
    if (std::filesystem::exists(More)) {
      auto Arrays = splat::readNpz(More);
      ASSERT_TRUE(Arrays) << Arrays.error().What;
      F.Arrays.merge(*Arrays);
    }
    Splats = reference::project(F.Gaussians, F.Camera, F.Options);
  }

  /// Compares \p Array with the picture under \p Reach.
  void expectPicture(const std::string &Array, Support Reach) {
    ASSERT_TRUE(F.has(Array)) << Array;
    auto O = F.Options;
    O.Reach = Reach;
    const auto P = reference::render(F.Gaussians, F.Camera, O);
    const auto Expected = F.doubles(Array);
    const auto All = splat::compare(Expected, renderOf(P), 3);
    const auto Outside = splat::compare(Expected, renderOf(P), 3, P.Doubts);
    fmt::print("{:<29}{:<23}{:>8.1f} dB, outside doubtful {:>6.1f} dB, "
               "largest {:.1e}, doubtful {:.3f} %\n",
               F.Name, Array, All.PsnrDb, Outside.PsnrDb, All.MaxAbs,
               100 * P.doubtfulShare());
    EXPECT_GE(All.PsnrDb, LeastDb) << Array;
  }

  /// Expects \p Array to hold \p Value(splat) for what the fixture shows, to a
  /// relative \p Tolerance of the largest component.
  template <typename Function>
  void expectValues(const std::string &Array, std::size_t Each,
                    double Tolerance, Function Value) {
    if (!F.has(Array))
      return; // large fixtures leave some out
    const auto Expected = F.doubles(Array), Radii = F.doubles("f64_radii");
    double Worst = 0;
    for (std::size_t I = 0; I < Splats.size(); ++I) {
      if (Radii[2 * I] <= 0)
        continue;
      ASSERT_TRUE(Splats[I].Visible || Splats[I].Opacity * 255 < 1) << I;
      if (!Splats[I].Visible)
        continue;
      const auto V = Value(Splats[I]);
      double Scale = 0;
      for (std::size_t K = 0; K < Each; ++K)
        Scale = std::max(Scale, std::abs(Expected[I * Each + K]));
      for (std::size_t K = 0; K < Each; ++K)
        Worst = std::max(
            Worst, std::abs(V[static_cast<int>(K)] - Expected[I * Each + K]) /
                       std::max(Scale, 1e-300));
    }
    fmt::print("{:<29}{:<23}{:>12.1e} largest relative difference\n", F.Name,
               Array, Worst);
    EXPECT_LE(Worst, Tolerance) << Array;
  }

  Fixture F;
  std::vector<reference::Splat<double>> Splats;
};

class GsplatFixture : public FixtureTest {};
class InriaFixture : public FixtureTest {};

using One = std::array<double, 1>;

TEST_P(GsplatFixture, PictureAndAlpha) {
  expectPicture("f64_render", Support::Exact);
  const auto P = reference::render(F.Gaussians, F.Camera, F.Options);
  const auto Alpha = F.doubles("f64_alpha");
  for (std::size_t I = 0; I < Alpha.size(); ++I)
    ASSERT_NEAR(1 - P.Transmittance[I], Alpha[I], 1e-9) << I;
}

TEST_P(GsplatFixture, Projection) {
  expectValues("f64_means2d", 2, 1e-12, [](const auto &S) { return S.Mean; });
  expectValues("f64_depths", 1, 1e-12,
               [](const auto &S) { return One{S.Depth}; });
  expectValues("f64_conics", 3, 1e-11, [](const auto &S) { return S.Conic; });
  expectValues("f64_view_colors", 3, 1e-6,
               [](const auto &S) { return S.Color; });
}

TEST_P(GsplatFixture, RadiiAndPairs) {
  // The fixtures' radii leave opacity out: 3.33 sigma, whole numbers of pixels,
  // none where the box misses the picture.
  const auto Radii = F.doubles("f64_radii");
  uint64_t Pairs = 0;
  std::size_t Different = 0;
  for (std::size_t I = 0; I < Splats.size(); ++I) {
    const auto &S = Splats[I];
    if (!S.Visible && !(Radii[2 * I] > 0))
      continue;
    auto O = F.Options;
    O.Reach = Support::Box3; // keeps what is too faint to be seen
    const auto B = reference::project(F.Gaussians, I, F.Camera, O);
    const double Rx = std::ceil(3.33 * std::sqrt(B.Covariance[0]));
    const double Ry = std::ceil(3.33 * std::sqrt(B.Covariance[2]));
    const bool Inside = B.Mean.x + Rx > 0 && B.Mean.x - Rx < F.Camera.Width &&
                        B.Mean.y + Ry > 0 && B.Mean.y - Ry < F.Camera.Height;
    Different += (Inside ? Rx : 0) != Radii[2 * I];
    Different += (Inside ? Ry : 0) != Radii[2 * I + 1];
    // Ours shrinks with opacity, and never exceeds that.
    EXPECT_LE(B.Radius.x, Rx);
    EXPECT_LE(B.Radius.y, Ry);
    if (!Inside)
      continue;
    const auto Tiles = [](double Mean, double R, int Pixels) {
      const double Count = std::ceil(Pixels / 16.);
      const double First = std::clamp(std::floor((Mean - R) / 16), 0., Count);
      const double End = std::clamp(std::ceil((Mean + R) / 16), 0., Count);
      return static_cast<uint64_t>(End - First);
    };
    Pairs += Tiles(B.Mean.x, Rx, F.Camera.Width) *
             Tiles(B.Mean.y, Ry, F.Camera.Height);
  }
  fmt::print("{:<29}radii: {} differ; {} pairs\n", F.Name, Different, Pairs);
  EXPECT_EQ(Different, 0U);
  EXPECT_EQ(double(Pairs), F.doubles("f64_n_isects")[0]);
}

TEST_P(InriaFixture, PicturesUnderEverySupport) {
  expectPicture("f64_render", Support::Square3);
  expectPicture("f64_render_exact", Support::Exact);
  expectPicture("f64_render_box3", Support::Box3);
  expectPicture("f64_render_official16", Support::Official16);
}

TEST_P(InriaFixture, OrderLastContributorAndTransmittance) {
  const auto P = reference::render(F.Gaussians, F.Camera, F.Options);
  const auto Order = F.doubles("f64_order"), Last = F.doubles("f64_last");
  const auto T = F.doubles("f64_T_final"), Radii = F.doubles("f64_radii");
  // They leave out what misses the picture.
  std::vector<double> Ours;
  for (const uint32_t I : reference::depthOrder(Splats))
    if (Radii[2 * I] > 0)
      Ours.push_back(I);
  ASSERT_EQ(Ours, Order);
  for (std::size_t I = 0; I < Last.size(); ++I) {
    const double Expected =
        Last[I] < 0 ? -1 : Order[static_cast<std::size_t>(Last[I])];
    ASSERT_EQ(double(P.Last[I]), Expected) << I;
    ASSERT_NEAR(P.Transmittance[I], T[I], Stored) << I;
  }
}

TEST_P(InriaFixture, Projection) {
  // Their pixels are at integers, ours at halves.
  expectValues("f64_means2d", 2, Stored,
               [](const auto &S) { return S.Mean - 0.5; });
  expectValues("f64_depths", 1, Stored,
               [](const auto &S) { return One{S.Depth}; });
  expectValues("f64_conics", 3, Stored, [](const auto &S) { return S.Conic; });
  expectValues("f64_radii", 2, 0, [](const auto &S) { return S.Radius; });
  expectValues("f64_compensations", 1, Stored,
               [](const auto &S) { return One{S.Compensation}; });
  expectValues("f64_view_colors", 3, 1e-6,
               [](const auto &S) { return S.Color; });
}

TEST_P(InriaFixture, PairsOfSquares) {
  // They count the 16x16 tiles that hold a pixel of the square; pixels are at
  // integers. (Ours meet a tile's area, which is half a pixel more.)
  const auto Tiles = [](double Mean, double R, int Pixels) {
    const double Count = std::ceil(Pixels / 16.);
    const double First =
        std::clamp(std::floor(std::ceil(Mean - R) / 16), 0., Count);
    const double End =
        std::clamp(std::floor(std::floor(Mean + R) / 16) + 1, 0., Count);
    return static_cast<uint64_t>(std::max(0., End - First));
  };
  uint64_t Pairs = 0;
  for (const auto &S : Splats)
    if (S.Visible)
      Pairs += Tiles(S.Mean.x - 0.5, S.Radius.x, F.Camera.Width) *
               Tiles(S.Mean.y - 0.5, S.Radius.y, F.Camera.Height);
  EXPECT_EQ(double(Pairs), F.doubles("f64_n_isects")[0]);
}

TEST_P(InriaFixture, DoubtfulThresholdsAreTheirs) {
  const auto P = reference::render(F.Gaussians, F.Camera, F.Options);
  const auto Threshold = F.doubles("mask_threshold");
  std::size_t Count = 0;
  for (std::size_t I = 0; I < P.Doubts.size(); ++I) {
    const bool Ours = (P.Doubts[I] & reference::DoubtThreshold) != 0;
    Count += Ours;
    EXPECT_EQ(Ours, Threshold[I] != 0) << I;
  }
  fmt::print("{:<29}{} doubtful thresholds\n", F.Name, Count);
}

std::string nameOf(const testing::TestParamInfo<const char *> &Info) {
  return Info.param;
}

INSTANTIATE_TEST_SUITE_P(All, GsplatFixture, testing::ValuesIn(Gsplat), nameOf);
INSTANTIATE_TEST_SUITE_P(All, InriaFixture, testing::ValuesIn(Inria), nameOf);

} // namespace
