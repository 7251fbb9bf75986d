#include "train/settings/SettingsTable.h"

#include "io/TestFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

using namespace vorion::splat;

namespace {

TEST(TrainSettings, PhotographsGrowTwice) {
  TrainSettings S;
  EXPECT_EQ(shrinkAt(S, 1), 1);
  S.SizeInterval = 100;
  EXPECT_EQ(shrinkAt(S, 1), 4);
  EXPECT_EQ(shrinkAt(S, 100), 4);
  EXPECT_EQ(shrinkAt(S, 101), 2);
  EXPECT_EQ(shrinkAt(S, 200), 2);
  EXPECT_EQ(shrinkAt(S, 201), 1);
}

TEST(Settings, PositionsSlowDownExponentially) {
  const TrainSettings S;
  EXPECT_NEAR(positionRate(S, 0), 1.6e-4, 1e-12);
  EXPECT_NEAR(positionRate(S, 15000), 1.6e-5, 1e-13);
  EXPECT_NEAR(positionRate(S, 30000), 1.6e-6, 1e-14);
  EXPECT_NEAR(positionRate(S, 50000), 1.6e-6, 1e-14);
}

TEST(Settings, BandsComeOneAfterTheOther) {
  const TrainSettings S;
  EXPECT_EQ(shDegreeAt(S, 999, 3), 0);
  EXPECT_EQ(shDegreeAt(S, 1000, 3), 1);
  EXPECT_EQ(shDegreeAt(S, 9000, 3), 3);
  EXPECT_EQ(shDegreeAt(S, 9000, 1), 1);
}

TEST(Settings, DensityChangesAtItsTimes) {
  const TrainSettings S;
  EXPECT_FALSE(densifiesAt(S, 500));
  EXPECT_TRUE(densifiesAt(S, 600));
  EXPECT_FALSE(densifiesAt(S, 650));
  EXPECT_TRUE(densifiesAt(S, 14900));
  EXPECT_FALSE(densifiesAt(S, 15000));
  EXPECT_TRUE(notesAt(S, 14999));
  EXPECT_FALSE(notesAt(S, 15000));
  EXPECT_TRUE(resetsAt(S, 3000, false));
  EXPECT_FALSE(resetsAt(S, 500, false));
  EXPECT_TRUE(resetsAt(S, 500, true));
  EXPECT_FALSE(resetsAt(S, 15000, true));
  EXPECT_FALSE(dropsLargeAt(S, 3000));
  EXPECT_TRUE(dropsLargeAt(S, 3100));
}

TEST(Settings, McmcResetsNothing) {
  TrainSettings S;
  S.Method = DensityMethod::Mcmc;
  EXPECT_TRUE(densifiesAt(S, 600));
  EXPECT_FALSE(densifiesAt(S, 15000));
  EXPECT_FALSE(notesAt(S, 600));
  EXPECT_FALSE(resetsAt(S, 3000, true));
}

TEST(Settings, EachHasANameAndItsDefaultIsInItsRange) {
  std::set<std::string_view> Names;
  for (const SettingField &F : settingFields()) {
    EXPECT_TRUE(Names.insert(F.Name).second) << F.Name;
    for (const std::string_view Preset : presetNames())
      EXPECT_TRUE(F.takes(F.get(*readPreset(std::string(Preset))))) << F.Name;
    // A value of its own arrives where it is read.
    TrainSettings S;
    F.set(S, F.Least + 1 <= F.Most ? F.Least + 1 : F.Least);
    EXPECT_EQ(changedSettings(S).size(), F.HasOption ? 1U : 0U) << F.Name;
    EXPECT_EQ(settingsJson(S)[std::string(F.Name)].get<double>(), F.get(S));
  }
  EXPECT_EQ(Names.size() + 2, settingsJson({}).size());
  EXPECT_TRUE(changedSettings({}).empty());
  EXPECT_EQ(readPreset("mcmc")->OpacityWeight, 0.01);
}

TEST(Settings, APresetsFileChangesAPreset) {
  const TestFolder F;
  const auto Read = [&](const std::string &Text) {
    F.write("p.json", Text);
    return readPreset(F.path("p.json"));
  };
  const auto Good =
      Read(R"({"preset": "mcmc", "noise_rate": 7, "densify_until": 900})");
  ASSERT_TRUE(Good) << Good.error().What;
  EXPECT_EQ(Good->Method, DensityMethod::Mcmc);
  EXPECT_EQ(Good->NoiseRate, 7);
  EXPECT_EQ(Good->DensifyUntil, 900U);
  EXPECT_EQ(Good->StartOpacity, 0.5);
  EXPECT_EQ(Read(R"({"density": "mcmc"})")->Method, DensityMethod::Mcmc);
  for (const auto &[Text, Message] :
       {std::pair(R"({"noise_rat": 7})",
                  "key noise_rat is unknown, expected a hyperparameter; did "
                  "you mean noise_rate?"),
        {R"({"dssim": 2})", "key dssim is invalid, expected a number, 0 to 1"},
        {R"({"colour_rate": 1e-46})",
         "key colour_rate is 1e-46, which is 0 in single precision, expected 0 "
         "or more than 1.4e-45"},
        {R"({"sh_interval": 1.5})", "expected a whole number, 1 to"},
        {R"({"beta1": "x"})", "key beta1 is invalid"},
        {R"({"absgrad": 3})", "expected true or false"},
        {R"({"density": 3})", "expected classic or mcmc"},
        {R"({"preset": "inra"})", "no preset inra, expected inria, gsplat, "
                                  "mcmc or a file .json; did you mean inria?"},
        {"[]", "expected hyperparameters by name"}}) {
    const auto Bad = Read(Text);
    ASSERT_FALSE(Bad) << Text;
    EXPECT_NE(Bad.error().What.find(Message), std::string::npos)
        << Bad.error().What;
  }
}

} // namespace
