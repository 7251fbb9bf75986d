#include "train/Settings.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

TEST(Settings, PositionsSlowDownExponentially) {
  const TrainSettings S;
  EXPECT_NEAR(positionRate(S, 0), 1.6e-4, 1e-12);
  EXPECT_NEAR(positionRate(S, 15000), 1.6e-5, 1e-13);
  EXPECT_NEAR(positionRate(S, 30000), 1.6e-6, 1e-14);
  EXPECT_NEAR(positionRate(S, 50000), 1.6e-6, 1e-14);
}

TEST(Settings, BandsComeOneAfterTheOther) {
  const TrainSettings S;
  EXPECT_EQ(shDegreeAt(S, 999, 3), 0);
  EXPECT_EQ(shDegreeAt(S, 1000, 3), 1);
  EXPECT_EQ(shDegreeAt(S, 9000, 3), 3);
  EXPECT_EQ(shDegreeAt(S, 9000, 1), 1);
}

TEST(Settings, DensityChangesAtItsTimes) {
  const TrainSettings S;
  EXPECT_FALSE(densifiesAt(S, 500));
  EXPECT_TRUE(densifiesAt(S, 600));
  EXPECT_FALSE(densifiesAt(S, 650));
  EXPECT_TRUE(densifiesAt(S, 14900));
  EXPECT_FALSE(densifiesAt(S, 15000));
  EXPECT_TRUE(notesAt(S, 14999));
  EXPECT_FALSE(notesAt(S, 15000));
  EXPECT_TRUE(resetsAt(S, 3000, false));
  EXPECT_FALSE(resetsAt(S, 500, false));
  EXPECT_TRUE(resetsAt(S, 500, true));
  EXPECT_FALSE(resetsAt(S, 15000, true));
  EXPECT_FALSE(dropsLargeAt(S, 3000));
  EXPECT_TRUE(dropsLargeAt(S, 3100));
}

} // namespace
