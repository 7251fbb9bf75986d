#include "vorion/support/Parallel.h"

#include <atomic>
#include <gtest/gtest.h>
#include <new>
#include <vector>

using namespace vorion;

namespace {

TEST(Parallel, CallsOnceForEachNumber) {
  std::vector<std::atomic<int>> Calls(1000);
  inParallel(Calls.size(), [&](std::size_t I) { ++Calls[I]; });
  for (const auto &Count : Calls)
    EXPECT_EQ(Count, 1);
}

TEST(Parallel, PartsCoverEveryNumberOnce) {
  std::vector<int> Calls(1001);
  inParallelParts(Calls.size(), 64, [&](std::size_t First, std::size_t End) {
    EXPECT_LE(End - First, 64U);
    for (std::size_t I = First; I < End; ++I)
      ++Calls[I];
  });
  EXPECT_EQ(Calls, std::vector<int>(1001, 1));
}

TEST(Parallel, DoesNothingForNothing) {
  inParallel(0, [](std::size_t) { FAIL(); });
}

// A thread's memory that does not suffice must end in the tool's own message.
TEST(Parallel, HandsOnWhatIsThrown) {
  for (const std::size_t Bad : {0, 1, 999})
    EXPECT_THROW(inParallel(1000,
                            [&](std::size_t I) {
                              if (I == Bad)
                                throw std::bad_alloc();
                            }),
                 std::bad_alloc);
  EXPECT_THROW(inParallel(1000, [](std::size_t) { throw std::bad_alloc(); }),
               std::bad_alloc);
}

} // namespace
