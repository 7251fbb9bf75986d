/// Clean-up when a process exits without calling destructors.
#pragma once

#include <string>
#include <utility>

namespace vorion {

/// During the lifetime of this object, removeAtEnd() removes a file or a folder
/// with its contents. Not inherited by a forked process. At most 64 at a time
/// are removed.
class RemovedAtEnd {
public:
  /// \p Path may be relative if the process never changes its folder.
  explicit RemovedAtEnd(const std::string &Path);
  RemovedAtEnd(RemovedAtEnd &&From) noexcept
      : Slot(std::exchange(From.Slot, -1)) {}
  RemovedAtEnd &operator=(RemovedAtEnd &&) = delete;
  ~RemovedAtEnd();

private:
  int Slot; ///< negative: of none
};

/// Async-signal-safe.
void removeAtEnd();

} // namespace vorion
