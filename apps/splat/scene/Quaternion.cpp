#include "scene/Quaternion.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {

Quaternion quaternionOf(const std::array<std::array<double, 3>, 3> &R) {
  const double Squares[4] = {
      1 + R[0][0] + R[1][1] + R[2][2], 1 + R[0][0] - R[1][1] - R[2][2],
      1 - R[0][0] + R[1][1] - R[2][2], 1 - R[0][0] - R[1][1] + R[2][2]};
  const double *Largest = std::max_element(Squares, Squares + 4);
  const double S = 2 * std::sqrt(*Largest);
  switch (Largest - Squares) {
  case 0:
    return {S / 4, (R[2][1] - R[1][2]) / S, (R[0][2] - R[2][0]) / S,
            (R[1][0] - R[0][1]) / S};
  case 1:
    return {(R[2][1] - R[1][2]) / S, S / 4, (R[0][1] + R[1][0]) / S,
            (R[0][2] + R[2][0]) / S};
  case 2:
    return {(R[0][2] - R[2][0]) / S, (R[0][1] + R[1][0]) / S, S / 4,
            (R[1][2] + R[2][1]) / S};
  default:
    return {(R[1][0] - R[0][1]) / S, (R[0][2] + R[2][0]) / S,
            (R[1][2] + R[2][1]) / S, S / 4};
  }
}

} // namespace vorion::splat
