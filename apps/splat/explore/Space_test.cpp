#include "explore/Space.h"

#include <gtest/gtest.h>
#include <set>

using namespace vorion::splat;

namespace {

constexpr std::string_view Three = R"({"parameters": {
  "lanes": {"key": "timing.raster.lanes", "values": [8, 32]},
  "tile": {"option": "--tile", "values": [32]},
  "memory": {"choices": {"fast": {"timing.dram.channels": 2, "timing.dram.standard": "lpddr4-3200"}}}}})";

std::string problemOf(const std::string &Text) {
  const auto Read = parseSpace(Text, "s.json");
  return Read ? "" : Read.error().What;
}

TEST(Space, AMachineHasANameSettingsAndArguments) {
  const auto S = parseSpace(Three, "s.json");
  ASSERT_TRUE(S);
  EXPECT_EQ(nameOf(*S, {0, 0, 0}), "base");
  EXPECT_EQ(settingsOf(*S, {0, 0, 0}), "");
  EXPECT_EQ(nameOf(*S, {2, 1, 1}), "lanes=32,tile=32,memory=fast");
  EXPECT_EQ(settingsOf(*S, {2, 1, 1}),
            "timing.raster.lanes=32,timing.dram.channels=2,timing.dram."
            "standard=lpddr4-3200");
  EXPECT_EQ(argumentsOf(*S, {2, 1, 1}),
            (std::vector<std::string>{"--tile", "32"}));
}

TEST(Space, WorkSeesTheOptionsThatItTakes) {
  const auto S = parseSpace(Three, "s.json");
  ASSERT_TRUE(S);
  EXPECT_EQ(seenBy({"--tile"}, *S, {2, 1, 1}), (Choices{2, 1, 1}));
  EXPECT_EQ(seenBy({"--path"}, *S, {2, 1, 1}), (Choices{2, 0, 1}));
  EXPECT_EQ(nameOf(*S, seenBy({}, *S, {0, 1, 0})), "base");
}

TEST(Space, MachinesAreTheSameForASeedAndNoneTwice) {
  const auto S = parseSpace(Three, "s.json");
  ASSERT_TRUE(S);
  std::size_t Singles = 0;
  const auto All = machinesOf(*S, 1000, 1, Singles);
  EXPECT_EQ(Singles, 5U);
  EXPECT_EQ(All.size(), 12U); // all that there are
  EXPECT_EQ(std::set<Choices>(All.begin(), All.end()).size(), 12U);
  EXPECT_EQ(machinesOf(*S, 8, 1, Singles),
            std::vector<Choices>(All.begin(), All.begin() + 8));
  EXPECT_NE(machinesOf(*S, 8, 2, Singles), machinesOf(*S, 8, 1, Singles));
  EXPECT_EQ(machinesOf(*S, 1, 1, Singles).size(), 5U);
}

TEST(Space, TheDefaultIsOne) { EXPECT_TRUE(parseSpace(defaultSpace(), "")); }

TEST(Space, WhatIsNoSpaceIsRefusedByItsKey) {
  const auto With = [](const std::string &Of) {
    return problemOf(R"({"parameters": {"p": )" + Of + "}}");
  };
  EXPECT_NE(problemOf("{}").find("\"parameters\""), std::string::npos);
  EXPECT_NE(problemOf(R"({"parameters": {}})").find("\"parameters\""),
            std::string::npos);
  EXPECT_NE(problemOf(R"({"parameters": {"a b": {}}})")
                .find("key parameters: expected names"),
            std::string::npos);
  EXPECT_NE(With("3").find("key parameters.p: expected \"key\""),
            std::string::npos);
  EXPECT_NE(With(R"({"key": "k", "values": []})").find("parameters.p.values"),
            std::string::npos);
  EXPECT_NE(With(R"({"key": "k", "values": ["a b"]})").find("numbers or names"),
            std::string::npos);
  EXPECT_NE(With(R"({"key": "a=b", "values": [1]})").find("parameters.p.key"),
            std::string::npos);
  EXPECT_NE(
      With(R"({"option": "tile", "values": [1]})").find("parameters.p.option"),
      std::string::npos);
  EXPECT_NE(With(R"({"key": "k", "values": [1, 1]})").find("found 1 twice"),
            std::string::npos);
  EXPECT_NE(With(R"({"key": "k", "values": [1], "more": 1})")
                .find("key parameters.p"),
            std::string::npos);
  EXPECT_NE(With(R"({"choices": {}})").find("parameters.p.choices"),
            std::string::npos);
  EXPECT_NE(
      With(R"({"choices": {"c": {"k": [1]}}})").find("parameters.p.choices.c"),
      std::string::npos);
}

} // namespace
