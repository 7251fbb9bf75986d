#include "vorion/support/Terminal.h"

#include <gtest/gtest.h>
#include <limits>

using namespace vorion;

namespace {

TEST(Terminal, ABarIsAsFullAsItsShare) {
  EXPECT_EQ(barText(0, 4), "[                    ]");
  EXPECT_EQ(barText(1, 4), "[=====               ]");
  EXPECT_EQ(barText(4, 4), "[====================]");
  EXPECT_EQ(barText(9, 4), "[====================]");
  EXPECT_EQ(barText(0, 0), "[                    ]");
}

TEST(Terminal, TimesAreRoundedToWhatAPersonNeeds) {
  EXPECT_EQ(durationText(0), "0 s");
  EXPECT_EQ(durationText(0.2), "1 s");
  EXPECT_EQ(durationText(119), "119 s");
  EXPECT_EQ(durationText(170), "3 min");
  EXPECT_EQ(durationText(7500), "2 h 5 min");
  EXPECT_EQ(durationText(std::numeric_limits<double>::infinity()),
            "unknown time");
  EXPECT_EQ(durationText(-1), "unknown time");
}

TEST(Terminal, SaysWhatIsLeftOfACount) {
  EXPECT_EQ(timeLeftText(5, 0, 4), "");
  EXPECT_EQ(timeLeftText(5, 1, 4), ", 15 s left");
  EXPECT_EQ(timeLeftText(20, 4, 4), "");
}

} // namespace
