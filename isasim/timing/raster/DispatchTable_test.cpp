#include "timing/raster/DispatchTable.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;

namespace {

TEST(DispatchTable, BanksDecideHowRowsPack) {
  const RasterTiming Default = TimingConfig().Raster;
  DispatchTable Table(Default);
  EXPECT_EQ(Table.cycles(1, 1), 1U);
  // Four rows of four, 4 banks apart, have 16 different banks.
  EXPECT_EQ(Table.cycles(4, 4), 1U);
  // The fifth row's first pixel has the bank of the first row's: 4 rows a
  // cycle.
  EXPECT_EQ(Table.cycles(4, 8), 2U);
  // In columns, banks repeat after 4 rows.
  EXPECT_EQ(Table.cycles(1, 64), 16U);
  // 5 pixels and the next row's first, 4 on: a conflict at once.
  EXPECT_EQ(Table.cycles(5, 10), 10U);
  RasterTiming Unstaggered = Default;
  Unstaggered.Stagger = 0;
  EXPECT_EQ(DispatchTable(Unstaggered).cycles(4, 4), 4U);
  // Never fewer than the lanes allow.
  for (unsigned W = 1; W <= 64; ++W)
    for (unsigned H = 1; H <= 64; ++H)
      ASSERT_GE(Table.cycles(W, H), (W * H + 15) / 16);
}

} // namespace
