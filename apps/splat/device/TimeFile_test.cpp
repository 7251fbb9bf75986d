#include "device/TimeFile.h"

#include "io/TestFiles.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

using Json = nlohmann::ordered_json;

Json timeReport(unsigned Cycles, unsigned Memory) {
  return {{"cycles", Cycles},
          {"clock_mhz", 500},
          {"clock_version", 2},
          {"host", Json{{"launch_ns", 2000}}},
          {"cores", {{{"issue", 10}, {"memory", Memory}}, Json{{"issue", 5}}}},
          {"dram", Json{{"read_bursts", 7}}},
          {"activities",
           Json::array({Json{
               {"unit", "lsu"}, {"event", "lines requested"}, {"count", 3}}})}};
}

/// As `vorion-sim --stats` writes it, of two runs.
Json stats(unsigned Memory = 20) {
  return {{"config", {{"clusters", 1}, {"host_threads", 4}}},
          {"runs",
           {{{"name", "add"}, {"time", timeReport(1000, Memory)}},
            {{"name", "scan"}, {"time", timeReport(500, 0)}}}}};
}

/// As `splat render --json` writes it.
Json frame() {
  const Json Hash = {{"file", "somewhere"}, {"fnv1a64", "0123"}};
  return {{"scene", Hash},
          {"cameras", Hash},
          {"view", "front"},
          {"device", {{"name", "Vorion"}, {"configuration", "default"}}},
          {"time",
           {{"frame_ms", 2.5},
            {"sum", timeReport(1000, 20)},
            {"stages",
             {{{"name", "project"},
               {"time", timeReport(1000, 20)},
               {"kernels",
                Json::array({Json{{"name", "project"}, {"cycles", 1000}}})}},
              Json{{"name", "upload"}}}}}}};
}

TimeFile read(const Json &J) {
  const TestFolder Folder;
  auto F = readTimeFile(Folder.write("t.json", jsonText(J)));
  EXPECT_TRUE(F) << F.error().What;
  return F ? *F : TimeFile();
}

double figure(const TimeFile &F, std::string_view Group,
              std::string_view Name) {
  const auto Found = std::ranges::find_if(F.Figures, [&](const TimeFigure &X) {
    return X.Group == Group && X.Name == Name;
  });
  return Found == F.Figures.end() ? -1 : Found->Value;
}

std::string problem(const Json &A, const Json &B, bool Across = false) {
  const auto Fit = checkComparable(read(A), read(B), Across);
  return Fit ? "" : Fit.error().What.substr(0, Fit.error().What.find(" in /"));
}

TEST(TimeFile, RunsAndUnitsAddUp) {
  const TimeFile F = read(stats());
  EXPECT_EQ(F.ClockVersion, 2U);
  EXPECT_DOUBLE_EQ(F.Milliseconds, 1500 / 500e3);
  EXPECT_EQ(figure(F, "", "cycles"), 1500);
  EXPECT_EQ(figure(F, "runs, cycles", "scan"), 500);
  EXPECT_EQ(figure(F, "cores", "issue"), 30);
  EXPECT_EQ(figure(F, "dram", "read_bursts"), 14);
  EXPECT_EQ(figure(F, "lsu, events", "lines requested"), 6);
  EXPECT_EQ(figure(F, "host", "launch_ns"), -1);
}

TEST(TimeFile, EventsOfAUnitAreNotItsCounts) {
  Json Both = stats();
  for (Json &Run : Both["runs"]) {
    Run["time"]["dram"]["refreshes"] = 5;
    Run["time"]["activities"].push_back(
        {{"unit", "dram"}, {"event", "refreshes"}, {"count", 5}});
  }
  EXPECT_EQ(figure(read(Both), "dram", "refreshes"), 10);
  EXPECT_EQ(figure(read(Both), "dram, events", "refreshes"), 10);
  // One title for each group, however a report mixes them.
  for (Json &Run : Both["runs"])
    Run["time"]["activities"].push_back(
        {{"unit", "lsu"}, {"event", "loads"}, {"count", 5}});
  const TimeFile F = read(Both);
  EXPECT_TRUE(
      std::ranges::adjacent_find(F.Figures, [](const auto &A, const auto &B) {
        return A.Name == "lines requested" && B.Name == "loads";
      }) != F.Figures.end());
}

