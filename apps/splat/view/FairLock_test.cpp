#include "view/FairLock.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>
#include <utility>
#include <vector>

using namespace vorion::splat;

namespace {

TEST(FairLock, IsGivenInTheOrderInWhichItWasAskedFor) {
  FairLock Lock;
  std::vector<int> Order;
  std::vector<std::thread> Threads;
  Lock.lock();
  for (int I = 0; I != 8; ++I) {
    std::atomic<bool> Waits = false;
    Threads.emplace_back([&, I] {
      // It is asked once the thread waits.
      Lock.lockUnless([&Waits, Known = false]() mutable {
        if (!std::exchange(Known, true))
          Waits = true;
        return false;
      });
      Order.push_back(I);
      Lock.unlock();
    });
    while (!Waits)
      std::this_thread::yield();
  }
  Lock.unlock();
  for (std::thread &T : Threads)
    T.join();
  EXPECT_EQ(Order, (std::vector{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(FairLock, WhoGivesUpLeavesTheQueue) {
  FairLock Lock;
  Lock.lock();
  std::thread Waiting(
      [&] { EXPECT_FALSE(Lock.lockUnless([] { return true; })); });
  Waiting.join();
  Lock.unlock();
  EXPECT_TRUE(Lock.lockUnless([] { return true; })) << "nobody holds it";
  Lock.unlock();
}

} // namespace
