#include "observe/CycleTimeline.h"

#include "observe/ChipPower.h"
#include "vorion/support/Json.h"

#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

using namespace vorion;
using namespace vorion::isasim;

namespace {

using Json = nlohmann::ordered_json;

/// A timeline, in memory, of a machine with two cores and a link.
class CycleTimelineTest : public testing::Test {
protected:
  CycleTimelineTest() {
    Shape.CoresPerSocket = 2;
    Shape.SocketsPerCluster = 1;
    Shape.Timing.Link.ToL2Ns = 25;
    Times.emplace(File.get(), Shape);
  }

  void spend(unsigned Core, CoreCycle What, uint64_t From, uint64_t Until) {
    Times->coreSpent({Core, What, {From, Until}});
  }

  std::vector<Json> wholeFile() {
    std::string Text(static_cast<size_t>(std::ftell(File.get())) + 4, ' ');
    EXPECT_EQ(std::fseek(File.get(), 0, SEEK_SET), 0);
    Text.resize(std::fread(Text.data(), 1, Text.size(), File.get()));
    const auto Whole = parseJson<Json>(Text, "the timeline", "JSON");
    EXPECT_TRUE(Whole) << Text;
    return Whole ? (*Whole)["traceEvents"].get<std::vector<Json>>()
                 : std::vector<Json>();
  }
  /// All events that are no names.
  std::vector<Json> events() {
    std::vector<Json> Found = wholeFile();
    std::erase_if(Found, [](const Json &E) { return E["ph"] == "M"; });
    return Found;
  }
  /// Slices of core \p Core.
  std::vector<Json> slicesOf(unsigned Core) {
    const std::string Name = fmt::format("core {}", Core);
    std::vector<Json> Found;
    Json Row;
    for (const Json &E : wholeFile())
      if (E["ph"] == "M" && E["args"]["name"] == Name)
        Row = E;
      else if (E["ph"] == "X" && E["pid"] == Row["pid"] &&
               E["tid"] == Row["tid"])
        Found.push_back(E);
    return Found;
  }

  struct Closer {
    void operator()(std::FILE *F) const { std::fclose(F); }
  };
  Config Shape;
  std::unique_ptr<std::FILE, Closer> File{std::tmpfile()};
  std::optional<CycleTimeline> Times;
};

} // namespace

TEST_F(CycleTimelineTest, NeighboursOfOneReasonAreOneSlice) {
  Times->timeBegins(1000);
  spend(0, CoreCycle::Issue, 1000, 1040);
  spend(0, CoreCycle::Memory, 1040, 1041);
  spend(0, CoreCycle::Issue, 1041, 1064);
  spend(0, CoreCycle::Memory, 1064, 1100);
  Times->timeEnds(1100);
  Times->runEnded("add");
  const auto Slices = slicesOf(0);
  ASSERT_EQ(Slices.size(), 2U);
  EXPECT_EQ(Slices[0]["name"], "issue");
  EXPECT_EQ(Slices[0]["ts"], 1000);
  EXPECT_EQ(Slices[0]["dur"], 64);
  EXPECT_EQ(Slices[0]["args"], (Json{{"issue", 63}, {"memory", 1}}));
  EXPECT_EQ(Slices[1]["name"], "memory");
  EXPECT_EQ(Slices[1]["dur"], 36);
  EXPECT_EQ(events()[0]["name"], "add");
  EXPECT_EQ(events()[0]["dur"], 100);
}

TEST_F(CycleTimelineTest, ALongRunHasAsManyWindowsAndAllCycles) {
  constexpr uint64_t Cycles = 1'000'003;
  Times->timeBegins(0);
  // The most that there can be: every window differs from its neighbour.
  std::map<std::string, uint64_t> Spent;
  for (uint64_t At = 0; At < Cycles; At += 977) {
    const auto What = At % 2 ? CoreCycle::Branch : CoreCycle::Operand;
    const uint64_t Until = std::min(Cycles, At + 977);
    Spent[std::string(name(What))] += Until - At;
    spend(1, What, At, Until);
  }
  Times->timeEnds(Cycles);
  Times->runEnded("long");
  const auto Slices = slicesOf(1);
  EXPECT_LE(Slices.size(), CycleTimeline::MaxWindows);
  EXPECT_GE(Slices.size(), CycleTimeline::MaxWindows / 4);
  uint64_t Behind = 0;
  for (const Json &S : Slices) {
    EXPECT_EQ(S["ts"], Behind);
    uint64_t Sum = 0;
    for (const auto &[Reason, Count] : S["args"].items()) {
      Spent[Reason] -= Count.get<uint64_t>();
      Sum += Count.get<uint64_t>();
    }
    EXPECT_EQ(S["dur"], Sum);
    Behind += Sum;
  }
  EXPECT_EQ(Behind, Cycles);
  for (const auto &[Reason, Left] : Spent)
    EXPECT_EQ(Left, 0U) << Reason;
}