TEST(TimeFile, AFrameHasStagesAndKernels) {
  const TimeFile F = read(frame());
  EXPECT_EQ(F.Milliseconds, 2.5);
  EXPECT_EQ(figure(F, "", "cycles"), 1000);
  EXPECT_EQ(figure(F, "stages, cycles", "project"), 1000);
  EXPECT_EQ(figure(F, "kernels, cycles", "project"), 1000);
  EXPECT_EQ(figure(F, "stages, cycles", "upload"), -1);
}

TEST(TimeFile, WhatDiffersIsNamed) {
  Json Threads = stats();
  Threads["config"]["host_threads"] = 1;
  EXPECT_EQ(problem(stats(), Threads), "");
  Json Moved = frame();
  Moved["scene"]["file"] = "elsewhere";
  EXPECT_EQ(problem(frame(), Moved), "");

  Json Clusters = stats();
  Clusters["config"]["clusters"] = 4;
  EXPECT_EQ(problem(stats(), Clusters),
            "different machine: clusters is 4, expected 1 as");
  EXPECT_EQ(problem(stats(), Clusters, true), "");
  Json Mhz = frame();
  Mhz["time"]["sum"]["clock_mhz"] = 100;
  EXPECT_EQ(problem(frame(), Mhz),
            "different machine: clock_mhz is 100, expected 500 as");
  // However a configuration was written, and wherever its table lies.
  Json Machine = frame(), Named = frame(), Table = frame();
  for (Json *Each : {&Machine, &Named, &Table}) {
    Json &Sum = (*Each)["time"]["sum"];
    Sum["machine"] = "prototype";
    Sum["machine_changes"] = Json::array();
    Sum["dram_table"] = {{"file", ""}, {"fnv1a64", "01"}};
  }
  Named["device"]["configuration"] = {{"machine", "prototype"}};
  Named["time"]["sum"]["dram_table"]["file"] = "here.json";
  EXPECT_EQ(problem(Machine, Named), "");
  Table["time"]["sum"]["dram_table"]["fnv1a64"] = "02";
  EXPECT_EQ(problem(Machine, Table),
            "different machine: dram_table is \"02\", expected \"01\" as");
  Table["time"]["sum"]["machine_changes"] = {"clusters=2"};
  EXPECT_EQ(problem(Machine, Table, true), "");
  Json View = frame();
  View["view"] = "close";
  EXPECT_EQ(problem(frame(), View),
            "different work: view is \"close\", expected \"front\" as");
  Json Shorter = stats();
  Shorter["runs"].erase(1);
  EXPECT_EQ(problem(stats(), Shorter),
            "different work: runs.1 is nothing, expected \"scan\" as");
  Json Version = frame();
  Version["time"]["sum"]["clock_version"] = 3;
  for (const bool Across : {false, true})
    EXPECT_EQ(problem(frame(), Version, Across),
              "version 3 of the clock, expected version 2 as");
}

TEST(TimeFile, AChangeThatOneMachineHasIsNamed) {
  Json Plain = frame(), Changed = frame();
  Plain["time"]["sum"]["machine_changes"] = Json::array();
  Changed["time"]["sum"]["machine_changes"] = {"clusters=2"};
  EXPECT_EQ(problem(Plain, Changed),
            "different machine: machine_changes.0 is \"clusters=2\", expected "
            "nothing as");
  EXPECT_EQ(problem(Changed, Plain),
            "different machine: machine_changes.0 is nothing, expected "
            "\"clusters=2\" as");
}

TEST(TimeFile, TimesNameMachineAndClock) {
  Json Named = frame(), Slow = frame();
  for (Json *Each : {&Named, &Slow})
    (*Each)["time"]["sum"]["machine"] = "prototype";
  Slow["time"]["sum"]["clock_mhz"] = 100;
  EXPECT_EQ(machinesText(read(Named), read(Named)),
            "machine      prototype, 500 MHz, clock version 2\n");
  EXPECT_EQ(machinesText(read(Named), read(Slow)),
            "machine of a prototype, 500 MHz, clock version 2\n"
            "machine of b prototype, 100 MHz, clock version 2\n");
  EXPECT_EQ(read(stats()).On, "unknown, 500 MHz, clock version 2");
}

