#include "accuracy/Setting.h"

#include "mesh/Mesh.h"
#include "picture/Options.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

using namespace vorion;
using namespace vorion::splat;

namespace {

TEST(Setting, NamesAreReadBackInAnyOrder) {
  const auto S = Setting::parse("tile=32,exp=poly3");
  ASSERT_TRUE(S);
  EXPECT_EQ(S->name(), "exp=poly3,tile=32");
  EXPECT_EQ(S->value(KnobId::Tile), "32");
  EXPECT_EQ(S->value(KnobId::Blend), "fp32");
  EXPECT_EQ(*Setting::parse(S->name()), *S);
  EXPECT_EQ(Setting::parse("exp=exact")->name(), "default");
  EXPECT_EQ(Setting::parse("default")->size(), 0U);
}

TEST(Setting, WhatIsNoChoiceIsAnError) {
  for (const char *Name : {"exp=cubic", "exp", "speed=1", "tile=32,tile=16"}) {
    const auto S = Setting::parse(Name);
    ASSERT_FALSE(S) << Name;
    EXPECT_EQ(S.error().Code, ExitCode::Usage);
    EXPECT_NE(S.error().What.find("expected"), std::string::npos);
  }
}

TEST(Setting, TheCoresHaveSomeChoices) {
  using Words = std::vector<std::string>;
  const auto Arguments = [](const char *Name) {
    return Setting::parse(Name)->coresArguments();
  };
  EXPECT_EQ(Arguments("exp=poly3,cutoff=0.01"),
            (Words{"--path", "simt", "--exp", "poly3", "--cutoff", "0.01"}));
  EXPECT_EQ(Arguments("exp=table32"), std::nullopt);
  EXPECT_EQ(Arguments("blend=bf16"), std::nullopt);
  // A flag stands alone.
  EXPECT_EQ(Setting::parse("skip-saturated=on")->arguments(),
            (Words{"--path", "raster", "--skip-saturated"}));
}

TEST(Setting, OneAtATimeHasEachValueOnce) {
  const auto Knobs = knobsNamed({"tile", "blend"});
  ASSERT_TRUE(Knobs);
  std::vector<std::string> Names;
  for (const Setting &S : singleChanges(*Knobs))
    Names.push_back(S.name());
  EXPECT_EQ(Names,
            (std::vector<std::string>{"default", "blend=bf16", "blend=fp16",
                                      "tile=32", "tile=16"}));
  EXPECT_FALSE(knobsNamed({"til"}));
}

TEST(Setting, KnobsOfAMeshNeedOne) {
  const auto Has = [](const Mesh *Surface, KnobId Id) {
    const auto All = knobsNamed({}, Surface);
    return std::ranges::count(*All, Id, &Knob::Id) == 1;
  };
  EXPECT_FALSE(Has(nullptr, KnobId::SubpixelBits));
  const auto Named = knobsNamed({"mesh-depth"});
  ASSERT_FALSE(Named);
  EXPECT_EQ(Named.error().What, "--knobs mesh-depth: expected a mesh");
  Mesh Plain;
  EXPECT_TRUE(Has(&Plain, KnobId::SubpixelBits));
  EXPECT_TRUE(Has(&Plain, KnobId::ZTiles));
  EXPECT_FALSE(Has(&Plain, KnobId::FilterBits));
  const auto Parallel = knobsNamed({}, &Plain, true);
  EXPECT_EQ(std::ranges::count(*Parallel, KnobId::MeshDepth, &Knob::Id), 0);
  EXPECT_EQ(knobsNamed({"mesh-depth"}, &Plain, true).error().What,
            "--knobs mesh-depth: expected no orthographic camera");
  Mesh Glass;
  Glass.TextureCoordinates.resize(6);
  Glass.Materials.emplace_back().Alpha = AlphaMode::Blend;
  Glass.MaterialOf.push_back(0);
  EXPECT_TRUE(Has(&Glass, KnobId::FilterBits));
  EXPECT_FALSE(Has(&Glass, KnobId::ZTiles));
  // Both paths draw with them.
  EXPECT_EQ(
      Setting::parse("mesh-depth=unorm16")->coresArguments(),
      (std::vector<std::string>{"--path", "simt", "--mesh-depth", "unorm16"}));
}

TEST(Setting, AllExponentialUnitsAreTried) {
  const auto &Values = allKnobs().front().Values;
  EXPECT_EQ(Values.size(), ExpUnits.size());
  for (const ExpUnit E : ExpUnits)
    EXPECT_EQ(std::count(Values.begin(), Values.end(), name(E)), 1) << name(E);
}

} // namespace
