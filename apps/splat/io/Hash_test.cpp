#include "Hash.h"

#include <gtest/gtest.h>

namespace vorion::splat {
namespace {

// The values of the function's own specification.
TEST(Hash, GivesThePublishedValues) {
  EXPECT_EQ(fnv1a64(""), "cbf29ce484222325");
  EXPECT_EQ(fnv1a64("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(fnv1a64("foobar"), "85944171f73967e8");
}

TEST(Hash, OfAMissingFileIsAnError) {
  EXPECT_FALSE(hashFile("/nonexistent-folder/x"));
}

} // namespace
} // namespace vorion::splat
