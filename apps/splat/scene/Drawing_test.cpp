// What files say of how a scene is to be drawn, and what becomes of it.
#include "io/TestFiles.h"
#include "scene/Activation.h"
#include "scene/Drawing.h"
#include "scene/SceneFile.h"
#include "scene/formats/Ply.h"
#include "scene/testing/SceneWriters.h"

#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

using Json = nlohmann::json;

Expected<Drawing> of(const std::vector<std::string> &Comments) {
  return drawingOfComments("file", Comments);
}

TEST(Drawing, CommentsOfEachProgramAreKnown) {
  const struct {
    std::vector<std::string> Comments;
    bool Antialiased;
    const char *Source;
  } Cases[] = {
      {{}, false, ""},
      {{" Exported from Brush", " SH degree: 3"}, false, ""},
      {{" SplatRenderMode: mip"}, true, "comment SplatRenderMode: mip"},
      {{" SplatRenderMode: default"},
       false,
       "comment SplatRenderMode: default"},
      {{"   SPLATRENDERMODE:   MIP\t"}, true, "comment SPLATRENDERMODE:   MIP"},
      {{" antialiased 1"}, true, "comment antialiased 1"},
      {{" antialiased 0"}, false, "comment antialiased 0"},
      {{" antialiased photographs"}, false, ""},
      // The last one counts.
      {{" antialiased 1", " SplatRenderMode: default"},
       false,
       "comment SplatRenderMode: default"},
      {{" SplatRenderMode: default", " antialiased 1"},
       true,
       "comment antialiased 1"}};
  for (const auto &Case : Cases) {
    const auto D = of(Case.Comments);
    ASSERT_TRUE(D) << D.error().What;
    EXPECT_EQ(D->Antialiased, Case.Antialiased) << Case.Source;
    EXPECT_EQ(D->Source, Case.Source);
    EXPECT_FALSE(D->Dilation);
  }
}

TEST(Drawing, FlatGaussiansAreSurfels) {
  for (const char *Comment :
       {" SplatRenderMode: 2dgs", " splatrendermode:2DGS"}) {
    const auto D = of({Comment});
    ASSERT_TRUE(D);
    EXPECT_EQ(D->Renderer, RendererKind::Surfel);
  }
}

TEST(Drawing, WhatIsNotSupportedIsRefusedByName) {
  const auto Other = of({" SplatRenderMode: banana\x1b[31m"});
  ASSERT_FALSE(Other);
  EXPECT_EQ(Other.error().What,
            "comment SplatRenderMode: banana\\x1b[31m selects an unknown "
            "rendering mode, expected SplatRenderMode: default, mip or 2dgs");
  EXPECT_FALSE(of({" Dilation: much"}));
  EXPECT_FALSE(of({" Dilation: -1"}));
}

TEST(Drawing, TheRendererIsKeptAndOthersAreRefused) {
  const auto Ray = of({" SplatRenderer: ray"});
  ASSERT_TRUE(Ray);
  EXPECT_EQ(Ray->Renderer, RendererKind::Ray);
  EXPECT_EQ(drawingComments(*Ray), "comment SplatRenderer: ray\n");
  EXPECT_FALSE(Ray->drawsAs(*of({" SplatRenderer: splat"})));
  EXPECT_TRUE(of({})->drawsAs(*of({" splatrenderer: SPLAT"})));
  EXPECT_EQ(withRequest(*Ray, {{}, {}, RendererKind::Splat}).Renderer,
            RendererKind::Splat);
  EXPECT_EQ(withRequest({}, {{}, {}, RendererKind::Surfel}).Renderer,
            RendererKind::Surfel);
  EXPECT_EQ(drawingComments(*of({" SplatRenderer: surfel"})),
            "comment SplatRenderer: surfel\n");
  EXPECT_FALSE(of({" SplatRenderer: traced"}));
  const auto Four = of({" SplatRenderer: ray", " SplatFalloffDegree: 4"});
  ASSERT_TRUE(Four);
  EXPECT_EQ(Four->FalloffDegree, 4U);
  EXPECT_EQ(drawingComments(*Four),
            "comment SplatRenderer: ray\ncomment SplatFalloffDegree: 4\n");
  EXPECT_FALSE(Four->drawsAs(*Ray));
  EXPECT_EQ(withRequest(*Four, {{}, {}, {}, 2}).FalloffDegree, 2U);
  EXPECT_FALSE(of({" SplatFalloffDegree: 3"}));
}

TEST(Drawing, ADilationThatNoFloatHoldsIsRefused) {
  for (const char *Comment :
       {" Dilation: 1e39", " Dilation: 3.41e38", " Dilation: inf",
        " Dilation: nan", " Dilation: 1e999"}) {
    const auto D = of({Comment});
    ASSERT_FALSE(D) << Comment;
    EXPECT_NE(D.error().What.find("expected a variance of 0 to 3.4e38 px^2"),
              std::string::npos)
        << D.error().What;
  }
  EXPECT_TRUE(of({" Dilation: 3.4e38"}));
}