TEST(TimeFile, OtherLaunchesAreOtherWork) {
  const Json Launch = {
      {"program_fnv1a64", "01"},
      {"global", {64, 1, 1}},
      {"arguments", {{{"name", "n"}, {"value", 5}}, {{"name", "out"}}}}};
  Json Known = stats(), Wider = stats(), Longer = stats(), Said = stats();
  for (Json *Each : {&Known, &Wider, &Longer, &Said})
    (*Each)["runs"][0]["launch"] = Launch;
  Wider["runs"][0]["launch"]["global"][0] = 128;
  Longer["runs"][0]["launch"]["arguments"][0]["value"] = 6;
  Said["runs"][0]["launch"]["arguments"][1]["bytes"] = 64;
  EXPECT_EQ(problem(Known, Wider),
            "different work: launches.0.global.0 is 128, expected 64 as");
  EXPECT_EQ(problem(Known, Wider, true), "");
  EXPECT_EQ(problem(Known, Longer),
            "different work: launches.0.arguments.0.value is 6, expected 5 as");
  // What one of them does not know is not compared.
  EXPECT_EQ(problem(Known, Said), "");
  EXPECT_EQ(problem(Known, stats()), "");
  EXPECT_EQ(problem(stats(), Known), "");
}

TEST(TimeFile, ARunThatWasCutOffIsRefused) {
  const TestFolder Folder;
  Json Cut = stats();
  Cut["runs"][0]["outcome"] = "done";
  Cut["runs"][1]["outcome"] = "limit reached";
  const auto F = readTimeFile(Folder.write("t.json", jsonText(Cut)));
  ASSERT_FALSE(F);
  EXPECT_EQ(F.error().What, "run 2, scan: outcome 'limit reached', "
                            "expected 'done'");
}

TEST(TimeFile, ChangesKeepTheOrderAndWhatIsMissing) {
  Json Other = stats(40);
  for (Json &Run : Other["runs"]) {
    Run["time"]["cores"][0]["fetch"] = 1;
    Run["time"].erase("dram");
  }
  const auto Changes = changesOf(read(stats()), read(Other));
  EXPECT_EQ(Changes[0].Name, "ms");
  EXPECT_EQ(Changes[1].Name, "cycles");
  const auto Find = [&](std::string_view Name) {
    return std::ranges::find(Changes, Name, &TimeChange::Name);
  };
  EXPECT_EQ(*Find("memory")->percent(), 100);
  EXPECT_FALSE(Find("read_bursts")->B);
  EXPECT_FALSE(Find("fetch")->A);
  EXPECT_EQ(Find("fetch") - Find("memory"), 1);

  const std::string Text = toText(Changes);
  EXPECT_NE(Text.find("+100.00 %"), std::string::npos);
  EXPECT_EQ(Text.find("issue"), std::string::npos) << Text;
  // Nothing but the time and the cycles of files that are equal.
  const std::string Same = toText(changesOf(read(stats()), read(stats())));
  EXPECT_EQ(std::ranges::count(Same, '\n'), 3) << Same;
}

TEST(TimeFile, RunsWithoutTimeAreLeftOut) {
  Json Part = stats(), Rest = stats();
  Part["runs"][0].erase("time");
  Rest["runs"].erase(0);
  EXPECT_EQ(read(Part).Work, read(Rest).Work);
  EXPECT_EQ(read(Part).Milliseconds, read(Rest).Milliseconds);
}

TEST(TimeFile, WhateverElseAFileHoldsIsRefused) {
  const TestFolder Folder;
  Json Untimed = stats(), Odd = frame(), None = stats();
  for (Json &Run : Untimed["runs"])
    Run.erase("time");
  Odd["time"]["sum"]["activities"] = {1};
  None["runs"] = Json::array();
  for (const Json &J :
       {Untimed, Odd, None, Json::object(), Json::array(), Json(1)}) {
    const auto F = readTimeFile(Folder.write("t.json", jsonText(J)));
    ASSERT_FALSE(F) << J;
    EXPECT_NE(F.error().What.find("expected the output of `splat render"),
              std::string::npos)
        << F.error().What;
  }
}

} // namespace
