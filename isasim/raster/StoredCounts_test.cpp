// The counts of its own work that a command stores in memory.
#include "raster/RasterTest.h"

#include <utility>

namespace vorion::raster {
namespace {

/// With mode "keep_counts": a place for two words, and no place.
class CountsTest : public RasterTest {
protected:
  static constexpr uint32_t Counts = Pixels + 0x100000;
  static constexpr uint32_t Untouched = 0x55555555;
  using Words = std::vector<uint32_t>;

  /// The tile of \p Scene, whose command ends with \p Status; the words around
  /// and at Counts.
  Words countsOf(std::span<const Gaussian> Scene, uint32_t Mode,
                 uint32_t Status = VR_OK) {
    Memory.put<uint32_t>(Counts - 4, Words(4, Untouched));
    configure(Scene, {.Mode = Mode, .Width = 16, .Height = 16});
    set(Csr::Last, Counts);
    EXPECT_EQ(start(), Status);
    return Memory.get<uint32_t>(Counts - 4, 4);
  }
};

TEST_F(CountsTest, ARenderStoresItsGaussiansAndFragments) {
  const Gaussian Scene[] = {flatGaussian(8, 8, 2, 2, 0.5F),
                            flatGaussian(8, 8, 4, 4, 0.5F),
                            flatGaussian(100, 8, 4, 4, 0.5F)};
  EXPECT_EQ(countsOf(Scene, ModeKeepCounts.put(1)),
            (Words{Untouched, 3, 16 + 64, Untouched}));
  EXPECT_EQ(countsOf({}, ModeKeepCounts.put(1)),
            (Words{Untouched, 0, 0, Untouched}));
  EXPECT_EQ(countsOf(Scene, 0), Words(4, Untouched)) << "not asked for";
}

TEST_F(CountsTest, WhatAClosedTileLeavesOutDoesNotCount) {
  const std::vector<Gaussian> Scene(9, flatGaussian(8, 8, 100, 100, 0.99F));
  EXPECT_EQ(countsOf(Scene, ModeKeepCounts.put(1)),
            (Words{Untouched, 2, 2 * 256, Untouched}));
}

TEST_F(CountsTest, TheyAreOfThisCommandAlone) {
  const Gaussian G = flatGaussian(8, 8, 2, 2, 0.5F);
  EXPECT_EQ(countsOf(only(G), ModeKeepCounts.put(1)),
            countsOf(only(G), ModeKeepCounts.put(1)));
}

TEST_F(CountsTest, ACommandThatFailsStoresNone) {
  const Gaussian G = flatGaussian(NotANumber, 8, 2, 2, 0.5F);
  EXPECT_EQ(countsOf(only(G), ModeKeepCounts.put(1), VR_NAN),
            Words(4, Untouched));
}

TEST_F(CountsTest, ItsModeAndAddressAreChecked) {
  const Gaussian G = flatGaussian(8, 8, 2, 2, 0.5F);
  for (const uint32_t Other : {ModeKeepLast.put(1), ModeBackward.put(1)})
    countsOf(only(G), ModeKeepCounts.put(1) | Other, VR_BAD_MODE);
  configure(only(G), {.Mode = ModeKeepCounts.put(1)});
  const uint32_t End = TestMemory::Base + (8 << 20);
  for (const auto &[Address, Status] : {std::pair{Counts + 4, VR_MISALIGNED},
                                        {End, VR_UNMAPPED},
                                        {0xffff0000U, VR_UNMAPPED},
                                        {End - 8, VR_OK}}) {
    set(Csr::Last, Address);
    EXPECT_EQ(start(), Status) << Address;
  }
}

} // namespace
} // namespace vorion::raster