TEST(Drawing, BrushsFilesAreDilatedAsBrushDoes) {
  const auto Mip = of({" Exported from Brush", " SplatRenderMode: mip"});
  ASSERT_TRUE(Mip);
  EXPECT_EQ(Mip->Dilation, 0.1);
  const auto Classic =
      of({" Exported from Brush", " SplatRenderMode: default"});
  ASSERT_TRUE(Classic);
  EXPECT_FALSE(Classic->Dilation);
}

TEST(Drawing, TheUserDecidesAgainstTheFile) {
  const Drawing Mip{true, 0.1, "comment SplatRenderMode: mip"};
  const Drawing Classic = withRequest(Mip, {false, {}});
  EXPECT_FALSE(Classic.Antialiased);
  EXPECT_FALSE(Classic.Dilation);
  EXPECT_EQ(Classic.Source,
            "--no-antialiased, against comment SplatRenderMode: mip");
  const Drawing Same = withRequest(Mip, {true, 0.2});
  EXPECT_TRUE(Same.Antialiased);
  EXPECT_EQ(Same.Dilation, 0.2);
  EXPECT_EQ(Same.Source, "--antialiased");
  EXPECT_EQ(withRequest({}, {true, {}}).Source, "--antialiased");
  EXPECT_EQ(withRequest(Mip, {}).Source, Mip.Source);
}

TEST(Drawing, APlySaysWhatItsSceneWas) {
  const TestFolder Root;
  const Scene S = numberedScene(4, 1);
  for (const Drawing &D :
       {Drawing{}, Drawing{true, {}, "x"}, Drawing{true, 0.1, "x"}}) {
    ASSERT_TRUE(writePly(Root.path("s.ply"), S, D));
    const auto Read = readScene(Root.path("s.ply"));
    ASSERT_TRUE(Read) << Read.error().What;
    EXPECT_TRUE(Read->DrawnAs.drawsAs(D));
    EXPECT_EQ(Read->Gaussians.Sh, S.Sh);
  }
}

/// \p Text with \p Line after its first line.
std::string withLine(std::string Text, const std::string &Line) {
  return Text.insert(Text.find('\n') + 1, Line + "\n");
}

TEST(Drawing, EveryFormatThatCanSayItIsHeard) {
  const TestFolder Root;
  const Scene S = randomScene(5, 1, 1);
  const std::string Compressed = Root.write(
      "c.ply", withLine(compressedPlyOf(S), "comment SplatRenderMode: mip"));
  const auto Read = readScene(Compressed);
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_TRUE(Read->DrawnAs.Antialiased);

  const auto Sog = [&](const Json &Extra) {
    Folder Files = sogOf(S);
    Json Meta = Json::parse(Files["meta.json"]);
    Meta.update(Extra);
    Files["meta.json"] = Meta.dump();
    return readScene(Root.write("s.sog", zipOf(Files)));
  };
  const auto Named = Sog({{"model", "antialiased"}});
  ASSERT_TRUE(Named) << Named.error().What;
  EXPECT_TRUE(Named->DrawnAs.Antialiased);
  EXPECT_EQ(Named->DrawnAs.Source, "model antialiased");
  const auto Flat = Sog({{"model", "2dgs"}});
  ASSERT_TRUE(Flat) << Flat.error().What;
  EXPECT_EQ(Flat->DrawnAs.Renderer, RendererKind::Surfel);
  const auto Default = Sog({{"model", "default"}, {"antialias", nullptr}});
  ASSERT_TRUE(Default);
  EXPECT_FALSE(Default->DrawnAs.Antialiased);
  const std::pair<Json, const char *> Refused[] = {
      {{{"model", "5dgs"}}, "unknown rendering mode"},
      {{{"model", 2}}, "model is not a string"},
      {{{"antialias", "yes"}}, "antialias is not a Boolean"},
      {{{"model", "default"}, {"antialias", true}}, "are contradictory"}};
  for (const auto &[Extra, Message] : Refused) {
    const auto Bad = Sog(Extra);
    ASSERT_FALSE(Bad) << Message;
    EXPECT_NE(Bad.error().What.find(Message), std::string::npos)
        << Bad.error().What;
  }
}

TEST(Drawing, APlyOfTwoScalesIsOfSurfels) {
  const TestFolder Root;
  Scene S = numberedScene(2, 0);
  S.LogScales[2] = S.LogScales[5] = FlatLogScale;
  const std::string Flat = formatPly(S, {false, {}, "", RendererKind::Surfel});
  EXPECT_EQ(Flat.find("scale_2"), std::string::npos);
  const auto Read = readScene(Root.write("s.ply", Flat));
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->DrawnAs.Renderer, RendererKind::Surfel);
  EXPECT_EQ(Read->Gaussians.LogScales, S.LogScales);
  EXPECT_EQ(Read->Gaussians.Quats, S.Quats);
  // One that is flat along another axis needs all three.
  std::swap(S.LogScales[1], S.LogScales[2]);
  const auto Other = readScene(
      Root.write("t.ply", formatPly(S, {false, {}, "", RendererKind::Surfel})));
  ASSERT_TRUE(Other) << Other.error().What;
  EXPECT_EQ(Other->DrawnAs.Renderer, RendererKind::Surfel);
  EXPECT_EQ(Other->Gaussians.LogScales, S.LogScales);
}

} // namespace
