#include "observe/check/ShadowBits.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;

TEST(ShadowBits, RangesAcrossPages) {
  ShadowBits B;
  EXPECT_FALSE(B.all(0x1000, 4));
  B.set(0x0FFE, 0x2004, true); // the end of a page, two pages, two bytes
  EXPECT_FALSE(B.all(0x0FFD, 1));
  EXPECT_TRUE(B.all(0x0FFE, 2));
  EXPECT_TRUE(B.all(0x1FFC, 4));
  EXPECT_TRUE(B.all(0x3000, 2));
  EXPECT_FALSE(B.all(0x3000, 4));
  B.set(0x1000, 0x1000, false);
  EXPECT_FALSE(B.all(0x1FFC, 1));
  EXPECT_TRUE(B.all(0x2000, 4));
  B.clear();
  EXPECT_FALSE(B.all(0x2000, 1));
}

TEST(ShadowBits, UpToTheLastAddress) {
  ShadowBits B;
  B.set(0xFFFFF000, 0x1000, true);
  EXPECT_TRUE(B.all(0xFFFFFFFC, 4));
}
