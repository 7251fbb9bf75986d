#include "core/Rounding.h"

#include "core/HostFp.h"
#include "core/Isa.h"
#include "core/Lanes.h"
#include "core/SoftFloat.h"

namespace vorion::isasim {

bool softFp(WarpState *S, const Insn *I, FpOp O) {
  const uint32_t Rm =
      static_cast<unsigned>(I->Imm) == DynamicRm ? S->Frm : I->Imm;
  if (Rm > 4)
    return fault(S, TrapCause::IllegalInstruction, S->LastLane, 0);
  constexpr uint32_t Sign = 0x80000000;
  const uint32_t *As = S->lanes(I->Rs1), *Bs = S->lanes(I->Rs2),
                 *Cs = S->lanes(I->Rs3);
  uint32_t &Flags = S->Fflags;
  uint32_t Values[MaxLanes] = {};
  forLanes(S, [&](unsigned L) {
    const uint32_t A = As[L], B = Bs[L], C = Cs[L];
    switch (O) {
    case FpOp::Add:
      Values[L] = softAdd(A, B, Rm, Flags);
      break;
    case FpOp::Sub:
      Values[L] = softAdd(A, B ^ Sign, Rm, Flags);
      break;
    case FpOp::Mul:
      Values[L] = softMul(A, B, Rm, Flags);
      break;
    case FpOp::Div:
      Values[L] = softDiv(A, B, Rm, Flags);
      break;
    case FpOp::Sqrt:
      Values[L] = softSqrt(A, Rm, Flags);
      break;
    case FpOp::Madd:
      Values[L] = softFma(A, B, C, Rm, Flags);
      break;
    case FpOp::Msub:
      Values[L] = softFma(A, B, C ^ Sign, Rm, Flags);
      break;
    case FpOp::Nmsub:
      Values[L] = softFma(A ^ Sign, B, C, Rm, Flags);
      break;
    case FpOp::Nmadd:
      Values[L] = softFma(A ^ Sign, B, C ^ Sign, Rm, Flags);
      break;
    case FpOp::ToInt:
      Values[L] = softToInt(A, true, Rm, Flags);
      break;
    case FpOp::ToUint:
      Values[L] = softToInt(A, false, Rm, Flags);
      break;
    case FpOp::FromInt:
      Values[L] = softFromInt(A, true, Rm, Flags);
      break;
    case FpOp::FromUint:
      Values[L] = softFromInt(A, false, Rm, Flags);
      break;
    }
    return true;
  });
  writeLanes(S, I->Rd, Values);
  return true;
}

void setFrm(WarpState *S, uint32_t Frm) {
  S->Frm = Frm;
  // A mode that the host lacks leaves it at the nearest one.
  const uint32_t Host = Frm < NumHostRoundings ? Frm : 0;
  HostFp::enter(Host);
  for (uint32_t Rm = 0; Rm != NumHostRoundings; ++Rm)
    S->RmIsHost[Rm] = Rm == Host;
  S->RmIsHost[DynamicRm] = Frm == Host;
}

} // namespace vorion::isasim
