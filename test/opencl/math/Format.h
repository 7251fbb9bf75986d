/// The formats of numbers that kernels compute with.
#pragma once

#include <limits>

namespace vorion::test {

/// What std::numeric_limits says; the host's library knows nothing of halves.
template <typename Real> struct Format : std::numeric_limits<Real> {};

template <> struct Format<_Float16> {
  static constexpr int digits = 11, min_exponent = -13, max_exponent = 16;
  static constexpr _Float16 min() { return 0x1p-14F16; }
  static constexpr _Float16 max() { return 65504.0F16; }
  static constexpr _Float16 denorm_min() { return 0x1p-24F16; }
  static constexpr _Float16 infinity() {
    return static_cast<_Float16>(std::numeric_limits<float>::infinity());
  }
  static constexpr _Float16 quiet_NaN() {
    return static_cast<_Float16>(std::numeric_limits<float>::quiet_NaN());
  }
};

} // namespace vorion::test
