#include "train/run/ClockSamples.h"

#include <gtest/gtest.h>
#include <set>

using namespace vorion::splat;

TEST(ClockSamples, OneOfEverySoMany) {
  std::set<unsigned> Places;
  for (unsigned Block = 0; Block < 200; ++Block) {
    unsigned Chosen = 0;
    for (unsigned I = 1; I <= 50; ++I)
      if (isTimed(3, 50, 50 * Block + I)) {
        ++Chosen;
        Places.insert(I);
      }
    EXPECT_EQ(Chosen, 1U) << Block;
  }
  // Chance leaves out each of the 50 places with 2 %.
  EXPECT_GT(Places.size(), 40U);
}

TEST(ClockSamples, AllOfEveryOne) {
  for (unsigned I = 1; I <= 10; ++I)
    EXPECT_TRUE(isTimed(0, 1, I));
}

TEST(ClockSamples, TakesNoIterationWithoutTime) {
  ClockSamples Samples;
  EXPECT_FALSE(Samples.add({1, 1, {}, {}}));
  EXPECT_TRUE(Samples.empty());
}

TEST(ClockSamples, SeedsDiffer) {
  unsigned Same = 0;
  for (unsigned I = 1; I <= 1000; ++I)
    Same += isTimed(1, 10, I) && isTimed(2, 10, I);
  EXPECT_LT(Same, 30U);
}
