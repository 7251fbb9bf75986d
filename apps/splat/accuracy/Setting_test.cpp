#include "accuracy/Setting.h"

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

TEST(Setting, AllExponentialUnitsAreTried) {
  const auto &Values = allKnobs().front().Values;
  EXPECT_EQ(Values.size(), ExpUnits.size());
  for (const ExpUnit E : ExpUnits)
    EXPECT_EQ(std::count(Values.begin(), Values.end(), name(E)), 1) << name(E);
}

} // namespace
