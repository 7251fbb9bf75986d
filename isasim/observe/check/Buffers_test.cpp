#include "observe/check/Buffers.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;

static Buffers two() {
  Buffers B;
  B.add(0x1000, 100, "buffer");
  B.add(0x2000, 0x100, "b");
  B.rename(0x1000, "a");
  return B;
}

TEST(Buffers, FindsWhatLiesInside) {
  const Buffers B = two();
  EXPECT_EQ(B.find(0x1000, 100)->Name, "a");
  EXPECT_EQ(B.find(0x1063, 1)->Name, "a");
  EXPECT_EQ(B.find(0x1063, 2), nullptr);
  EXPECT_EQ(B.find(0xFFF, 1), nullptr);
  EXPECT_EQ(B.find(0x20FC, 4)->Name, "b");
  EXPECT_EQ(B.find(0x2100, 1), nullptr);
}

TEST(Buffers, DescribesFromTheNearest) {
  Buffers B = two();
  EXPECT_EQ(B.describe(0x1010), "16 bytes into a (100 bytes at 0x00001000)");
  EXPECT_EQ(B.describe(0x1064),
            "0 bytes past the end of a (100 bytes at 0x00001000)");
  EXPECT_EQ(B.describe(0x1FF0), "16 bytes before b (256 bytes at 0x00002000)");
  EXPECT_EQ(B.describe(0x0FFF), "1 byte before a (100 bytes at 0x00001000)");
  EXPECT_EQ(B.describe(0x9000),
            "28416 bytes past the end of b (256 bytes at 0x00002000)");
  B.remove(0x1000);
  B.remove(0x2000);
  EXPECT_EQ(B.describe(0x1000), "unallocated memory");
}
