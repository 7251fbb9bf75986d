/// A lock that is granted in the order of requests.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>

namespace vorion::splat {

/// For std::lock_guard. A std::mutex is not fair: one thread may acquire it
/// repeatedly while another waits.
class FairLock {
public:
  /// Waits for all earlier requests.
  void lock() {
    lockUnless([] { return false; });
  }
  /// The same, but polls \p GiveUp every few milliseconds. If it returns true,
  /// the request is cancelled: the lock is not held, and the result is false.
  bool lockUnless(const std::function<bool()> &GiveUp);
  void unlock();

private:
  std::mutex Lock;
  std::condition_variable Changed;
  uint64_t Last = 0;            ///< last issued ticket
  std::deque<uint64_t> Tickets; ///< the owner of the first ticket holds the
                                ///< lock
};

} // namespace vorion::splat
