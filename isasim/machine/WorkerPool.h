/// Host threads that share out numbered tasks.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace vorion::isasim {

class WorkerPool {
public:
  /// \p Threads in all, the caller's included, but no more than the host has
  /// processors (vorion/support/HostProcessors.h); 0 for as many as those.
  explicit WorkerPool(unsigned Threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool &) = delete;
  WorkerPool &operator=(const WorkerPool &) = delete;

  /// Calls Task(0) to Task(Count - 1), each once, on any thread, and returns
  /// when all have returned. With \p Short the caller does it alone: waking
  /// another thread costs some microseconds.
  void run(unsigned Count, bool Short,
           const std::function<void(unsigned)> &Task);

private:
  void work();
  void drain(const std::function<void(unsigned)> &Task, unsigned Count);

  std::mutex Lock;
  std::condition_variable Wake, Finished;
  const std::function<void(unsigned)> *Current = nullptr;
  unsigned CurrentCount = 0;
  std::atomic<unsigned> NextTask = 0;
  // Written with the lock held, read without it only to spin.
  std::atomic<unsigned> Busy = 0;       ///< workers in drain()
  std::atomic<uint64_t> Generation = 0; ///< of Current
  std::atomic<bool> Stopping = false;
  std::vector<std::thread> Workers;
};

} // namespace vorion::isasim
