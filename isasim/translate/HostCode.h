/// Memory for code that is made at run time, never writable and executable at
/// once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace vorion::isasim::translate {

class HostCode {
public:
  /// Room for \p Bytes, of which the host commits what is written. Without
  /// address space there is no room.
  explicit HostCode(size_t Bytes);
  ~HostCode();
  HostCode(const HostCode &) = delete;
  HostCode &operator=(const HostCode &) = delete;

  /// Copies \p Code here and makes it executable; nullptr if it does not fit.
  std::byte *add(std::span<const uint8_t> Code);

  /// What is in use.
  size_t bytes() const { return Used; }

private:
  std::byte *Base = nullptr;
  size_t All = 0, Used = 0;
};

} // namespace vorion::isasim::translate
