#include "explore/Trials.h"

#include "io/TestFiles.h"

#include <optional>

using namespace vorion;
using namespace vorion::splat;

namespace {

using Json = nlohmann::ordered_json;

Json interval(double Value) {
  return {{"value", Value}, {"low", Value}, {"high", Value}};
}

/// Two views of a scene that counts three times, one of another, and a state of
/// training; on machines that differ in a key, and in an option of drawing.
class TrialsTest : public ::testing::Test {
protected:
  TrialsTest() {
    EXPECT_TRUE(makeFolders(Folder.path("o")));
    P.Folder = Folder.path("o");
    P.From = {{"programs", "p"}};
    P.Parameters = {{"lanes", {{"8", "timing.raster.lanes=8", {}}}},
                    {"tile", {{"32", "", {"--tile", "32"}}}}};
    P.Options[0] = {"--tile"};
    P.Does.Parts = {{"a", Work::Frames, 3, {{"scene", "A"}}},
                    {"b", Work::Frames, 1, {{"scene", "B"}}},
                    {"t", Work::Iterations, 1, {{"capture", "T"}}}};
    P.Does.Whole = {task(0, "a@x", "x"), task(0, "a@y", "y"),
                    task(1, "b@x", "x"), task(2, "t", "")};
  }

  static Task task(std::size_t Of, const char *Name, const char *View) {
    Task T;
    T.Of = Of;
    T.Name = Name;
    T.View = View;
    return T;
  }

  PointStore open() {
    return storeOf(P, [](std::string_view Line) { ADD_FAILURE() << Line; });
  }

  /// Keeps what a machine did at the task numbered \p I; without figures, that
  /// it cannot be.
  void keep(PointStore &Kept, const Choices &Machine, std::size_t I, double Ms,
            double Joules, double Area, bool IsRefused = false) {
    const Task &What = P.Does.Whole[I];
    const std::vector<Task> Alone{What};
    const Trial One = trialsOf(P, Alone, {Machine}).front();
    const Part &Of = P.Does.Parts[What.Of];
    Provenance From = P.From;
    From.insert(Of.From.begin(), Of.From.end());
    std::string Settings = settingsOf(P.Parameters, One.Machine) + " ";
    for (const std::string &Word : argumentsOf(P.Parameters, One.Machine))
      Settings += (Settings.ends_with(' ') ? "" : " ") + Word;
    From["settings"] = Settings;
    Json Is{{"machine", "m"}, {"settings", ""}};
    if (Of.Does == Work::Frames)
      Is.update({{"view", What.View}, {"picture", "0"}});
    else
      Is["iterations"] = 3;
    if (IsRefused)
      Is["refused"] = "no";
    else
      Is.update({{timeKey(Of.Does), Ms},
                 {"clocked_machine", "prototype, 530 MHz, clock version 1"},
                 {"cycles", 1},
                 {"chip_joules", interval(Joules)},
                 {"joules", interval(Joules)},
                 {"chip_um2", interval(1e6 * Area)},
                 {"stages", Json::array()}});
    EXPECT_TRUE(Kept.keep(One.name(P.Parameters), From, Is));
  }

  void keepBase(PointStore &Kept) {
    keep(Kept, {0, 0}, 0, 10, 1, 2);
    keep(Kept, {0, 0}, 1, 20, 2, 2);
    keep(Kept, {0, 0}, 2, 60, 5, 2.5);
    keep(Kept, {0, 0}, 3, 4, 0.5, 2);
  }

  TestFolder Folder;
  ExplorePlan P;
};

TEST_F(TrialsTest, ViewsCountByTheWeightOfTheirScene) {
  PointStore Kept = open();
  keepBase(Kept);
  const auto M = measured(P, Kept, P.Does.Whole, {0, 0});
  ASSERT_TRUE(M);
  const auto &Frames = M->Is.of(Work::Frames);
  ASSERT_TRUE(Frames);
  // Weights 3, 3 and 1: 7 frames in 30 + 60 + 60 ms, for 3 + 6 + 5 joules.
  EXPECT_DOUBLE_EQ(Frames->Rate, 7000.0 / 150);
  EXPECT_DOUBLE_EQ(Frames->Joules, 2);
  EXPECT_DOUBLE_EQ(M->Is.Area, 2.5);
  ASSERT_EQ(M->Parts.size(), 3U);
  EXPECT_DOUBLE_EQ(M->Parts[0].Is.Rate, 1000.0 / 15);
  EXPECT_DOUBLE_EQ(M->Parts[0].Is.Joules, 1.5);
  EXPECT_DOUBLE_EQ(M->Parts[0].TimeShare, 0.6);
  EXPECT_DOUBLE_EQ(M->Parts[0].EnergyShare, 9.0 / 14);
  EXPECT_DOUBLE_EQ(M->Parts[1].TimeShare, 0.4);
}

TEST_F(TrialsTest, IterationsAreNotJoinedWithFrames) {
  PointStore Kept = open();
  keepBase(Kept);
  const auto M = measured(P, Kept, P.Does.Whole, {0, 0});
  ASSERT_TRUE(M);
  const auto &Iterations = M->Is.of(Work::Iterations);
  ASSERT_TRUE(Iterations);
  EXPECT_DOUBLE_EQ(Iterations->Rate, 250);
  EXPECT_DOUBLE_EQ(Iterations->Joules, 0.5);
  EXPECT_DOUBLE_EQ(M->Parts[2].TimeShare, 1);
}

TEST_F(TrialsTest, AWorkloadOfOneKindHasNoFiguresOfAnother) {
  P.Does.Parts.pop_back();
  P.Does.Whole.pop_back();
  PointStore Kept = open();
  for (std::size_t I = 0; I < 3; ++I)
    keep(Kept, {0, 0}, I, 10, 1, 2);
  const auto M = measured(P, Kept, P.Does.Whole, {0, 0});
  ASSERT_TRUE(M);
  EXPECT_FALSE(M->Is.of(Work::Iterations));
}

/// Training has no tiles of other sizes: its trial of such a machine is the
/// base's.
TEST_F(TrialsTest, WhatATaskDoesNotTakeIsNotMeasuredAgain) {
  const std::vector<Task> Two{P.Does.Whole[2], P.Does.Whole[3]};
  std::vector<std::string> Names;
  for (const Trial &One : trialsOf(P, Two, {{0, 0}, {0, 1}, {1, 1}}))
    Names.push_back(One.name(P.Parameters));
  ASSERT_EQ(Names.size(), 5U);
  EXPECT_EQ(Names[0], "base@b@x");
  EXPECT_EQ(Names[1], "base@t");
  EXPECT_TRUE(Names[2].ends_with("@b@x"));
  EXPECT_TRUE(Names[3].ends_with("@b@x"));
  EXPECT_TRUE(Names[4].ends_with("@t"));
}

TEST_F(TrialsTest, AMachineThatCannotDoAPartCannotBe) {
  PointStore Kept = open();
  for (std::size_t I = 0; I < 4; ++I)
    keep(Kept, {1, 0}, I, 10, 1, 2, I == 2);
  const auto M = measured(P, Kept, P.Does.Whole, {1, 0});
  ASSERT_TRUE(M);
  EXPECT_EQ(M->Refused, "no");
}

TEST_F(TrialsTest, WhatIsNotMeasuredIsAnError) {
  PointStore Kept = open();
  keep(Kept, {0, 0}, 0, 10, 1, 2);
  const auto M = measured(P, Kept, P.Does.Whole, {0, 0});
  ASSERT_FALSE(M);
  EXPECT_NE(M.error().What.find("point base@a@y is missing"),
            std::string::npos);
}

} // namespace
