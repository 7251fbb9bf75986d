#include "machine/WorkerPool.h"

#include "vorion/support/HostProcessors.h"

#include <algorithm>
#include <chrono>

namespace vorion::isasim {

namespace {

/// About as long as the cores of one round differ (half a millisecond of work
/// between them). Sleeping and waking took 50 us and more of each round, a
/// sixth of it on two processors.
constexpr std::chrono::microseconds LongestSpin{200};

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Waits a little for \p Condition without sleeping.
template <typename Function> void spin(Function Condition) {
  const auto End = std::chrono::steady_clock::now() + LongestSpin;
  while (!Condition() && std::chrono::steady_clock::now() < End)
    for (int N = 0; N != 16; ++N)
      pause();
}

} // namespace

WorkerPool::WorkerPool(unsigned Threads) {
  // More threads than processors must sleep and be woken in each round. On 10
  // processors 16 such threads took five times as long as 8 threads.
  const unsigned Processors = hostProcessors();
  const unsigned Wanted = Threads ? std::min(Threads, Processors) : Processors;
  for (unsigned N = 1; N < Wanted; ++N)
    Workers.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard Guard(Lock);
    Stopping = true;
  }
  Wake.notify_all();
  for (std::thread &T : Workers)
    T.join();
}

void WorkerPool::drain(const std::function<void(unsigned)> &Task,
                       unsigned Count) {
  for (;;) {
    const unsigned N = NextTask.fetch_add(1, std::memory_order_relaxed);
    if (N >= Count)
      return;
    Task(N);
  }
}

void WorkerPool::work() {
  uint64_t Seen = 0;
  std::unique_lock Guard(Lock);
  for (;;) {
    Guard.unlock();
    spin([&] { return Stopping || Generation != Seen; });
    Guard.lock();
    Wake.wait(Guard,
              [&] { return Stopping || (Current && Generation != Seen); });
    if (Stopping)
      return;
    Seen = Generation;
    ++Busy;
    // Held here: run() forgets the task as soon as there is none left to take,
    // and then waits for those that are busy with theirs.
    const std::function<void(unsigned)> &Task = *Current;
    const unsigned Count = CurrentCount;
    Guard.unlock();
    drain(Task, Count);
    Guard.lock();
    if (--Busy == 0)
      Finished.notify_one();
  }
}

void WorkerPool::run(unsigned Count, bool Short,
                     const std::function<void(unsigned)> &Task) {
  if (Short || Workers.empty() || Count <= 1) {
    for (unsigned N = 0; N != Count; ++N)
      Task(N);
    return;
  }
  {
    const std::lock_guard Guard(Lock);
    Current = &Task;
    CurrentCount = Count;
    NextTask.store(0, std::memory_order_relaxed);
    ++Generation;
  }
  Wake.notify_all();
  drain(Task, Count);
  {
    // A worker that has not woken yet finds no task.
    const std::lock_guard Guard(Lock);
    Current = nullptr;
  }
  spin([&] { return Busy == 0; });
  std::unique_lock Guard(Lock);
  Finished.wait(Guard, [&] { return Busy == 0; });
}

} // namespace vorion::isasim
