/// File descriptors, for those files alone that read and write whole files.
#pragma once

#include <cerrno>
#include <cstddef>
#include <unistd.h>
#include <utility>

namespace vorion {

/// An open file, closed at the end of its scope. A negative number is none.
class Descriptor {
public:
  explicit Descriptor(int NumberIn) : Number(NumberIn) {}
  Descriptor(Descriptor &&From) noexcept
      : Number(std::exchange(From.Number, -1)) {}
  Descriptor &operator=(Descriptor &&) = delete;
  ~Descriptor() { close(); }

  int number() const { return Number; }
  /// Some file systems say only here that they have no room. False leaves
  /// errno; the number is free again in any case.
  bool close() {
    const int Had = std::exchange(Number, -1);
    return Had < 0 || ::close(Had) == 0 || errno == EINTR;
  }

private:
  int Number;
};

/// Writes all \p Size bytes; false leaves errno.
inline bool writeAll(int To, const void *Data, std::size_t Size) {
  const auto *From = static_cast<const char *>(Data);
  while (Size > 0) {
    const ssize_t Wrote = ::write(To, From, Size);
    if (Wrote < 0 && errno == EINTR)
      continue;
    if (Wrote < 0)
      return false;
    From += Wrote;
    Size -= static_cast<std::size_t>(Wrote);
  }
  return true;
}

} // namespace vorion
