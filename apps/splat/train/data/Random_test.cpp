#include "train/data/Philox.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

std::array<uint32_t, 4> words(const philox_words &W) {
  return {W.word[0], W.word[1], W.word[2], W.word[3]};
}

/// The known answers that its authors published with it.
TEST(Philox, GivesItsKnownAnswers) {
  EXPECT_EQ(words(philox(0, 0, 0, 0, 0, 0)),
            (std::array<uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c,
                                     0x9b00dbd8}));
  EXPECT_EQ(words(philox(~0U, ~0U, ~0U, ~0U, ~0U, ~0U)),
            (std::array<uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6,
                                     0x6d5451fd}));
  EXPECT_EQ(words(philox(0xa4093822, 0x299f31d0, 0x243f6a88, 0x85a308d3,
                         0x13198a2e, 0x03707344)),
            (std::array<uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420,
                                     0x24126ea1}));
}

TEST(Philox, UnitIsNeverZeroOrOne) {
  EXPECT_GT(philox_unit(0), 0.0F);
  EXPECT_LT(philox_unit(~0U), 1.0F);
  EXPECT_NEAR(philox_unit(0x80000000U), 0.5, 1e-6);
}

} // namespace
