// The reference's gradients in fp64 against every fixture's: parameters, what
// lies between, and the sums that the rasterizer hands over.

#include "Gradients.h"
#include "io/Metrics.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::test;

namespace {

const std::filesystem::path Folder = VORION_FIXTURES;

/// Bounds on the relative difference in the L2 norm: fixtures keep doubles,
/// doubles of 32 bits, or (the large ones) floats.
double tolerance(const splat::NpyArray &A) {
  return A.Type == "f4" ? 1e-7 : 1e-9;
}

std::vector<std::string> names() {
  std::vector<std::string> Names;
  if (std::filesystem::is_directory(Folder))
    for (const auto &Entry : std::filesystem::directory_iterator(Folder)) {
      const std::string Name = Entry.path().stem();
      if (Entry.path().extension() == ".npz" && !Name.ends_with("_more"))
        Names.push_back(Name);
    }
  std::sort(Names.begin(), Names.end());
  // A name that no file has makes the skip seen.
  return Names.empty() ? std::vector<std::string>{"none"} : Names;
}

class GradientFixture : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    const auto Path = Folder / (GetParam() + ".npz");
    if (!std::filesystem::exists(Path))
      GTEST_SKIP() << "no ../shared/data/reference";
    auto Read = readFixture(Path);
    ASSERT_TRUE(Read) << Read.error().Where << ": " << Read.error().What;
    F = std::move(*Read);
    const auto More = Folder / (GetParam() + "_more.npz");
    if (std::filesystem::exists(More)) {
      auto Arrays = splat::readNpz(More);
      ASSERT_TRUE(Arrays) << Arrays.error().What;
      F.Arrays.merge(*Arrays);
    }
  }

  /// Compares \p Actual with \p Array, where there is one, against the larger
  /// of its norm and \p Scale.
  void expect(const std::string &Array, const std::vector<double> &Actual,
              double Scale = 0) {
    if (!F.has(Array))
      return;
    const auto Expected = F.doubles(Array);
    ASSERT_EQ(Actual.size(), Expected.size()) << Array;
    // gsplat multiplies 0 by the infinity of a culled Gaussian at z = 0.
    for (std::size_t I = 0; I < Actual.size(); ++I)
      if (std::isnan(Expected[I]))
        EXPECT_EQ(Actual[I], 0) << Array << " at " << I;
    const double Error = splat::relativeL2(Actual, Expected, Scale);
    fmt::print("{:<29}{:<18}{:.1e}\n", F.Name, Array, Error);
    EXPECT_LE(Error, tolerance(F.Arrays.at(Array))) << Array;
    ++Compared;
  }

  Fixture F;
  int Compared = 0;
};

/// \p Count numbers of each element of \p V, as \p Get gives them.
template <typename T, typename Function>
std::vector<double> flat(const std::vector<T> &V, int Count, Function Get) {
  std::vector<double> Out;
  Out.reserve(V.size() * static_cast<std::size_t>(Count));
  for (const T &E : V)
    for (int K = 0; K < Count; ++K)
      Out.push_back(Get(E)[K]);
  return Out;
}

TEST_P(GradientFixture, AllOfThem) {
  const auto D = reference::renderBackward(F.Gaussians, F.Camera, upstreamOf(F),
                                           F.Options);
  const auto Same = [](const auto &V) { return V; };
  expect("f64_g_means2d", flat(D.Means2d, 2, Same));
  expect("f64_g_conics", flat(D.Conics, 3, Same));
  expect("f64_g_means", flat(D.Means, 3, Same));
  expect("f64_g_scales", flat(D.Scales, 3, Same));
  expect("f64_g_opacities", D.Opacities);
  expect("f64_g_colors",
         flat(F.Gaussians.Colors.empty() ? D.Sh : D.Colors, 3, Same));

  auto Quats = flat(D.Quats, 4, Same);
  const auto Stored = F.doubles("in_quats");
  std::vector<double> LogScales;
  for (std::size_t I = 0; I < D.Quats.size(); ++I) {
    const glm::dvec4 Q(Stored[4 * I], Stored[4 * I + 1], Stored[4 * I + 2],
                       Stored[4 * I + 3]);
    for (std::size_t K = 0; K < 4; ++K)
      Quats[4 * I + K] /= std::max(glm::length(Q), 1e-12);
    for (int K = 0; K < 3; ++K)
      LogScales.push_back(D.Scales[I][K] * F.Gaussians.Scales[I][K]);
  }
  // Those of round Gaussians vanish: judged against a thousandth of the
  // scales'.
  expect("f64_g_quats", Quats, 1e-3 * norm(LogScales));

  const auto Sum = [&](const char *Array, auto Get) {
    std::vector<double> Values;
    for (const auto &S : D.Sums)
      Values.push_back(Get(S));
    expect(Array, Values);
  };
  Sum("f64_h_s", [](const auto &S) { return S.S; });
  Sum("f64_h_sdx", [](const auto &S) { return S.Sd.x; });
  Sum("f64_h_sdy", [](const auto &S) { return S.Sd.y; });
  Sum("f64_h_sdxx", [](const auto &S) { return S.Sdd[0]; });
  Sum("f64_h_sdxy", [](const auto &S) { return S.Sdd[1]; });
  Sum("f64_h_sdyy", [](const auto &S) { return S.Sdd[2]; });
  expect("f64_h_dc", flat(D.Sums, 3, [](const auto &S) { return S.Color; }));
  EXPECT_GE(Compared, 6);
}

INSTANTIATE_TEST_SUITE_P(All, GradientFixture, testing::ValuesIn(names()),
                         [](const auto &Info) { return Info.param; });

} // namespace
