/// Timing tables: those that come along, and what is refused.
#include "timing/dram/TimingTable.h"

#include "timing/dram/Standards.h"
#include "vorion/support/Json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::isasim::dram;

namespace {

using Json = nlohmann::ordered_json;

Json lpddr4() { return ownJson<Json>(standardText("lpddr4-3200")); }

/// What is said of a table; empty if it is good.
std::string problem(const Json &J) {
  const auto T = parseTimingTable(jsonText(J), "t.json");
  return T ? std::string() : T.error().Where + ": " + T.error().What;
}

void drop(Json &J, std::string_view From, std::string_view To,
          bool IsWindow = false) {
  Json Kept = Json::array();
  for (const Json &Row : J["constraints"])
    if (Row["from"] != From || Row["to"] != To ||
        Row.contains("window") != IsWindow)
      Kept.push_back(Row);
  J["constraints"] = Kept;
}

TEST(TimingTable, TheStandardsAreGood) {
  const std::pair<std::string_view, double> BytesOfNs[] = {
      {"ddr3-1600", 12.8},  {"ddr4-3200", 25.6},   {"hbm2e", 25.6},
      {"lpddr4-3200", 6.4}, {"lpddr5-6400", 12.8}, {"ramulator-lpddr4", 6.4}};
  ASSERT_EQ(standards().size(), std::size(BytesOfNs));
  for (const auto &[Name, Peak] : BytesOfNs) {
    const auto T = standardTable(Name);
    ASSERT_TRUE(T) << T.error().What;
    EXPECT_EQ(T->Standard, Name);
    EXPECT_DOUBLE_EQ(T->peakBandwidth(), Peak) << Name;
  }
}

TEST(TimingTable, TheReferencesTableHasItsValues) {
  const auto T = standardTable("ramulator-lpddr4");
  ASSERT_TRUE(T);
  using C = Command;
  EXPECT_EQ(T->sameBank(C::Activate, C::Read), 29U);
  EXPECT_EQ(T->sameBank(C::Activate, C::Activate), 95U);
  EXPECT_EQ(T->sameBank(C::Write, C::Precharge), 54U);
  EXPECT_EQ(T->sameBank(C::Read, C::Write), 26U);
  EXPECT_EQ(T->sameBank(C::Write, C::Read), 43U);
  EXPECT_EQ(T->ReadLatency, 35U);
}

TEST(TimingTable, AnUnknownStandardIsRefused) {
  const auto T = standardTable("lpddr4-320");
  ASSERT_FALSE(T);
  EXPECT_EQ(T.error().What,
            "\"lpddr4-320\" is not a DRAM standard, expected one of ddr3-1600, "
            "ddr4-3200, hbm2e, lpddr4-3200, lpddr5-6400, ramulator-lpddr4; did "
            "you mean lpddr4-3200?");
}

TEST(TimingTable, ALineLiesInARow) {
  Json J = lpddr4();
  J["row_bytes"] = J["burst_bytes"] = 32;
  EXPECT_EQ(problem(J),
            "t.json: key row_bytes is 32, expected at least a line's 64");
}

TEST(TimingTable, ItsHashIsThatOfWhatItSays) {
  const Json J = lpddr4();
  Json Slower = J;
  Slower["tick_ps"] = 1250;
  const auto A = parseTimingTable(jsonText(J), "a"),
             Again = parseTimingTable(jsonText(J), "b"),
             B = parseTimingTable(jsonText(Slower), "a");
  EXPECT_EQ(A->Hash, Again->Hash);
  EXPECT_NE(A->Hash, B->Hash);
}

TEST(TimingTable, AMissingConstraintIsNamed) {
  for (const auto &[From, To] : {std::pair{"ACT", "RD"},
                                 {"WR", "RD"},
                                 {"RD", "PRE"},
                                 {"PRE", "ACT"},
                                 {"REF", "ACT"},
                                 {"REFPB", "ACT"}}) {
    Json J = lpddr4();
    drop(J, From, To);
    EXPECT_EQ(problem(J), std::string("t.json: key constraints has no ") +
                              From + " to " + To);
  }
  Json J = lpddr4();
  drop(J, "ACT", "ACT", true);
  EXPECT_EQ(problem(J),
            "t.json: key constraints has no ACT to ACT with a window (tFAW)");
}

TEST(TimingTable, AnImpossibleConstraintIsNamed) {
  const auto With = [](const char *Value, uint32_t Ticks) {
    Json J = lpddr4();
    J["values"][Value][0] = Ticks;
    return problem(J);
  };
  EXPECT_EQ(With("nREFI", 288),
            "t.json: key refresh_interval is 288 ticks, expected more than the "
            "288 of a refresh");
  EXPECT_EQ(With("nRAS", 20),
            "t.json: key constraints says ACT to PRE is 20 ticks, expected at "
            "least 29: the row is not open");
  Json J = lpddr4();
  for (Json &Row : J["constraints"])
    if (Row["from"] == "RD" && Row["to"] == "RD")
      Row["ticks"] = "nBL - 1";
  EXPECT_EQ(problem(J),
            "t.json: key constraints says RD to RD of any banks is 7 ticks, "
            "expected at least 8: the data bus is taken");
  J = lpddr4();
  for (Json &Row : J["constraints"])
    if (Row["from"] == "ACT" && Row["to"] == "ACT" && Row["scope"] == "bank")
      Row["ticks"] = "nRAS";
  EXPECT_EQ(problem(J),
            "t.json: key constraints says ACT to ACT is 68 ticks, expected at "
            "least 97: ACT to PRE and PRE to ACT");
}

TEST(TimingTable, WhatIsNoTableIsRefusedByItsKey) {
  const auto With = [](const auto &Change) {
    Json J = lpddr4();
    Change(J);
    return problem(J);
  };
  EXPECT_EQ(
      With([](Json &J) { J["constraints"][0]["ticks"] = "nRCDX"; }),
      "t.json: key constraints[0].ticks uses nRCDX, which is not in values");
  EXPECT_EQ(With([](Json &J) { J["constraints"][0]["ticks"] = "nRCD nRCD"; }),
            "t.json: key constraints[0].ticks is \"nRCD nRCD\", expected + or "
            "- between its terms");
  EXPECT_EQ(With([](Json &J) { J["constraints"][0]["ticks"] = "nRCD - 99"; }),
            "t.json: key constraints[0].ticks is -70 ticks, expected 1 to "
            "16777216");
  EXPECT_EQ(With([](Json &J) { J["constraints"][0]["from"] = "OPEN"; }),
            "t.json: key constraints[0].from is \"OPEN\", expected one of ACT, "
            "PRE, PREA, RD, WR, REF, REFPB, ACT2");
  EXPECT_EQ(With([](Json &J) { J["constraints"][0]["scope"] = "die"; }),
            "t.json: key constraints[0].scope is \"die\", expected one of "
            "bank, bank_group, rank, channel, other_ranks");
  EXPECT_EQ(With([](Json &J) { J["banks_per_group"] = 6; }),
            "t.json: key banks_per_group is 6, expected a power of two");
  EXPECT_EQ(With([](Json &J) { J["ranks"] = 16; }),
            "t.json: key banks_per_group makes 128 banks of a channel, "
            "expected at most 64");
  EXPECT_EQ(With([](Json &J) { J["ranks"] = 2; }),
            "t.json: key constraints has no RD to RD of other_ranks");
  EXPECT_EQ(With([](Json &J) { J["values"]["nRCD"] = 29; }),
            "t.json: key values.nRCD is 29, expected [ticks, source]");
  EXPECT_EQ(With([](Json &J) { J["command_ticks"]["RD"] = 0; }),
            "t.json: key command_ticks.RD is 0, expected 1 to 64");
  EXPECT_EQ(With([](Json &J) {
              J["constraints"].push_back(J["constraints"][0]);
            }).substr(0, 34),
            "t.json: duplicate key constraints[");
  EXPECT_EQ(With([](Json &J) { J["constraints"][3]["scope"] = "bank"; }),
            "t.json: key constraints[3].scope is bank, expected rank: ACT and "
            "PREA do not both name a bank");
  EXPECT_EQ(With([](Json &J) { J["second_activate"] = "nRCD"; }),
            "t.json: key second_activate is 29 ticks, expected fewer than the "
            "29 of ACT to RD");
  EXPECT_EQ(With([](Json &J) { J["second_activate"] = "4"; }),
            "t.json: key command_ticks.RD is 4, expected 1 with "
            "second_activate: the second half has its tick");
  EXPECT_EQ(
      With([](Json &J) { J["constraints"][0]["from"] = "ACT2"; }).substr(0, 41),
      "t.json: key constraints has no ACT to RD");
  EXPECT_EQ(With([](Json &J) {
              J["constraints"].push_back({{"from", "ACT2"},
                                          {"to", "RD"},
                                          {"scope", "bank"},
                                          {"ticks", "nRCD"}});
            }),
            "t.json: key constraints names ACT2, expected second_activate, the "
            "ticks in which it follows");
  EXPECT_NE(With([](Json &J) { J.erase("tick_ps"); }).find("tick_ps"),
            std::string::npos);
}

} // namespace
