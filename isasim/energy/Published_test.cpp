/// The default technology beside published figures.
#include "energy/Published.h"

#include <gtest/gtest.h>
#include <utility>

using namespace vorion::isasim;

TEST(Published, EachHasAFigureOfOurs) {
  for (const PublishedFigure &P : publishedFigures()) {
    EXPECT_FALSE(P.Source.empty()) << P.What;
    EXPECT_LE(P.Low, P.High) << P.What;
    EXPECT_EQ(P.Row.empty(), !P.Events.empty()) << P.What;
    for (const EventCount &E : P.Events)
      EXPECT_TRUE(knowsEvent(E)) << P.What << ": " << E.Unit << ", " << E.Event;
    const auto Ours = oursOf(P, defaultTechnology());
    ASSERT_TRUE(Ours) << P.What << ": " << Ours.error().What;
    EXPECT_LT(0, Ours->Low) << P.What;
    EXPECT_LT(Ours->Low, Ours->Value) << P.What;
    EXPECT_LT(Ours->Value, Ours->High) << P.What;
  }
}

TEST(Published, OursIsTakenAtTheirVoltage) {
  const PublishedFigure Wire{"a byte over 1 mm", "", 0.4, 1, 1,
                             "wire byte mm",     2,  {},  ""};
  const auto Ours = oursOf(Wire, defaultTechnology());
  ASSERT_TRUE(Ours);
  EXPECT_NEAR(Ours->Value, 2 * 0.75 / 4, 1e-12);
  PublishedFigure Line = Wire;
  Line.Row = {};
  Line.Events = {{"l2", "line reads", 1}};
  // Events are asked of the model, whose law ends far above that.
  EXPECT_FALSE(oursOf(Line, defaultTechnology()));
}

TEST(Published, BesideIsWithinWhereIntervalsMeet) {
  const PublishedFigure Theirs{"", "", 0.8, 2, 3, "gate", 1, {}, ""};
  EXPECT_EQ(besideOf({1.5, 1, 1.9}, Theirs), Beside::Below);
  EXPECT_EQ(besideOf({1.5, 1, 2}, Theirs), Beside::Within);
  EXPECT_EQ(besideOf({5, 3, 6}, Theirs), Beside::Within);
  EXPECT_EQ(besideOf({5, 3.1, 6}, Theirs), Beside::Above);
}

/// As docs/energy.md says: a row that moves one of them is worth a look there.
TEST(Published, OursIsWithinOfAllButThese) {
  const auto Are = [](Beside B) {
    std::vector<std::pair<std::string_view, std::string_view>> Found;
    for (const PublishedFigure &P : publishedFigures())
      if (besideOf(*oursOf(P, defaultTechnology()), P) == B)
        Found.emplace_back(P.What, P.Node);
    return Found;
  };
  using Pairs = std::vector<std::pair<std::string_view, std::string_view>>;
  EXPECT_EQ(
      Are(Beside::Below),
      (Pairs{{"the same, and an operation of a core of 64 bits with virtual "
              "memory",
              "22 nm"},
             {"a fused multiplication of fp32, one lane", "7 nm"},
             {"an integer addition, 32 lanes of two warps, and of one warp",
              "12 nm"},
             {"a fused multiplication of fp32, the same", "12 nm"}}));
  EXPECT_EQ(
      Are(Beside::Above),
      (Pairs{{"an access of a lane to local memory, and 32 bits of a bank of 2 "
              "KiB",
              "22 nm"},
             {"a line of 64 bytes of the data cache, 16 KiB", "22 nm"},
             {"a pixel of 128 bits, in a bank of 4 KiB with a read and a write "
              "port",
              "22 nm"},
             {"a bit of a memory of 32 KiB, um2", "22 nm"}}));
}
