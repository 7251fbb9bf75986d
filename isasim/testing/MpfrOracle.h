/// Single-precision instructions as RISC-V F and IEEE 754-2019 define them, on
/// exact values: MPFR holds what the operation gives before rounding and rounds
/// it to a whole number of units in the last place. Shares nothing with
/// core/SoftFloat.h.
#pragma once

#include "core/IsaTables.h"

#include <cstdint>

namespace vorion::isasim::testing {

struct OracleResult {
  uint32_t Bits;
  uint32_t Flags; ///< fflags
  bool operator==(const OracleResult &) const = default;
};

/// What \p O gives for the operands' bits in rounding mode \p Rm (0 to 4;
/// without meaning to instructions that do not round).
OracleResult oracle(Op O, uint32_t A, uint32_t B, uint32_t C, unsigned Rm);

} // namespace vorion::isasim::testing
