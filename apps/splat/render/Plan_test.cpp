#include "effects/Registry.h"
#include "picture/View.h"
#include "render/Backward.h"
#include "render/Plan.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace vorion::splat {
namespace {

RenderPlan planFor(const Scene &S, const RenderOptions &O,
                   const std::string &Request = "auto") {
  const ViewFacts Facts = factsOf(S, makeView(Camera::ahead(64, 48, 50), O), O);
  return planRender(
      EffectPlan(*parseEffectRequest(Request), {S, O, Facts, false}), O);
}

/// Whether the program of kernel file \p Program has the macro \p Define.
bool has(const std::vector<ProgramSpec> &Programs, const char *Program,
         const char *Define) {
  const auto Found = std::ranges::find(Programs, Program, &ProgramSpec::File);
  return Found != Programs.end() &&
         std::ranges::count(Found->Defines, Define) == 1;
}

bool has(const RenderPlan &P, const char *Program, const char *Define) {
  return has(P.Programs, Program, Define);
}

bool hasProgram(const RenderPlan &P, const char *Program) {
  return std::ranges::count(P.Programs, Program, &ProgramSpec::File) == 1;
}

TEST(Plan, OnlyWhatIsNeededIsCompiled) {
  Scene S = Scene::sized(2, 1);
  S.Means = {0, 0, 2, 0, 0, 3};
  S.Sh.back() = 1;
  RenderOptions O;
  O.Blending = Path::Simt;
  O.Reach = Support::Box3;
  RenderPlan P = planFor(S, O);
  EXPECT_TRUE(has(P, "project.cl", "USE_SH1=1"));
  EXPECT_TRUE(has(P, "project.cl", "USE_SH2=0"));
  EXPECT_TRUE(has(P, "project.cl", "SUPPORT_BOX3"));
  EXPECT_TRUE(has(P, "project.cl", "TILE_SIZE=16"));
  EXPECT_TRUE(has(P, "project.cl", "USE_ANTIALIAS=0"));
  EXPECT_TRUE(has(P, "project.cl", "USE_NEAR_PLANE=0"));
  EXPECT_TRUE(has(P, "project.cl", "NEAR_LIMIT=0.2f"));
  EXPECT_TRUE(has(P, "project.cl", "NEAR_IS_LEFT_OUT"));
  EXPECT_TRUE(hasProgram(P, "blend.cl"));
  EXPECT_FALSE(has(P, "blend.cl", "STOP_AT_EQUAL"));
  EXPECT_FALSE(hasProgram(P, "resolve.cl"));

  O.Antialiased = true;
  O.Convention = Rules::Gsplat;
  O.Background[1] = 1;
  P = planFor(S, O);
  EXPECT_TRUE(has(P, "project.cl", "USE_ANTIALIAS=1"));
  EXPECT_TRUE(has(P, "project.cl", "NEAR_LIMIT=0.01f"));
  EXPECT_FALSE(has(P, "project.cl", "NEAR_IS_LEFT_OUT"));
  EXPECT_TRUE(has(P, "blend.cl", "STOP_AT_EQUAL"));
  EXPECT_TRUE(hasProgram(P, "resolve.cl"));

  O.Blending = Path::Raster;
  P = planFor(S, O);
  EXPECT_TRUE(has(P, "project.cl", "TILE_SIZE=64"));
  EXPECT_TRUE(hasProgram(P, "rasterize.cl"));
  EXPECT_TRUE(has(P, "rasterize.cl", "USE_ZTILES=0"));
  EXPECT_FALSE(hasProgram(P, "blend.cl"));
  EXPECT_FALSE(hasProgram(P, "merge.cl"));
}

TEST(Plan, TheLastFrameDealsOnlyWhereAskedFor) {
  const Scene S = Scene::sized(1, 0);
  RenderOptions O;
  RenderPlan P = planFor(S, O);
  EXPECT_FALSE(has(P, "rasterize.cl", "KEEP_COUNTS"));
  O.Deal = Dealing::LastFrame;
  P = planFor(S, O);
  EXPECT_TRUE(has(P, "rasterize.cl", "KEEP_COUNTS"));
}

TEST(Plan, TrainingHasTilesOfItsOwnAndKeepsLastContributors) {
  RenderOptions O;
  O.Training = true;
  const auto Raster = planRender(2, O).Programs;
  EXPECT_TRUE(has(Raster, "project.cl", "USE_SH2=1"));
  for (const char *Program : {"project.cl", "rasterize.cl"}) {
    EXPECT_TRUE(has(Raster, Program, "TILE_SIZE=32"));
    EXPECT_TRUE(has(Raster, Program, "TILE_HEIGHT=64"));
  }
  EXPECT_TRUE(has(Raster, "rasterize.cl", "KEEP_LAST"));
  O.Blending = Path::Simt;
  EXPECT_TRUE(has(planRender(2, O), "blend.cl", "TILE_SIZE=16"));
  const auto InriaBack = planBackward(2, O, {});
  O.Convention = Rules::Gsplat;
  const auto GsplatBack = planBackward(2, O, {});
  for (const auto &[Program, Word] :
       {std::pair("blend_backward.cl", "CLAMP_STOPS"),
        std::pair("project_backward.cl", "LIMIT_FOLLOWS_DEPTH")}) {
    EXPECT_FALSE(has(InriaBack, Program, Word));
    EXPECT_TRUE(has(GsplatBack, Program, Word));
  }
}

TEST(Plan, AProgramKnowsTheMacrosOfItsOwnFilesOnly) {
  const RenderPlan P = planFor(Scene::sized(1, 3), {});
  for (const ProgramSpec &Program : P.Programs)
    if (Program.File == "sort.cl" || Program.File == "scan.cl")
      EXPECT_TRUE(Program.Defines.empty()) << Program.File;
  EXPECT_FALSE(has(P, "tiles.cl", "USE_SH1=0"));
}

TEST(Plan, WhatIsNotNeutralIsBehindItsFlagUnlessAskedFor) {
  const Scene S = Scene::sized(1, 0);
  RenderOptions O;
  const RenderPlan All = planFor(S, O, "all");
  EXPECT_TRUE(has(All, "project.cl", "USE_SH3=1"));
  EXPECT_TRUE(has(All, "project.cl", "USE_NEAR_PLANE=1"));
  EXPECT_FALSE(has(All, "project.cl", "USE_ANTIALIAS=1"));
  EXPECT_TRUE(All.Effects.compiled(effects::Antialias));
  EXPECT_FALSE(All.Effects.done(effects::Antialias));
  O.Antialiased = true;
  EXPECT_TRUE(has(planFor(S, O, "all"), "project.cl", "USE_ANTIALIAS=1"));
}

TEST(Plan, FlagsGiveOneProgramForEveryScene) {
  Scene S = Scene::sized(1, 0);
  S.Means = {0, 0, 2};
  RenderOptions O;
  const RenderPlan Plain = planFor(S, O, "flags");
  S = Scene::sized(1, 3);
  S.Sh.back() = 1;
  S.Means = {5, 0, -2};
  O.Antialiased = true;
  O.Background = {1, 1, 1};
  const RenderPlan Full = planFor(S, O, "flags");
  ASSERT_EQ(Plain.Programs.size(), Full.Programs.size());
  for (std::size_t I = 0; I < Plain.Programs.size(); ++I)
    EXPECT_EQ(Plain.Programs[I].Defines, Full.Programs[I].Defines);
  EXPECT_NE(Plain.Effects.flags(), Full.Effects.flags());
  EXPECT_FALSE(Plain.Effects.done(effects::Sh3));
  EXPECT_TRUE(Full.Effects.done(effects::Sh3));
}

} // namespace
} // namespace vorion::splat
