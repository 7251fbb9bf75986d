#include "Backward.h"
#include "Plan.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace vorion::splat {
namespace {

Scene twoGaussians(int Degree) {
  Scene S;
  S.ShDegree = Degree;
  S.OpacityLogits = {0, 0};
  S.Sh.assign(2 * 3 * S.coefficients(), 0);
  return S;
}

TEST(Plan, BandsOfZerosAreNotUsed) {
  Scene S = twoGaussians(3);
  EXPECT_EQ(usedShDegree(S), 0);
  S.Sh[3 * S.coefficients() + 3 * 8 + 2] = 0.5F; // band 2 of the second
  EXPECT_EQ(usedShDegree(S), 2);
  S.Sh.back() = -1e-30F;
  EXPECT_EQ(usedShDegree(S), 3);
}

TEST(Plan, OnlyWhatIsNeededIsCompiled) {
  Scene S = twoGaussians(1);
  S.Sh.back() = 1;
  RenderOptions O;
  O.Blending = Path::Simt;
  O.Reach = Support::Box3;
  const auto Has = [](const RenderPlan &P, const char *Program,
                      const char *Word) {
    const auto Found =
        std::ranges::find(P.Programs, Program, &ProgramSpec::Name);
    return std::ranges::count(Found->Files, Word) +
               std::ranges::count(Found->Defines, Word) ==
           1;
  };
  RenderPlan P = planRender(S, O);
  EXPECT_TRUE(Has(P, ProjectProgram, "SH_DEGREE=1"));
  EXPECT_TRUE(Has(P, ProjectProgram, "SUPPORT_BOX3"));
  EXPECT_TRUE(Has(P, ProjectProgram, "TILE_SIZE=16"));
  EXPECT_FALSE(Has(P, ProjectProgram, "ANTIALIASED"));
  EXPECT_TRUE(Has(P, BlendProgram, "blend.cl"));
  EXPECT_FALSE(Has(P, BlendProgram, "STOP_AT_EQUAL"));

  O.Antialiased = true;
  O.Convention = Rules::Gsplat;
  P = planRender(S, O);
  EXPECT_TRUE(Has(P, ProjectProgram, "ANTIALIASED"));
  EXPECT_TRUE(Has(P, BlendProgram, "STOP_AT_EQUAL"));

  O.Blending = Path::Raster;
  P = planRender(S, O);
  EXPECT_TRUE(Has(P, ProjectProgram, "TILE_SIZE=64"));
  EXPECT_TRUE(Has(P, BlendProgram, "rasterize.cl"));
  EXPECT_FALSE(Has(P, BlendProgram, "blend.cl"));
}

TEST(Plan, TrainingHasTilesOfItsOwnAndKeepsLastContributors) {
  const auto Defines = [](const std::vector<ProgramSpec> &Programs,
                          std::string_view Program, const char *Word) {
    const auto Found = std::ranges::find(Programs, Program, &ProgramSpec::Name);
    return std::ranges::count(Found->Defines, Word) == 1;
  };
  RenderOptions O;
  O.Training = true;
  const auto Raster = planRender(2, O).Programs;
  EXPECT_TRUE(Defines(Raster, ProjectProgram, "SH_DEGREE=2"));
  for (const char *Program : {ProjectProgram, BlendProgram}) {
    EXPECT_TRUE(Defines(Raster, Program, "TILE_SIZE=32"));
    EXPECT_TRUE(Defines(Raster, Program, "TILE_HEIGHT=64"));
  }
  EXPECT_TRUE(Defines(Raster, BlendProgram, "KEEP_LAST"));
  O.Blending = Path::Simt;
  EXPECT_TRUE(Defines(planRender(2, O).Programs, BlendProgram, "TILE_SIZE=16"));
  const auto InriaBack = planBackward(2, O, {});
  O.Convention = Rules::Gsplat;
  const auto GsplatBack = planBackward(2, O, {});
  for (const auto &[Program, Word] :
       {std::pair("blend backward", "CLAMP_STOPS"),
        std::pair("project backward", "LIMIT_FOLLOWS_DEPTH")}) {
    EXPECT_FALSE(Defines(InriaBack, Program, Word));
    EXPECT_TRUE(Defines(GsplatBack, Program, Word));
  }
}

TEST(Plan, ExplanationNamesTheReason) {
  Scene S = twoGaussians(2);
  S.Sh[3 * 1] = 1; // band 1 of the first
  const auto Lines = explain(planRender(S, {}), S, {});
  const auto Says = [&](const char *Line) {
    return std::ranges::count(Lines, Line) == 1;
  };
  EXPECT_TRUE(Says("SH band 1: compiled in"));
  EXPECT_TRUE(
      Says("SH band 2: left out, all its coefficients in the scene are zero"));
  EXPECT_TRUE(Says("SH band 3: left out, the scene has degree 2"));
}

} // namespace
} // namespace vorion::splat
