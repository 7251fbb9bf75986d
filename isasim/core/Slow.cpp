#include "core/Slow.h"

#include "core/Core.h"
#include "core/HostFp.h"
#include "core/Isa.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace vorion::isasim {

namespace {

/// Calls F(lane) for every active lane, ascending, until one returns false.
template <typename Function> bool forLanes(const WarpState *S, Function F) {
  for (uint32_t Left = S->Mask; Left; Left &= Left - 1)
    if (!F(static_cast<unsigned>(std::countr_zero(Left))))
      return false;
  return true;
}

bool inside(const Region &R, uint32_t Addr, uint32_t Bytes) {
  const uint32_t Offset = Addr - R.Lo;
  return Offset < R.Bytes && Bytes <= R.Bytes - Offset;
}

/// Memory that every instruction may write, except the image.
std::byte *data(const MemoryView &M, uint32_t Addr, uint32_t Bytes) {
  for (const Region *R : {&M.Global, &M.Local})
    if (inside(*R, Addr, Bytes))
      return R->at(Addr);
  // Aligned accesses stay within a word, and words are contiguous.
  if (inside(M.Stack, Addr, Bytes))
    return M.Stack.Host + M.stackOffset(Addr);
  return nullptr;
}

std::byte *readable(const MemoryView &M, uint32_t Addr, uint32_t Bytes) {
  if (std::byte *At = data(M, Addr, Bytes))
    return At;
  return inside(M.Image, Addr, Bytes) ? M.Image.at(Addr) : nullptr;
}

std::byte *writable(const MemoryView &M, uint32_t Addr, uint32_t Bytes) {
  if (std::byte *At = data(M, Addr, Bytes))
    return At;
  for (unsigned N = 0; N != M.NumImageWritable; ++N)
    if (inside(M.ImageWritable[N], Addr, Bytes))
      return M.ImageWritable[N].at(Addr);
  return nullptr;
}

bool fault(WarpState *S, TrapCause Cause, unsigned Lane, uint32_t Addr) {
  raise(S, static_cast<uint32_t>(Cause), Lane, Addr);
  return false;
}

/// Copies the lanes of the mask from Values to register offset Rd.
void writeLanes(WarpState *S, unsigned Rd, const uint32_t *Values) {
  uint32_t *To = S->lanes(Rd);
  forLanes(S, [&](unsigned L) {
    To[L] = Values[L];
    return true;
  });
}

/// Where Vortex's own programs store console bytes, a lane each (its
/// IO_COUT_ADDR and IO_COUT_SIZE).
constexpr uint32_t ConsoleBytes = 64;

bool storeIo(WarpState *S, unsigned Bytes, uint32_t Addr, uint32_t Value) {
  if (Bytes == 1 && Addr - VX_IO_CONSOLE < ConsoleBytes) {
    S->Owner->print(static_cast<char>(Value));
    return true;
  }
  if (Bytes != 4)
    return false;
  if (Addr == VX_IO_CONSOLE)
    S->Owner->print(static_cast<char>(Value));
  else if (Addr == VX_IO_EXIT)
    S->Owner->exitWith(Value);
  else
    return false;
  return true;
}

[[gnu::always_inline]] inline uint32_t
applyAmo(Amo Kind, uint32_t Old, uint32_t Operand, uint32_t Compare) {
  const auto SOld = static_cast<int32_t>(Old);
  const auto SOperand = static_cast<int32_t>(Operand);
  switch (Kind) {
  case Amo::Add:
    return Old + Operand;
  case Amo::Swap:
    return Operand;
  case Amo::Xor:
    return Old ^ Operand;
  case Amo::And:
    return Old & Operand;
  case Amo::Or:
    return Old | Operand;
  case Amo::Min:
    return SOld < SOperand ? Old : Operand;
  case Amo::Max:
    return SOld < SOperand ? Operand : Old;
  case Amo::Minu:
    return std::min(Old, Operand);
  case Amo::Maxu:
    return std::max(Old, Operand);
  case Amo::Cas:
    return Old == Compare ? Operand : Old;
  }
  return Old;
}

bool allLanesIn(WarpState *S, const Insn *I, const Region &R) {
  const uint32_t *Addresses = S->lanes(I->Rs1);
  return forLanes(S, [&](unsigned L) {
    return Addresses[L] % 4 == 0 && inside(R, Addresses[L], 4);
  });
}

constexpr unsigned SinkOffset = SinkRegister * sizeof(LaneWords);

} // namespace

void raise(WarpState *S, uint32_t Cause, uint32_t Lane, uint32_t Address) {
  S->Why = Stop::Trapped;
  S->FaultCause = Cause;
  S->FaultLane = Lane;
  S->FaultAddress = Address;
}

bool slowLoad(WarpState *S, const Insn *I, unsigned Bytes, bool Signed) {
  uint32_t Values[MaxLanes] = {};
  const uint32_t *Base = S->lanes(I->Rs1);
  const bool Ok = forLanes(S, [&](unsigned L) {
    const uint32_t Addr = Base[L] + static_cast<uint32_t>(I->Imm);
    if (Addr % Bytes != 0)
      return fault(S, TrapCause::MisalignedLoad, L, Addr);
    const std::byte *From = readable(*S->Mem, Addr, Bytes);
    if (!From)
      return fault(S, TrapCause::LoadFault, L, Addr);
    std::memcpy(&Values[L], From, Bytes);
    const unsigned Shift = 32 - 8 * Bytes;
    if (Signed)
      Values[L] = static_cast<uint32_t>(
          static_cast<int32_t>(Values[L] << Shift) >> Shift);
    return true;
  });
  if (Ok)
    writeLanes(S, I->Rd, Values);
  return Ok;
}

