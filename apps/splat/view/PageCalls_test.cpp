#include "view/PageCalls.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

TEST(PageCalls, ANewerCallOfThePageTakesThePlaceOfAnOlderOne) {
  PageCalls Calls;
  const auto First = Calls.begin("a");
  EXPECT_TRUE(First.isNewest());
  const auto Second = Calls.begin("a");
  EXPECT_FALSE(First.isNewest());
  EXPECT_TRUE(Second.isNewest());
}

TEST(PageCalls, PagesDoNotHinderEachOther) {
  PageCalls Calls;
  const auto First = Calls.begin("a");
  for (int I = 0; I != 100; ++I)
    Calls.begin("b");
  EXPECT_TRUE(First.isNewest());
}

TEST(PageCalls, ThePagesOfOldCallsAreForgotten) {
  PageCalls Calls;
  Calls.begin("a");
  const auto Again = Calls.begin("a");
  EXPECT_TRUE(Again.isNewest());
}

} // namespace
