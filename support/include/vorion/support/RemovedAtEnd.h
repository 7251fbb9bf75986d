/// What is to go where a process ends without calling destructors.
#pragma once

#include <string>
#include <utility>

namespace vorion {

/// While this lives, removeAtEnd() removes a file, or a folder with all that is
/// in it. A copy of the process (fork) holds nothing. Of more than 64 at a
/// time, the others stay.
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

/// A signal's handler may call it.
void removeAtEnd();

} // namespace vorion
