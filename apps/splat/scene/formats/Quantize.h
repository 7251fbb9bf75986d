/// Common functions of writers of compressed formats; inverse of Dequantize.h.
#pragma once

#include "scene/Scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vorion::splat {

template <typename T> void put(std::string &Out, T Value) {
  Out.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
}

/// Appends \p Value, clamped and truncated to an integer from 0 to 255.
inline void putByte(std::string &Out, double Value) {
  Out += static_cast<char>(static_cast<uint8_t>(std::clamp(Value, 0.0, 255.0)));
}

inline double opacityOf(const Scene &S, std::size_t I) {
  return 1 / (1 + std::exp(-double(S.OpacityLogits[I])));
}

struct Range {
  double Low, High;
};

inline Range rangeOf(const std::vector<double> &Values) {
  const auto [Low, High] = std::minmax_element(Values.begin(), Values.end());
  return {*Low, *High};
}

/// The nearest of the steps of \p Bits bits that divide \p R evenly.
inline uint32_t stepOf(double Value, Range R, int Bits) {
  const double Largest = std::ldexp(1.0, Bits) - 1;
  const double T = R.High > R.Low ? (Value - R.Low) / (R.High - R.Low) : 0;
  return static_cast<uint32_t>(
      std::clamp(std::floor(T * Largest + 0.5), 0.0, Largest));
}

/// The order of a quaternion's components in a format.
using QuatOrder = std::array<std::size_t, 4>;
inline constexpr QuatOrder Wxyz = {0, 1, 2, 3}, Xyzw = {1, 2, 3, 0};

/// The normalized quaternion of a Gaussian with a positive largest component;
/// the identity for a zero quaternion.
struct UnitQuat {
  std::array<double, 4> Q{};
  std::size_t Largest = 0;

  UnitQuat(const Scene &S, std::size_t I, const QuatOrder &Order) {
    double Squares = 0;
    for (std::size_t K = 0; K < 4; ++K) {
      Q[K] = S.Quats[4 * I + Order[K]];
      Squares += Q[K] * Q[K];
      if (std::abs(Q[K]) > std::abs(Q[Largest]))
        Largest = K;
    }
    if (Squares == 0) {
      Largest = static_cast<std::size_t>(
          std::find(Order.begin(), Order.end(), 0) - Order.begin());
      Q[Largest] = Squares = 1;
    }
    const double Scale = (Q[Largest] < 0 ? -1 : 1) / std::sqrt(Squares);
    for (double &V : Q)
      V *= Scale;
  }

  /// The components that are not the largest, in order.
  std::array<double, 3> others() const {
    std::array<double, 3> Result{};
    for (std::size_t K = 0, Next = 0; K < 4; ++K)
      if (K != Largest)
        Result[Next++] = Q[K];
    return Result;
  }
};

} // namespace vorion::splat
