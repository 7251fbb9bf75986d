/// Common functions of readers of compressed formats. Everything is computed in
/// double and rounded once.
#pragma once

#include "scene/Activation.h"
#include "scene/Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace vorion::splat {

/// The low \p Bits of \p Value as a number from 0 to 1.
inline double unorm(uint32_t Value, int Bits) {
  const uint32_t Largest = (uint32_t(1) << Bits) - 1;
  return static_cast<double>(Value & Largest) / Largest;
}

inline double lerp(double A, double B, double T) { return A * (1 - T) + B * T; }

/// The SH coefficient of degree 0 for the constant colour \p Color.
inline float shOfColor(double Color) {
  return static_cast<float>((Color - 0.5) / ShC0);
}

/// The logits of opacities that are stored in a byte, 0 to 255.
inline const std::array<float, 256> &byteOpacityLogits() {
  static const std::array<float, 256> Table = [] {
    std::array<float, 256> T{};
    for (std::size_t I = 0; I < T.size(); ++I)
      T[I] = opacityLogit(static_cast<double>(I) / 255);
    return T;
  }();
  return Table;
}

/// A unit quaternion from three of its components: the fourth, number
/// \p Missing of the order in which \p Others skip it, is the positive root.
inline std::array<double, 4> completeQuat(std::size_t Missing,
                                          const std::array<double, 3> &Others) {
  std::array<double, 4> Q{};
  double Squares = 0;
  for (std::size_t I = 0, Next = 0; I < 4; ++I)
    if (I != Missing) {
      Q[I] = Others[Next++];
      Squares += Q[I] * Q[I];
    }
  // Three quantised components can exceed unit length.
  Q[Missing] = std::sqrt(std::max(0.0, 1 - Squares));
  return Q;
}

} // namespace vorion::splat
