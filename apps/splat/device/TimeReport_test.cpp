#include "device/TimeReport.h"

#include "vorion/support/Json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;

namespace {

using Json = nlohmann::ordered_json;

/// A report of two cores, each of whose counts differ.
TimeReport sample() {
  TimeReport R;
  R.Cycles = 1000;
  R.ClockMhz = 530;
  R.ClockVersion = 2;
  R.Machine = "prototype with changes";
  R.MachineChanges = {"timing.l2.ways=4"};
  R.Host = {1, 2, 3, 64};
  R.Areas = {{10.5, 20}, {30}, {40.25}, 5};
  R.Cores.resize(2);
  for (std::size_t I = 0; I != R.Cores[1].Values.size(); ++I)
    R.Cores[1].Values[I] = I;
  R.Rasterizers.resize(1);
  R.PixelUnits.resize(1);
  R.L2.resize(1);
  R.Llc.Values[0] = 7;
  R.Link.Values[0] = 6;
  R.Dram.Values[0] = 8;
  R.Activities = {{"core", "fetch", 9}};
  R.StaleLoads = 4;
  R.CommandsLeft = 3;
  R.OutOfOrder = 1;
  return R;
}

TEST(TimeReport, IsWrittenAsItIsRead) {
  const std::string Text = jsonText(toJson(sample()));
  const auto Read = parseTimeReport(Text);
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(jsonText(toJson(*Read)), Text);
  EXPECT_EQ(Read->Cores[1][CoreCount::Ended], uint64_t(CoreCount::Ended));
  EXPECT_EQ(Read->Areas.Exponential[1], 20);
}

// What is no reason is never shown as a share of cycles.
TEST(TimeReport, ReasonsAreCountsOfCyclesAlone) {
  constexpr auto All = reasonsOf<RasterCount>();
  EXPECT_EQ(All.front(), RasterCount::Blend);
  EXPECT_EQ(All.back(), RasterCount::Idle);
  EXPECT_LT(All.size(), CountNames<RasterCount>.size());
}

TEST(TimeReport, CountsAddUpAndTheMachineStays) {
  std::optional<TimeReport> Sum;
  add(Sum, std::nullopt);
  EXPECT_FALSE(Sum);
  add(Sum, sample());
  TimeReport Later = sample();
  Later.CommandsLeft = 0;
  add(Sum, Later);
  add(Sum, std::nullopt);
  EXPECT_EQ(Sum->Cycles, 2000U);
  EXPECT_EQ(Sum->ClockMhz, 530U);
  EXPECT_EQ(Sum->ClockVersion, 2U);
  EXPECT_EQ(Sum->Machine, "prototype with changes");
  EXPECT_EQ(Sum->Host.DramBurstBytes, 64U);
  EXPECT_EQ(Sum->Areas.Exponential[0], 10.5);
  EXPECT_EQ(Sum->Cores[1][CoreCount::Ended], 2 * uint64_t(CoreCount::Ended));
  EXPECT_EQ(Sum->Llc[CacheCount::Reads], 14U);
  EXPECT_EQ(Sum->Link[LinkCount::BytesToL2], 12U);
  EXPECT_EQ(Sum->Dram[DramCount::ReadBursts], 16U);
  EXPECT_EQ(Sum->Activities[0].Count, 18U);
  EXPECT_EQ(Sum->StaleLoads, 8U);
  EXPECT_EQ(Sum->CommandsLeft, 0U);
  EXPECT_EQ(Sum->OutOfOrder, 2U);
}

TEST(TimeReport, ActivitiesAreAddedByNames) {
  TimeReport Sum = sample(), Later = sample();
  Sum.Cycles = Later.Cycles = 100;
  Sum.Activities = {{"time", "cores", 800}, {"core", "fetch", 9}};
  Later.Activities = {{"rasterizer front end", "ray", 5},
                      {"time", "cores", 800},
                      {"time", "lanes that meet rays", 1600},
                      {"core", "fetch", 9}};
  for (TimeReport R : {Sum, Later}) {
    R += R.Activities.size() == 2 ? Later : Sum;
    std::map<std::string, uint64_t> Counts;
    for (const Activity &A : R.Activities)
      Counts[A.Unit + ": " + A.Event] = A.Count;
    EXPECT_EQ(Counts, (std::map<std::string, uint64_t>{
                          {"core: fetch", 18},
                          {"rasterizer front end: ray", 5},
                          {"time: cores", 1600},
                          {"time: lanes that meet rays", 3200}}));
  }
}

TEST(TimeReport, EveryMemberIsThereAndNoOther) {
  const auto Problem = [](const Json &J) {
    const auto Read = parseTimeReport(jsonText(J));
    return Read ? std::string() : Read.error().What;
  };
  const Json Whole = toJson(sample());
  EXPECT_EQ(Problem(Whole), "");
  for (const auto &[Key, Value] : Whole.items()) {
    Json Without = Whole, Other = Whole;
    Without.erase(Key);
    EXPECT_EQ(Problem(Without), "/" + Key + ": expected this member");
    Other[Key] = nullptr;
    EXPECT_TRUE(Problem(Other).starts_with("/" + Key + ": expected ")) << Key;
  }
  Json More = Whole;
  More["cores"][0]["new"] = 1;
  EXPECT_EQ(Problem(More), fmt::format("/cores: expected {} members",
                                       CountNames<CoreCount>.size()));
  EXPECT_NE(Problem(Json::array()), "");
}

} // namespace
