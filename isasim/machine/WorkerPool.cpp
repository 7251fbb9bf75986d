#include "machine/WorkerPool.h"

#include <algorithm>

namespace vorion::isasim {

WorkerPool::WorkerPool(unsigned Threads) {
  const unsigned Wanted =
      Threads ? Threads : std::max(1U, std::thread::hardware_concurrency());
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
  std::unique_lock Guard(Lock);
  // A worker that has not woken yet finds no task.
  Current = nullptr;
  Finished.wait(Guard, [&] { return Busy == 0; });
}

} // namespace vorion::isasim
