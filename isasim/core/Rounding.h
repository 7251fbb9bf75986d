/// Floating point in rounding modes that the host's unit is not in. Compiled
/// once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

enum class FpOp : uint8_t {
  Add,
  Sub,
  Mul,
  Div,
  Sqrt,
  Madd,
  Msub,
  Nmsub,
  Nmadd,
  ToInt,
  ToUint,
  FromInt,
  FromUint
};
/// Executes \p O lane by lane in the mode of \p I. False if that is none: the
/// warp has trapped.
bool softFp(WarpState *S, const Insn *I, FpOp O);

/// Sets frm (0 to 7) and puts the host's unit into it.
void setFrm(WarpState *S, uint32_t Frm);

} // namespace vorion::isasim
