/// What the tests of loads and stores, of atomics and of stacks share.
#pragma once

#include "testing/WarpRunner.h"

#include <cstring>

namespace vorion::isasim::testing {

/// Where tests access global memory: not at its start, so that addresses in
/// front of it are good, too.
inline constexpr uint32_t Buffer = VX_GLOBAL_BASE + 0x1000;

/// Bytes that the load or store \p O moves for each lane.
inline uint32_t sizeOf(Op O) {
  switch (O) {
  case Op::RV_LB:
  case Op::RV_LBU:
  case Op::RV_SB:
    return 1;
  case Op::RV_LH:
  case Op::RV_LHU:
  case Op::RV_SH:
    return 2;
  default:
    return 4;
  }
}

/// With a megabyte of global memory behind the image.
inline Config shapeWithHighMemory() {
  Config C = WarpRunner::smallShape();
  C.GlobalBytes = VX_IMAGE_BASE - VX_GLOBAL_BASE + (1 << 20);
  return C;
}

/// Where each lane's stack ends, as the start-up code places it.
inline Lanes16 stackTops(const Config &Shape) {
  Lanes16 Tops;
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Tops[L] = VX_STACK_TOP - L * Shape.StackBytes;
  return Tops;
}

inline uint32_t wordOf(const std::byte *From) {
  uint32_t Word = 0;
  std::memcpy(&Word, From, sizeof(Word));
  return Word;
}

/// Runs the code from its first instruction on, on the lanes of \p Mask.
/// Registers 10 and 11 hold \p Addresses and \p Values.
inline void runOn(WarpRunner &R, uint32_t Mask, const Lanes16 &Addresses,
                  const Lanes16 &Values) {
  R.setX(10, Addresses);
  R.setX(11, Values);
  R.setF(11, Values);
  R.setActive(Mask);
  R.rewind();
  R.run();
}

} // namespace vorion::isasim::testing