bool slowStore(WarpState *S, const Insn *I, unsigned Bytes) {
  const uint32_t *Base = S->lanes(I->Rs1);
  const uint32_t *Values = S->lanes(I->Rs2);
  return forLanes(S, [&](unsigned L) {
    const uint32_t Addr = Base[L] + static_cast<uint32_t>(I->Imm);
    if (Addr % Bytes != 0)
      return fault(S, TrapCause::MisalignedStore, L, Addr);
    if (std::byte *To = writable(*S->Mem, Addr, Bytes)) {
      std::memcpy(To, &Values[L], Bytes);
      return true;
    }
    return storeIo(S, Bytes, Addr, Values[L]) ||
           fault(S, TrapCause::StoreFault, L, Addr);
  });
}

Amo amoKind(const Insn *I) {
  switch (decode(I->Word)->O) {
  case Op::RV_AMOADD_W:
    return Amo::Add;
  case Op::RV_AMOSWAP_W:
    return Amo::Swap;
  case Op::RV_AMOXOR_W:
    return Amo::Xor;
  case Op::RV_AMOAND_W:
    return Amo::And;
  case Op::RV_AMOOR_W:
    return Amo::Or;
  case Op::RV_AMOMIN_W:
    return Amo::Min;
  case Op::RV_AMOMAX_W:
    return Amo::Max;
  case Op::RV_AMOMINU_W:
    return Amo::Minu;
  case Op::RV_AMOMAXU_W:
    return Amo::Maxu;
  default:
    return Amo::Cas;
  }
}

/// The atomic in lane order, at the places that Find gives for an address.
template <Amo Kind, typename Function>
bool amoLanes(WarpState *S, const Insn *I, Function Find) {
  uint32_t Olds[MaxLanes] = {};
  const uint32_t *Addresses = S->lanes(I->Rs1);
  const uint32_t *Operands = S->lanes(I->Rs2);
  const uint32_t *Compares = S->lanes(I->Rs3);
  const bool Ok = forLanes(S, [&](unsigned L) {
    std::byte *At = Addresses[L] % 4 == 0 ? Find(Addresses[L]) : nullptr;
    if (!At)
      return fault(S,
                   Addresses[L] % 4 ? TrapCause::MisalignedStore
                                    : TrapCause::StoreFault,
                   L, Addresses[L]);
    std::memcpy(&Olds[L], At, 4);
    const uint32_t New = applyAmo(Kind, Olds[L], Operands[L], Compares[L]);
    S->Count.Changes += New != Olds[L];
    std::memcpy(At, &New, 4);
    return true;
  });
  if (Ok)
    writeLanes(S, I->Rd, Olds);
  return Ok;
}

template <typename Function>
bool amoWhere(WarpState *S, const Insn *I, Amo Kind, Function Find) {
  switch (Kind) {
#define VORION_AMO(NAME)                                                       \
  case Amo::NAME:                                                              \
    return amoLanes<Amo::NAME>(S, I, Find);
    VORION_AMO(Add)
    VORION_AMO(Swap)
    VORION_AMO(Xor)
    VORION_AMO(And)
    VORION_AMO(Or)
    VORION_AMO(Min)
    VORION_AMO(Max)
    VORION_AMO(Minu)
    VORION_AMO(Maxu)
    VORION_AMO(Cas)
#undef VORION_AMO
  }
  return false;
}

bool amoNow(WarpState *S, const Insn *I, Amo Kind) {
  return amoWhere(S, I, Kind,
                  [S](uint32_t Addr) { return writable(*S->Mem, Addr, 4); });
}

bool amoOrPark(WarpState *S, const Insn *I, Amo Kind) {
  if (allLanesIn(S, I, S->Mem->Local))
    return amoWhere(S, I, Kind,
                    [S](uint32_t Addr) { return S->Mem->Local.at(Addr); });
  // Additions commute, so their order among the cores does not show; other
  // kinds would, mixed on one word.
  if (Kind == Amo::Add && I->Rd == SinkOffset &&
      allLanesIn(S, I, S->Mem->Global))
    return forLanes(S, [&](unsigned L) {
      auto *Word =
          reinterpret_cast<uint32_t *>(S->Mem->Global.at(S->lanes(I->Rs1)[L]));
      const uint32_t Addend = S->lanes(I->Rs2)[L];
      S->Count.Changes += Addend != 0;
      __atomic_fetch_add(Word, Addend, __ATOMIC_ACQ_REL);
      return true;
    });
  S->Why = Stop::Atomic;
  ++S->Count.Parks;
  return false;
}

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

bool spawnWarps(WarpState *S, uint32_t Warps, uint32_t Entry) {
  return S->Owner->spawn(*S, Warps, Entry);
}

bool barrier(WarpState *S, uint32_t Id, uint32_t Count) {
  return S->Owner->arrive(*S, Id, Count);
}

void setMask(WarpState *S, uint32_t Mask) {
  S->Mask = S->WholeMask = Mask;
  S->Full = Mask == (1U << MaxLanes) - 1;
  S->LaneCount = static_cast<uint32_t>(std::popcount(Mask));
  S->LastLane = static_cast<uint32_t>(std::bit_width(Mask)) - 1;
  for (unsigned L = 0; L != MaxLanes; ++L)
    S->MaskWords[L] = 0U - (Mask >> L & 1);
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
