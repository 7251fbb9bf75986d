/// Front ends whose primitives are opaque (docs/primitives.md): which pixels of
/// a tile a primitive covers, and at which depth. A kind is a body; whoever
/// draws asks it for nothing else.
#pragma once

#include "raster/CommandInput.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace vorion::raster {

/// First and last columns and rows, both ends included, in the picture.
struct PixelBox {
  unsigned FirstX, FirstY, LastX, LastY;
};

/// \p Pixel: column, and row times 2^16.
constexpr unsigned columnOf(uint32_t Pixel) { return Pixel & 0xFFFF; }
constexpr unsigned rowOf(uint32_t Pixel) { return Pixel >> 16; }

/// The body of the front end with number \p Primitive.
template <uint32_t Primitive> struct SurfaceBody;

template <> struct SurfaceBody<VR_PRIMITIVE_TRIANGLE> {
  using Record = Triangle;

  static PixelBox box(const Triangle &T) {
    return {columnOf(T.First), rowOf(T.First), columnOf(T.Last), rowOf(T.Last)};
  }

  /// \p T as the lanes of a tile see it whose first pixel is \p X, \p Y.
  SurfaceBody(const Triangle &T, unsigned X, unsigned Y)
      : A(std::to_array(T.A)), B(std::to_array(T.B)), StepX(T.DepthStep[0]),
        StepY(T.DepthStep[1]) {
    for (unsigned Edge = 0; Edge != 3; ++Edge) {
      const uint64_t Steps =
          static_cast<uint64_t>(int64_t{A[Edge]} * X + int64_t{B[Edge]} * Y);
      const uint64_t C = T.CLow[Edge] | static_cast<uint64_t>(T.CHigh[Edge])
                                            << 32;
      Corner[Edge] = std::clamp(static_cast<int64_t>(C + Steps), -Limit, Limit);
    }
    const PixelBox Box = box(T);
    Depth = (T.Depth + StepX * distance(Box.FirstX, X)) +
            StepY * distance(Box.FirstY, Y);
  }

  /// Whether pixel \p X, \p Y of the tile is covered.
  bool covers(unsigned X, unsigned Y) const {
    int64_t Signs = 0;
    for (unsigned Edge = 0; Edge != 3; ++Edge)
      Signs |= Corner[Edge] + int64_t{A[Edge]} * X + int64_t{B[Edge]} * Y;
    return Signs >= 0;
  }
  float depth(unsigned X, unsigned Y) const {
    return (Depth + StepX * static_cast<float>(X)) +
           StepY * static_cast<float>(Y);
  }

private:
  /// Within a tile an edge function changes by less: where it is farther from
  /// 0 at the tile's corner, its sign is the same in all of the tile. So lanes
  /// add 40 bits (docs/primitives.md).
  static constexpr int64_t Limit = int64_t{1} << 38;

  static float distance(unsigned From, unsigned To) {
    return static_cast<float>(static_cast<int>(To) - static_cast<int>(From));
  }

  std::array<int32_t, 3> A, B;
  std::array<int64_t, 3> Corner{};
  float Depth = 0, StepX, StepY;
};

inline uint32_t checkRecord(const Triangle &T) {
  return checkFloats(std::array{T.Depth, T.DepthStep[0], T.DepthStep[1]});
}

/// Whether a fragment of depth \p New passes in front of \p Stored, by
/// \p Function of VR_WORD_DEPTH, 0 to 7: a sum of 1 for less, 2 for equal and 4
/// for greater. A NaN is neither: it passes 5 and 7, as "not equal" and
/// "always".
constexpr bool passesDepth(unsigned Function, float New, float Stored) {
  constexpr unsigned NotEqual = 5, Always = 7;
  if (New < Stored)
    return Function & 1;
  if (New == Stored)
    return Function & 2;
  if (New > Stored)
    return Function & 4;
  return Function == NotEqual || Function == Always;
}

/// The pixel buffer with two words a pixel.
struct SurfaceBuffer {
  static constexpr unsigned Stride = VR_MAX_TILE;
  std::array<Visibility, Stride * VR_MAX_TILE> Pixels;
};

} // namespace vorion::raster
