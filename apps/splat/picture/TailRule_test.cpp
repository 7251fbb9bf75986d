#include "picture/TailRule.h"

#include <gtest/gtest.h>

namespace vorion::splat {
namespace {

TEST(TailRule, TextAndBack) {
  for (const char *Text :
       {"off", "count:1", "count:16777216", "occluded:0.9", "occluded:1",
        "last:1/4", "last:255/255", "count:64,occluded:0.5,last:1/8"}) {
    const auto R = parseTailRule(Text);
    ASSERT_TRUE(R) << Text;
    EXPECT_EQ(toString(*R), Text);
    EXPECT_EQ(R->any(), std::string(Text) != "off");
  }
}

TEST(TailRule, RefusesWhatItDoesNotKnow) {
  for (const char *Text :
       {"", "on", "count", "count:", "count:0", "count:-1", "count:16777217",
        "count:5x", "occluded:0", "occluded:1.01", "occluded:nan", "last:1",
        "last:0/4", "last:5/4", "last:1/256", "count:5,", ",count:5",
        "off,count:5", "many:5"}) {
    const auto R = parseTailRule(Text);
    ASSERT_FALSE(R) << Text;
    EXPECT_EQ(R.error().Code, ExitCode::Usage);
    EXPECT_NE(R.error().What.find("--pixel-unit"), std::string::npos);
  }
}

TEST(TailRule, ShareIsRoundedUp) {
  TailRule R;
  EXPECT_EQ(R.shareBits(), 0U);
  R.OccludedShare = 1;
  EXPECT_EQ(R.shareBits(), 65536U);
  R.OccludedShare = 0.5F;
  EXPECT_EQ(R.shareBits(), 32768U);
  R.OccludedShare = 1e-9F;
  EXPECT_EQ(R.shareBits(), 1U);
}

} // namespace
} // namespace vorion::splat
