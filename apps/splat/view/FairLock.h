/// A lock that is given in the order in which it was asked for.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>

namespace vorion::splat {

/// For std::lock_guard. A std::mutex may give itself to the same thread again
/// and again while another waits.
class FairLock {
public:
  /// Waits behind everybody who waits already.
  void lock() {
    lockUnless([] { return false; });
  }
  /// The same, but \p GiveUp is asked every few milliseconds whether to leave
  /// the queue; the lock is then not held, and false returned.
  bool lockUnless(const std::function<bool()> &GiveUp);
  void unlock();

private:
  std::mutex Lock;
  std::condition_variable Changed;
  uint64_t Last = 0;            ///< ticket that was given
  std::deque<uint64_t> Tickets; ///< the first one's owner holds the lock
};

} // namespace vorion::splat
