#include "view/FairLock.h"

#include <chrono>

namespace vorion::splat {

bool FairLock::lockUnless(const std::function<bool()> &GiveUp) {
  constexpr std::chrono::milliseconds AskAgain{10};
  std::unique_lock Held(Lock);
  const uint64_t Own = ++Last;
  Tickets.push_back(Own);
  while (
      !Changed.wait_for(Held, AskAgain, [&] { return Tickets.front() == Own; }))
    if (GiveUp()) {
      std::erase(Tickets, Own);
      return false;
    }
  return true;
}

void FairLock::unlock() {
  const std::lock_guard Held(Lock);
  Tickets.pop_front();
  Changed.notify_all();
}

} // namespace vorion::splat
