//===- Csr.cpp - CSRs that are a core's own -------------------------------===//

#include "core/Csr.h"

#include "core/Core.h"
#include "core/HostFp.h"
#include "core/Isa.h"
#include "core/Rounding.h"
#include "core/Warps.h"
#include "vorion/isasim/TrapCause.h"

#include <cassert>

namespace vorion::isasim {

namespace {

constexpr uint32_t FflagsMask = 0x1F;
constexpr uint32_t FrmMask = 7;
constexpr unsigned FrmShift = 5; ///< in fcsr

/// The flags of the host's unit become the warp's.
void takeFlags(WarpState *S) { S->Fflags |= HostFp::takeFlags(); }

uint64_t cycles(WarpState *S) {
  ++S->Count.Changes;
  return S->Owner->retired();
}

/// What lane \p Lane reads; the number is in the table.
uint32_t readCsr(WarpState *S, unsigned Number, unsigned Lane) {
  const Config &Shape = S->Owner->Shape;
  switch (Number) {
  case CSR_FFLAGS:
    return S->Fflags;
  case CSR_FRM:
    return S->Frm;
  case CSR_FCSR:
    return S->Frm << FrmShift | S->Fflags;
  case CSR_MCYCLE:
  case CSR_MINSTRET:
  case CSR_CYCLE:
  case CSR_TIME:
  case CSR_INSTRET:
    return static_cast<uint32_t>(cycles(S));
  case CSR_MCYCLEH:
  case CSR_MINSTRETH:
  case CSR_CYCLEH:
  case CSR_TIMEH:
  case CSR_INSTRETH:
    return static_cast<uint32_t>(cycles(S) >> 32);
  case CSR_MHARTID:
    return (S->Owner->id() * Shape.WarpsPerCore + S->WarpId) *
               Shape.LanesPerWarp +
           Lane;
  case CSR_MSCRATCH:
    return S->Owner->LaunchBlock;
  case CSR_LOCAL_OFFSET:
    return S->LocalOffset;
  case CSR_THREAD_ID:
    return Lane;
  case CSR_WARP_ID:
    return S->WarpId;
  case CSR_CORE_ID:
    return S->Owner->id();
  case CSR_ACTIVE_WARPS:
    return S->Owner->activeWarps();
  case CSR_ACTIVE_THREADS:
    return S->Mask;
  case CSR_NUM_THREADS:
    return Shape.LanesPerWarp;
  case CSR_NUM_WARPS:
    return Shape.WarpsPerCore;
  case CSR_NUM_CORES:
    return Shape.cores();
  case CSR_LOCAL_BASE:
    return VX_LOCAL_BASE;
  case CSR_NUM_BARRIERS:
    return Shape.Barriers;
  case CSR_NUM_SOCKETS:
    return Shape.sockets();
  case CSR_NUM_CLUSTERS:
    return Shape.Clusters;
  case CSR_STACK_SIZE:
    return 1U << S->Mem->StackShift;
  default:
    assert(false && "a CSR of the tables that nothing implements");
    return 0;
  }
}

void writeCsr(WarpState *S, unsigned Number, uint32_t Value) {
  switch (Number) {
  case CSR_FFLAGS:
    S->Fflags = Value & FflagsMask;
    break;
  case CSR_FRM:
    setFrm(S, Value & FrmMask);
    break;
  case CSR_FCSR:
    S->Fflags = Value & FflagsMask;
    setFrm(S, Value >> FrmShift & FrmMask);
    break;
  case CSR_MSCRATCH:
    S->Owner->LaunchBlock = Value;
    break;
  case CSR_LOCAL_OFFSET:
    S->Owner->moveLocal(*S, Value);
    break;
  default:
    break; // every other one is read-only, and has trapped
  }
}

} // namespace

CsrAccess csrAccess(const Insn *I) {
  const uint32_t Word = I->Word;
  const unsigned Function = Word >> 12 & 7;
  CsrAccess A;
  A.Number = static_cast<uint16_t>(Word >> 20);
  A.Source = static_cast<uint8_t>(Word >> 15 & 31);
  A.IsImmediate = (Function & 4) != 0;
  A.Kind = static_cast<CsrAccess::Combine>(Function & 3);
  A.Writes = A.Kind == CsrAccess::Swap || A.Source != 0;
  // A csrrw to x0 does not read, which matters where reading does something.
  A.Reads = A.Kind != CsrAccess::Swap || (Word >> 7 & 31) != 0;
  return A;
}

uint32_t CsrAccess::combine(uint32_t Old, uint32_t Operand) const {
  switch (Kind) {
  case SetBits:
    return Old | Operand;
  case ClearBits:
    return Old & ~Operand;
  default:
    return Operand;
  }
}

uint32_t CsrAccess::operand(WarpState *S, unsigned Lane) const {
  return IsImmediate ? Source : S->lanes(Source * sizeof(LaneWords))[Lane];
}

bool csrOrPark(WarpState *S, const Insn *I) {
  const CsrAccess A = csrAccess(I);
  const CsrInfo *Info = findCsrInfo(A.Number);
  if (!Info || (A.Writes && Info->Rule == WriteRule::None)) {
    raise(S, static_cast<uint32_t>(TrapCause::IllegalInstruction), S->LastLane,
          0);
    return false;
  }
  if (Info->Raster) {
    S->Why = Stop::RasterCsr;
    ++S->Count.Parks;
    return false;
  }
  if (A.Number <= CSR_FCSR)
    takeFlags(S);
  // All written CSRs here take the value of the last active lane.
  const uint32_t New =
      A.combine(readCsr(S, A.Number, S->LastLane), A.operand(S, S->LastLane));
  uint32_t *Rd = S->lanes(I->Rd);
  const uint32_t Same = Info->Uniform ? readCsr(S, A.Number, 0) : 0;
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (S->Mask >> L & 1)
      Rd[L] = Info->Uniform ? Same : readCsr(S, A.Number, L);
  if (A.Writes)
    writeCsr(S, A.Number, New);
  return true;
}

} // namespace vorion::isasim
