#include "Allocator.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <rapidcheck/gtest.h>
#include <vector>

using vorion::runtime::Allocator;

namespace {

TEST(Allocator, RoundsItsRangeInwards) {
  Allocator A(1, 3 * Allocator::Alignment);
  EXPECT_EQ(A.freeBytes(), 2 * Allocator::Alignment);
  EXPECT_EQ(A.allocate(1), Allocator::Alignment);
}

TEST(Allocator, ARangeTooSmallHoldsNothing) {
  Allocator A(1, 100);
  EXPECT_EQ(A.freeBytes(), 0u);
  EXPECT_FALSE(A.allocate(0));
}

TEST(Allocator, SizeZeroGivesDistinctAddresses) {
  Allocator A(0, 1024);
  EXPECT_NE(A.allocate(0), A.allocate(0));
}

TEST(Allocator, TheEndsDoNotMeet) {
  Allocator A(0, 4096);
  EXPECT_EQ(A.allocate(100, Allocator::End::High), 3968u);
  EXPECT_EQ(A.allocate(100), 0u);
  EXPECT_EQ(A.allocate(1000, Allocator::End::High), 2944u);
  EXPECT_TRUE(A.release(3968));
  EXPECT_EQ(A.allocate(128, Allocator::End::High), 3968u);
  // Where only the other end's place has room, it is taken.
  EXPECT_EQ(A.allocate(2816, Allocator::End::High), 128u);
  EXPECT_EQ(A.freeBytes(), 0u);
}

TEST(Allocator, LooksOnlyBelowALimit) {
  Allocator A(0x1000, 0x1000);
  A.add(0x8000, 0x1000);
  EXPECT_EQ(A.allocate(128, Allocator::End::High), 0x8f80u);
  EXPECT_EQ(A.allocate(128, Allocator::End::High, 0x8000), 0x1f80u);
  EXPECT_EQ(A.allocate(0x1000, Allocator::End::High, 0x8000), std::nullopt);
  EXPECT_EQ(A.freeBytes(), 0x2000u - 2 * 128);
}

TEST(Allocator, TwoRangesAreNotOne) {
  Allocator A(0, 1024);
  A.add(4096, 2048);
  EXPECT_EQ(A.freeBytes(), 3072u);
  EXPECT_EQ(A.largestFree(), 2048u);
  EXPECT_FALSE(A.allocate(3072));
  EXPECT_EQ(A.allocate(2048), 4096u);
  EXPECT_EQ(A.allocate(1024), 0u);
  EXPECT_FALSE(A.allocate(1));
  EXPECT_TRUE(A.release(4096));
  EXPECT_TRUE(A.release(0));
  EXPECT_EQ(A.largestFree(), 2048u);
}

TEST(Allocator, HugeSizesAreRefused) {
  Allocator A(0x10000, 1 << 20);
  EXPECT_FALSE(A.allocate(UINT64_MAX));
  EXPECT_FALSE(A.allocate((1 << 20) + 1));
  EXPECT_TRUE(A.allocate(1 << 20));
  EXPECT_FALSE(A.allocate(1));
}

TEST(Allocator, ReleasingTwiceOrInsideABlockIsRefused) {
  Allocator A(0, 1 << 16);
  const auto Address = A.allocate(1000);
  ASSERT_TRUE(Address);
  EXPECT_FALSE(A.release(*Address + Allocator::Alignment));
  EXPECT_TRUE(A.release(*Address));
  EXPECT_FALSE(A.release(*Address));
}

// Any sequence of allocations and releases: blocks are aligned, inside, and
// disjoint; the bytes add up; a request fails only if no free range holds it;
// and when all are released one range is left.
RC_GTEST_PROP(Allocator, KeepsItsBooks, (const std::vector<uint16_t> &Steps)) {
  constexpr uint64_t Base = 0x10000, Size = 1 << 18;
  Allocator A(Base, Size);
  std::map<uint64_t, uint64_t> Held;
  uint64_t HeldBytes = 0;
  for (const uint16_t Step : Steps) {
    if (Step % 3 == 0 && !Held.empty()) {
      const auto Block = std::next(Held.begin(), Step % Held.size());
      RC_ASSERT(A.release(Block->first));
      HeldBytes -= Block->second;
      Held.erase(Block);
    } else {
      const uint64_t Largest = A.largestFree();
      const auto Address = A.allocate(Step, Step % 5 ? Allocator::End::Low
                                                     : Allocator::End::High);
      RC_ASSERT(Address.has_value() ==
                (Largest >= std::max<uint64_t>(Step, 1)));
      if (!Address)
        continue;
      const uint64_t Length =
          std::max<uint64_t>(1, (Step + 127u) / 128u) * 128u;
      RC_ASSERT(*Address % Allocator::Alignment == 0u);
      RC_ASSERT(*Address >= Base);
      RC_ASSERT(*Address + Length <= Base + Size);
      const auto After = Held.lower_bound(*Address);
      // RC_ASSERT evaluates both sides of ||, so the ends are tested before.
      if (After != Held.end())
        RC_ASSERT(*Address + Length <= After->first);
      if (After != Held.begin()) {
        const auto Before = std::prev(After);
        RC_ASSERT(Before->first + Before->second <= *Address);
      }
      Held[*Address] = Length;
      HeldBytes += Length;
    }
    RC_ASSERT(A.freeBytes() == Size - HeldBytes);
  }
  for (const auto &[Address, Length] : Held)
    RC_ASSERT(A.release(Address));
  RC_ASSERT(A.largestFree() == Size);
}

} // namespace
