/// What the host computes 16 lanes with.
#pragma once

#include <cstdint>

namespace vorion::isasim {

enum class VectorUnit : uint8_t {
  None,
  Avx2,  ///< the x86-64-v3 level of the psABI
  Avx512 ///< with F, BW, DQ, VL, CD and VPOPCNTDQ
};

} // namespace vorion::isasim
