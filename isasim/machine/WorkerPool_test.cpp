#include "machine/WorkerPool.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;

TEST(WorkerPool, SlowWorkersKeepTheirTask) {
  // A worker that is late with its task must not find it gone.
  WorkerPool Pool(4);
  for (unsigned Round = 0; Round != 300; ++Round) {
    std::atomic<unsigned> Ran = 0;
    Pool.run(4, false, [&](unsigned N) {
      if (N != 0)
        std::this_thread::yield();
      ++Ran;
    });
    ASSERT_EQ(Ran, 4U);
  }
}

TEST(WorkerPool, RunsEachTaskOnceEveryTime) {
  for (const unsigned Threads : {1U, 2U, 7U}) {
    WorkerPool Pool(Threads);
    for (unsigned Round = 0; Round != 2000; ++Round) {
      const unsigned Count = Round % 23;
      std::vector<std::atomic<unsigned>> Ran(Count);
      Pool.run(Count, Round % 5 == 0, [&](unsigned N) { ++Ran[N]; });
      for (const auto &Times : Ran)
        ASSERT_EQ(Times, 1U);
    }
  }
}
