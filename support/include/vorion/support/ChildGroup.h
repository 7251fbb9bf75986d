/// Child processes that end with this one.
#pragma once

#include <atomic>
#include <sys/types.h>

namespace vorion {

/// During the lifetime of this object, endChildGroups() terminates the process
/// group of a child: the child and what it started. At most 512 at a time.
class ChildGroup {
public:
  explicit ChildGroup(pid_t Leader);
  ChildGroup(const ChildGroup &) = delete;
  ChildGroup &operator=(const ChildGroup &) = delete;
  ~ChildGroup();

private:
  std::atomic<pid_t> *Slot = nullptr;
};

/// Async-signal-safe.
void endChildGroups();

} // namespace vorion
