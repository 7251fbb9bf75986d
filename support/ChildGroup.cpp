#include "vorion/support/ChildGroup.h"

#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>

namespace vorion {
namespace {

// The handler of a signal may take no memory and no lock.
std::array<std::atomic<pid_t>, 512> Groups;
static_assert(std::atomic<pid_t>::is_always_lock_free);

} // namespace

ChildGroup::ChildGroup(pid_t Leader) {
  for (std::atomic<pid_t> &Group : Groups)
    if (pid_t None = 0; Group.compare_exchange_strong(None, Leader)) {
      Slot = &Group;
      return;
    }
}

ChildGroup::~ChildGroup() {
  if (Slot)
    *Slot = 0;
}

void endChildGroups() {
  for (const std::atomic<pid_t> &Group : Groups)
    if (const pid_t Leader = Group)
      ::kill(-Leader, SIGTERM);
}

} // namespace vorion
