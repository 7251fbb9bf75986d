// That each effect is found where it is needed, and only there; that kernels
// and registry know the same macros.

#include "device/Kernels.h"
#include "effects/EffectPlan.h"
#include "effects/Registry.h"
#include "lens/Models.h"
#include "picture/View.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <set>

namespace vorion::splat {
namespace {

using Mode = EffectRequest::Mode;

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

class Effects : public testing::Test {
protected:
  Effects() {
    // In front of the camera, opacity 1/2.
    for (std::size_t I = 0; I < S.size(); ++I)
      S.Means[3 * I + 2] = 2;
  }

  EffectPlan plan(const std::string &Request = "auto") const {
    const auto R = parseEffectRequest(Request);
    EXPECT_TRUE(R);
    return {*R, {S, O, factsOf(S, makeView(C, O), O), false}};
  }
  bool needed(const Effect &E) const { return plan().of(E).Detected.Needed; }

  Scene S = Scene::sized(3, 3);
  RenderOptions O;
  Camera C = Camera::ahead(64, 48, 50);
};

TEST_F(Effects, ABareSceneNeedsNone) {
  const EffectPlan Plan = plan();
  for (const EffectDecision &D : Plan.decisions())
    if (D.Subject->Kind == EffectKind::Scene) {
      EXPECT_FALSE(D.Detected.Needed)
          << D.Subject->Name << ": " << D.Detected.Figure;
      EXPECT_EQ(D.Code, EffectCode::Absent) << D.Subject->Name;
      EXPECT_FALSE(D.Done) << D.Subject->Name;
    }
}

TEST_F(Effects, EachBandIsFoundByItself) {
  const Effect *Bands[] = {&effects::Sh1, &effects::Sh2, &effects::Sh3};
  for (std::size_t Band = 1; Band <= 3; ++Band) {
    // The last coefficient of the last Gaussian's band.
    std::ranges::fill(S.Sh, -0.0F);
    S.Sh[2 * 3 * S.coefficients() + 3 * (Band + 1) * (Band + 1) - 1] = 1e-40F;
    for (std::size_t Other = 1; Other <= 3; ++Other)
      EXPECT_EQ(needed(*Bands[Other - 1]), Other == Band) << Band << Other;
    EXPECT_TRUE(needed(effects::ViewColor));
  }
}

TEST_F(Effects, NaNIsNoZero) {
  S.Sh.back() = NaN;
  O.Background[2] = NaN;
  S.Means[0] = NaN;
  S.OpacityLogits[0] = NaN;
  O.Blending = Path::Simt;
  for (const Effect *E :
       {&effects::Sh3, &effects::Background, &effects::NearPlane,
        &effects::FieldOfView, &effects::Faint, &effects::AlphaClamp})
    EXPECT_TRUE(needed(*E)) << E->Name;
}

TEST_F(Effects, OneCoefficientInAMillionGaussiansIsFound) {
  S = Scene::sized(1000000, 3);
  EXPECT_FALSE(needed(effects::Sh3));
  S.Sh[S.Sh.size() - 5] = 1e-45F;
  EXPECT_TRUE(needed(effects::Sh3));
  EXPECT_FALSE(needed(effects::Sh2));
  EXPECT_EQ(plan().of(effects::Sh3).Detected.Figure,
            "Gaussian 999999 has a coefficient that is not 0");
}

// 0 times a direction that overflowed would be a NaN.
TEST_F(Effects, DirectionsThatMayOverflowNeedTheirBands) {
  S.Means[1] = 1e19F;
  EXPECT_TRUE(needed(effects::Sh1));
  EXPECT_TRUE(needed(effects::ViewColor));
  S.Means[1] = 0;
  C.Position[0] = -1e19;
  EXPECT_TRUE(needed(effects::Sh1));
}

TEST_F(Effects, ABackgroundIsAnyButZero) {
  O.Background = {0, -0.0F, 0};
  EXPECT_FALSE(needed(effects::Background));
  O.Background[2] = 1e-8F;
  EXPECT_TRUE(needed(effects::Background));
}

TEST_F(Effects, TheNearPlaneIsNeededUpToItsLimitAndABit) {
  for (const Rules R : {Rules::Inria, Rules::Gsplat}) {
    O.Convention = R;
    const float Limit = nearLimit(R);
    for (const float Z : {-1.0F, 0.0F, Limit, std::nextafter(Limit, 1.0F)}) {
      S.Means[5] = Z;
      EXPECT_TRUE(needed(effects::NearPlane)) << Z;
    }
    S.Means[5] = 1.001F * Limit;
    EXPECT_FALSE(needed(effects::NearPlane));
  }
}

TEST_F(Effects, TheFieldOfViewIsNeededUpToItsLimitAndABit) {
  // 1.3 times the half field of view, at depth 2.
  const float Limit = 1.3F * 32 / 50 * 2;
  for (const float Side : {-1.0F, 1.0F}) {
    S.Means[3] = Side * Limit;
    EXPECT_TRUE(needed(effects::FieldOfView));
    S.Means[3] = Side * 0.9999F * Limit;
    EXPECT_FALSE(needed(effects::FieldOfView));
    S.Means[3] = Side * 9;
    EXPECT_TRUE(needed(effects::FieldOfView));
    // What the near plane takes away does not count.
    S.Means[5] = -2;
    EXPECT_FALSE(needed(effects::FieldOfView));
    S.Means[5] = 2;
    S.Means[3] = 0;
  }
}

TEST_F(Effects, ACropIsAPrincipalPointOutsideThePicture) {
  for (const double At : {0.0, 64.0}) {
    C.Cx = At;
    EXPECT_FALSE(needed(effects::Crop)) << At;
  }
  for (const double At : {-0.5, 64.5}) {
    C.Cx = At;
    for (const std::string Mode : {"auto", "all", "flags", "sh1"})
      EXPECT_EQ(plan(Mode).of(effects::Crop).Code, EffectCode::Compiled) << At;
    for (const LensModel *M :
         {&lenses::OpenCv, &lenses::Fisheye, &lenses::Orthographic}) {
      O.Optics = M;
      EXPECT_TRUE(needed(effects::Crop));
    }
    O.Optics = &lenses::Equirectangular;
    EXPECT_FALSE(needed(effects::Crop));
    O.Optics = &lenses::Pinhole;
    O.Through = Spread::Unscented;
    EXPECT_FALSE(needed(effects::Crop));
    O.Through = Spread::Jacobian;
  }
}

TEST_F(Effects, ALongLensMeasuresFromTheRay) {
  C.Fx = 8192;
  EXPECT_FALSE(needed(effects::Crop));
  C.Fy = 8193;
  EXPECT_TRUE(needed(effects::Crop));
  O.Optics = &lenses::Fisheye;
  EXPECT_TRUE(needed(effects::Crop));
  // Of parallel rays it is the distance in pixels: that of 2 units, then more.
  O.Optics = &lenses::Orthographic;
  C.Fx = C.Fy = 4096;
  EXPECT_FALSE(needed(effects::Crop));
  S.Means[0] = 2.01F;
  EXPECT_TRUE(needed(effects::Crop));
  O.Optics = &lenses::Pinhole;
  EXPECT_FALSE(needed(effects::Crop));
}

TEST_F(Effects, AWidePictureHasWindows) {
  C.Width = 4096;
  EXPECT_FALSE(needed(effects::Windows));
  for (int *Side : {&C.Width, &C.Height}) {
    C = Camera::ahead(64, 48, 50);
    *Side = 4097;
    EXPECT_EQ(plan("flags").of(effects::Windows).Code, EffectCode::Compiled);
    O.Optics = &lenses::Equirectangular;
    EXPECT_TRUE(needed(effects::Windows));
    O.Optics = &lenses::Pinhole;
    O.Through = Spread::Unscented;
    EXPECT_FALSE(needed(effects::Windows));
    O.Through = Spread::Jacobian;
  }
}

// Of 10,000 px: one that points at the camera, and others.
TEST_F(Effects, ANeedleCountsWhereItPointsAtTheCamera) {
  const auto Log = [](double V) { return static_cast<float>(std::log(V)); };
  for (std::size_t I = 0; I < S.size(); ++I) {
    S.Quats[4 * I] = 1;
    for (int K = 0; K < 3; ++K)
      S.LogScales[3 * I + static_cast<std::size_t>(K)] = Log(0.01);
  }
  EXPECT_FALSE(needed(effects::Needles));
  S.LogScales[5] = Log(400); // along z, in the middle of the picture
  EXPECT_TRUE(needed(effects::Needles));
  EXPECT_EQ(plan().of(effects::Needles).Detected.Figure,
            "1 of 3 Gaussians are needles that point at the camera");
  // Activation would round its quaternion.
  const auto R = parseEffectRequest("auto");
  EffectInputs Several{S, O, factsOf(S, makeView(C, O), O), false};
  Several.Views = 2;
  EXPECT_FALSE(EffectPlan(*R, Several).done(effects::ActivatedScene));
  // Behind the camera, and beside the picture.
  S.Means[5] = -2;
  EXPECT_FALSE(needed(effects::Needles));
  S.Means[5] = 2;
  S.Means[3] = 9;
  EXPECT_FALSE(needed(effects::Needles));
  S.Means[3] = 0;
  // Across the picture a record has more to lose; and a large ball is no
  // needle.
  std::swap(S.LogScales[3], S.LogScales[5]);
  EXPECT_FALSE(needed(effects::Needles));
  S.LogScales[4] = S.LogScales[5] = S.LogScales[3];
  EXPECT_FALSE(needed(effects::Needles));
}

// By pinholes in the picture alone, and where a lens has no slopes by all that
// is in front.
TEST_F(Effects, TheNearPlanesShareIsOfWhatTheViewShows) {
  S.Means = {0, 0, 0.1F, 0, 0, 2, 9, 0, 0.1F};
  const auto Facts = [&] { return factsOf(S, makeView(C, O), O); };
  EXPECT_EQ(Facts().InView, 2U);
  EXPECT_EQ(Facts().BeforeNear, 1U);
  S.Means[2] = -0.1F; // behind
  EXPECT_EQ(Facts().InView, 1U);
  EXPECT_EQ(Facts().BeforeNear, 0U);
  const ViewFacts None = Facts();
  S.Means[5] = 0.2F;
  EXPECT_EQ(Facts().BeforeNear, 1U);
  EXPECT_EQ(combined(None, Facts()).BeforeNear, 1U);
  EXPECT_EQ(combined(Facts(), None).BeforeNear, 1U);
  O.Optics = &lenses::Fisheye;
  EXPECT_EQ(Facts().InView, 3U);
  EXPECT_EQ(Facts().BeforeNear, 2U);
}

TEST_F(Effects, OfTwoViewsEitherCallsForAnEffect) {
  const auto Facts = [&] { return factsOf(S, makeView(C, O), O); };
  const auto NeedsNearPlane = [&](const ViewFacts &F) {
    return effects::NearPlane.Detect({S, O, F, false}).Needed;
  };
  const ViewFacts Before = Facts();
  C.Position[2] = 10;
  const ViewFacts Beyond = Facts();
  EXPECT_FALSE(NeedsNearPlane(combined(Before, Before)));
  EXPECT_TRUE(NeedsNearPlane(combined(Before, Beyond)));
  EXPECT_TRUE(NeedsNearPlane(combined(Beyond, Before)));
}

TEST_F(Effects, OpacitiesDecideFaintAndClamp) {
  O.Blending = Path::Simt;
  S.OpacityLogits[1] = 4.5951F; // 0.98999983
  EXPECT_FALSE(needed(effects::AlphaClamp));
  S.OpacityLogits[1] = 4.59512F; // 0.99
  EXPECT_TRUE(needed(effects::AlphaClamp));
  S.OpacityLogits[1] = 0;
  EXPECT_FALSE(needed(effects::AlphaClamp));
  O.Exponential = ExpUnit::Poly2; // may exceed 1
  EXPECT_TRUE(needed(effects::AlphaClamp));
  O.Blending = Path::Raster;
  EXPECT_FALSE(needed(effects::AlphaClamp));

  S.OpacityLogits[1] = -5.5373F;
  EXPECT_FALSE(needed(effects::Faint));
  S.OpacityLogits[1] = -5.53734F;
  EXPECT_TRUE(needed(effects::Faint));
  O.AlphaCutoff = 8;
  S.OpacityLogits[1] = -3.42F;
  EXPECT_FALSE(needed(effects::Faint));
  S.OpacityLogits[1] = -3.44F;
  EXPECT_TRUE(needed(effects::Faint));
  O.Reach = Support::Box3;
  EXPECT_FALSE(needed(effects::Faint));
  S.OpacityLogits[1] = 0;
  O.Reach = Support::Exact;
  O.Antialiased = true;
  EXPECT_TRUE(needed(effects::Faint));
}

TEST_F(Effects, OptionsDecideTheRest) {
  EXPECT_TRUE(needed(effects::IntersectTags));
  EXPECT_FALSE(needed(effects::ZTiles));
  O.ZTiles = 2;
  O.PixelUnit.Count = 1;
  O.SkipSaturated = true;
  O.Antialiased = true;
  for (const Effect *E : {&effects::ZTiles, &effects::PixelUnit,
                          &effects::SkipSaturated, &effects::Antialias})
    EXPECT_TRUE(needed(*E)) << E->Name;
  O.Blending = Path::Simt;
  EXPECT_FALSE(needed(effects::IntersectTags));
}

TEST_F(Effects, AListSaysWhichOfThoseDecidedByData) {
  S.Sh.back() = 1;
  O.Background[0] = 1;
  const EffectPlan P = plan("sh1,near-plane");
  EXPECT_TRUE(P.done(effects::Sh1));
  EXPECT_TRUE(P.done(effects::ViewColor)); // its code encloses sh1's
  EXPECT_TRUE(P.done(effects::NearPlane));
  EXPECT_FALSE(P.compiled(effects::Sh3));
  EXPECT_TRUE(P.done(effects::IntersectTags)); // not the list's affair
  EXPECT_EQ(P.missing(),
            (std::vector<const Effect *>{&effects::Sh3, &effects::Background}));
  EXPECT_TRUE(plan("all").missing().empty());
}

// What an option rules out is not even done unneeded: it would draw another
// picture.
TEST_F(Effects, ABandBeyondTheLimitIsNeverDone) {
  S.Sh.back() = 1;
  O.ShLimit = 2;
  for (const char *Request : {"auto", "all", "flags", "sh3"})
    EXPECT_FALSE(plan(Request).done(effects::Sh3)) << Request;
  EXPECT_FALSE(plan("all").compiled(effects::Sh3));
  EXPECT_TRUE(plan("all").done(effects::Sh2));
  EXPECT_FALSE(needed(effects::ViewColor));
}

TEST_F(Effects, UnknownNamesAreErrors) {
  const auto Message = [](const std::string &Text) {
    const auto R = parseEffectRequest(Text);
    return R ? std::string() : R.error().What;
  };
  EXPECT_EQ(Message("all"), "");
  EXPECT_EQ(Message("sh1,background"), "");
  EXPECT_NE(Message("sh1,lens")
                .find("no effect is called \"lens\", expected "
                      "auto, all, flags, sh1, sh2"),
            std::string::npos);
  EXPECT_NE(Message("").find("no effect is called \"\""), std::string::npos);
  EXPECT_NE(Message("antialias").find("decided by its own option"),
            std::string::npos);
  EXPECT_NE(Message("clock").find("decided by its own option"),
            std::string::npos);
}

/// What the kernels of \p P are compiled with for each effect that has code.
std::map<std::string_view, std::string> choices(const EffectPlan &P) {
  std::map<std::string_view, std::string> Made;
  for (const Effect *E : effects::all())
    if (!E->Macro.empty())
      if (const auto Choice = P.choiceOf(E->Macro))
        Made.emplace(E->Macro, Choice->text());
  return Made;
}

TEST_F(Effects, FlagsHaveABitEach) {
  const auto Choices = choices(plan("flags"));
  std::set<std::string> Tests;
  for (const auto &[Macro, Text] : Choices) {
    EXPECT_TRUE(Text.starts_with("(effects&")) << Macro;
    Tests.insert(Text);
  }
  EXPECT_EQ(Tests.size(), Choices.size());
}

// In no mode behind a flag, and no pinhole's program says their macros.
TEST_F(Effects, TheCameraDecidesItsLensInEveryMode) {
  const auto Flags = choices(plan("flags"));
  for (const std::string Mode : {"auto", "all", "flags", "sh1"}) {
    O.Optics = &lenses::Fisheye;
    const EffectPlan P = plan(Mode);
    const Effect &Fisheye = *effects::lensOf(lenses::Fisheye);
    EXPECT_EQ(P.of(Fisheye).Code, EffectCode::Compiled) << Mode;
    EXPECT_EQ(P.of(*effects::lensOf(lenses::OpenCv)).Code, EffectCode::Absent)
        << Mode;
    auto Choices = choices(P);
    EXPECT_EQ(Choices[Fisheye.Macro], "1") << Mode;
    Choices.erase(Fisheye.Macro);
    if (Mode == "flags")
      EXPECT_EQ(Choices, Flags);
    O.Optics = &lenses::Pinhole;
    EXPECT_FALSE(plan(Mode).choiceOf(Fisheye.Macro)) << Mode;
  }
  EXPECT_EQ(effects::lensOf(lenses::Pinhole), nullptr);
  EXPECT_EQ(effects::lensOf(lenses::Equirectangular),
            effects::find("equirectangular"));
}

TEST_F(Effects, DepthIsADistanceWhereTheLensSeesBehind) {
  S.Means[2] = -2; // behind the camera
  EXPECT_TRUE(needed(effects::NearPlane));
  O.Optics = &lenses::Fisheye;
  const ViewFacts F = factsOf(S, makeView(C, O), O);
  EXPECT_EQ(F.NearestDepth, 2);
}

TEST(Registry, KernelsDeclareTheChoicesOfEffects) {
  constexpr std::string_view Declaration = "#pragma vorion choice effect ";
  std::set<std::string_view> Declared, Known;
  for (const std::string_view File : kernelFiles()) {
    const std::string_view Text = kernelSource(File);
    for (std::size_t At = Text.find(Declaration); At != Text.npos;
         At = Text.find(Declaration, At)) {
      At += Declaration.size();
      Declared.insert(Text.substr(At, Text.find('\n', At) - At));
    }
  }
  for (const Effect *E : effects::all())
    if (!E->Macro.empty())
      EXPECT_TRUE(Known.insert(E->Macro).second) << E->Macro;
  EXPECT_EQ(Declared, Known);
}

TEST(Registry, NamesAreUniqueAndEveryKindIsThere) {
  std::set<std::string_view> Names;
  std::set<EffectKind> Kinds;
  const Effect *Last = nullptr;
  for (const Effect *E : effects::all()) {
    EXPECT_TRUE(Names.insert(E->Name).second) << E->Name;
    EXPECT_EQ(effects::find(E->Name), E);
    EXPECT_FALSE(E->What.empty()) << E->Name;
    EXPECT_NE(E->Detect == nullptr, E->Lens == nullptr) << E->Name;
    // Kinds stand together, and what encloses comes after what it encloses.
    EXPECT_TRUE(!Last || Last->Kind <= E->Kind) << E->Name;
    EXPECT_FALSE(E->Within && Names.contains(E->Within->Name)) << E->Name;
    Kinds.insert(E->Kind);
    Last = E;
  }
  EXPECT_EQ(Kinds.size(), 3U);
  EXPECT_EQ(effects::find("lens"), nullptr);
}

} // namespace
} // namespace vorion::splat
