/// Ctrl-C, for who waits in a call that another thread can end.
#pragma once

#include <functional>
#include <thread>

namespace vorion::splat {

/// While it lives, SIGINT and SIGTERM call \p OnSignal on a thread of its own,
/// once; the next one does what it does without this.
class Interrupt {
public:
  explicit Interrupt(std::function<void()> OnSignal);
  ~Interrupt();
  Interrupt(const Interrupt &) = delete;
  Interrupt &operator=(const Interrupt &) = delete;

private:
  std::thread Waiter;
};

} // namespace vorion::splat