TEST_F(CycleTimelineTest, ABankHasAFigureThatIsToldWhenItChanges) {
  Times->timeBegins(0);
  Times->bankBusy({.Bank = 1}, {0, 8});
  Times->bankBusy({.Bank = 1}, {16, 24});
  Times->bankBusy({.Bank = 1}, {32, 33}); // 6.25 %
  Times->bankBusy({.Bank = 1}, {60, 70}); // beyond the run
  Times->timeEnds(64);
  Times->runEnded("");
  std::vector<std::pair<uint64_t, double>> Told;
  for (const Json &E : events())
    if (E["ph"] == "C") {
      EXPECT_EQ(E["name"], "slice 0 bank 1, % busy");
      Told.emplace_back(E["ts"], E["args"]["value"]);
    }
  EXPECT_EQ(Told, (std::vector<std::pair<uint64_t, double>>{
                      {0, 50}, {32, 6.3}, {48, 25}}));
}

TEST_F(CycleTimelineTest, DirectionsOfALinkHaveFigures) {
  Times->timeBegins(0);
  Times->linkBusy(true, {0, 8});
  Times->linkBusy(false, {16, 32});
  Times->timeEnds(32);
  Times->runEnded("");
  std::vector<std::pair<std::string, double>> Told;
  for (const Json &E : events())
    if (E["ph"] == "C")
      Told.emplace_back(E["name"], E["args"]["value"]);
  EXPECT_EQ(Told, (std::vector<std::pair<std::string, double>>{
                      {"to the L2, % busy", 50},
                      {"to the L2, % busy", 0},
                      {"from the L2, % busy", 100}}));
}

TEST_F(CycleTimelineTest, PowerFollowsTheWorkAndAddsUpToTheEnergy) {
  Times->timeBegins(0);
  spend(0, CoreCycle::Issue, 0, 16);
  spend(0, CoreCycle::Memory, 16, 64);
  Times->timeEnds(64);
  TimeReport T;
  T.Cycles = 64;
  T.ClockMhz = 500;
  T.Activities = {{"core lane instructions", "fma", 1'000'000},
                  {"time", "cores", 6400}};
  Times->runEnded("add", &T);
  std::vector<std::pair<uint64_t, uint64_t>> Told;
  for (const Json &E : events())
    if (E["ph"] == "C" && E["name"] == "chip, mW")
      Told.emplace_back(E["ts"], E["args"]["value"]);
  ASSERT_EQ(Told.size(), 2U);
  EXPECT_EQ(Told[0].first, 0U);
  EXPECT_EQ(Told[1].first, 16U);
  EXPECT_GT(Told[0].second, 10 * Told[1].second);
  EXPECT_GT(Told[1].second, 0U);
  const ChipEnergy E = chipEnergyOf(T);
  const double Seconds = 16 / 500e6;
  EXPECT_NEAR(static_cast<double>(Told[0].second + 3 * Told[1].second) * 1e-3 *
                  Seconds,
              E.Cores + E.Always, 4e-3 * Seconds);
}

TEST_F(CycleTimelineTest, RunsFollowEachOther) {
  for (const uint64_t Begin : {0, 32}) {
    Times->timeBegins(Begin);
    spend(0, CoreCycle::Issue, Begin, Begin + 32);
    Times->timeEnds(Begin + 32);
    Times->runEnded("same");
    // One that the clock did not take.
    Times->runEnded("untimed");
  }
  const auto Slices = slicesOf(0);
  ASSERT_EQ(Slices.size(), 2U);
  EXPECT_EQ(Slices[1]["ts"], 32);
  EXPECT_EQ(events().size(), 4U);
}

// Its importer gives a thread 0 the number of its process, and shows the thread
// with that number as the main one.
TEST_F(CycleTimelineTest, PerfettoKeepsRowsApart) {
  Times->timeBegins(0);
  Times->timeEnds(32);
  Times->runEnded("run");
  std::set<std::pair<int, int>> Rows;
  size_t Names = 0;
  for (const Json &E : wholeFile())
    if (E.contains("tid")) {
      EXPECT_NE(E["tid"], 0);
      EXPECT_NE(E["tid"], E["pid"]);
      if (E["ph"] == "M") {
        ++Names;
        Rows.emplace(E["pid"], E["tid"]);
      } else {
        EXPECT_TRUE(Rows.contains({E["pid"], E["tid"]})) << "has no name";
      }
    }
  EXPECT_EQ(Rows.size(), Names);
  EXPECT_GT(Names, Shape.cores());
}
