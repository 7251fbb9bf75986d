#include "core/Atomics.h"

#include "core/Isa.h"
#include "core/Lanes.h"
#include "core/Reach.h"

#include <algorithm>
#include <cstring>

namespace vorion::isasim {

namespace {

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
  case Amo::CasPair: // casPairs()
    break;
  }
  return Old;
}

bool allLanesIn(WarpState *S, const Insn *I, Amo Kind, const Region &R) {
  const uint32_t Bytes = bytesOf(Kind);
  const uint32_t *Addresses = S->lanes(I->Rs1);
  return forLanes(S, [&](unsigned L) {
    return Addresses[L] % Bytes == 0 && inside(R, Addresses[L], Bytes);
  });
}

constexpr unsigned SinkOffset = SinkRegister * sizeof(LaneWords);

/// The register offset behind \p Offset, for the high word of a pair. x0 and
/// the sink stand for 64 bits.
unsigned highWord(unsigned Offset) {
  return Offset == 0 || Offset == SinkOffset ? Offset
                                             : Offset + sizeof(LaneWords);
}

bool faultAt(WarpState *S, unsigned L, uint32_t Address, uint32_t Bytes) {
  if (Address % Bytes)
    return fault(S, TrapCause::MisalignedStore, L, Address);
  return fault(S,
               isStray(S, L, Address) ? TrapCause::StackOverflow
                                      : TrapCause::StoreFault,
               L, Address);
}

/// The atomic in lane order, at the places that Find gives for a lane's
/// address.
template <Amo Kind, typename Function>
bool amoLanes(WarpState *S, const Insn *I, Function Find) {
  uint32_t Olds[MaxLanes] = {};
  const uint32_t *Addresses = S->lanes(I->Rs1);
  const uint32_t *Operands = S->lanes(I->Rs2);
  const uint32_t *Compares = S->lanes(I->Rs3);
  const bool Ok = forLanes(S, [&](unsigned L) {
    std::byte *At = Addresses[L] % 4 == 0 ? Find(L, Addresses[L]) : nullptr;
    if (!At)
      return faultAt(S, L, Addresses[L], 4);
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

/// Compare-and-swap of 64 bits, likewise. On a stack the two words of a lane
/// are not neighbours.
template <typename Function>
bool casPairs(WarpState *S, const Insn *I, Function Find) {
  uint32_t Olds[2][MaxLanes] = {};
  const uint32_t *Addresses = S->lanes(I->Rs1);
  const uint32_t *News[] = {S->lanes(I->Rs2), S->lanes(highWord(I->Rs2))};
  const uint32_t *Compares[] = {S->lanes(I->Rs3), S->lanes(highWord(I->Rs3))};
  const bool Ok = forLanes(S, [&](unsigned L) {
    const uint32_t Address = Addresses[L];
    std::byte *Low = Address % 8 == 0 ? Find(L, Address) : nullptr;
    std::byte *High = Low ? Find(L, Address + 4) : nullptr;
    if (!High)
      return faultAt(S, L, Address, 8);
    std::memcpy(&Olds[0][L], Low, 4);
    std::memcpy(&Olds[1][L], High, 4);
    if (Olds[0][L] != Compares[0][L] || Olds[1][L] != Compares[1][L])
      return true;
    S->Count.Changes += Olds[0][L] != News[0][L] || Olds[1][L] != News[1][L];
    std::memcpy(Low, &News[0][L], 4);
    std::memcpy(High, &News[1][L], 4);
    return true;
  });
  if (Ok) {
    writeLanes(S, I->Rd, Olds[0]);
    writeLanes(S, highWord(I->Rd), Olds[1]);
  }
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
  case Amo::CasPair:
    return casPairs(S, I, Find);
  }
  return false;
}

} // namespace

Amo amoKind(const Insn *I) {
  switch (decode(I->Word)->Opcode) {
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
  case Op::RV_AMOCAS_D:
    return Amo::CasPair;
  default:
    return Amo::Cas;
  }
}

bool amoNow(WarpState *S, const Insn *I, Amo Kind) {
  return amoWhere(S, I, Kind, [S](unsigned L, uint32_t Addr) {
    return isStray(S, L, Addr) ? nullptr : writableAt(*S->Mem, Addr, 4);
  });
}

bool amoOrPark(WarpState *S, const Insn *I, Amo Kind) {
  if (allLanesIn(S, I, Kind, S->Mem->Local))
    return amoWhere(S, I, Kind, [S](unsigned, uint32_t Addr) {
      return S->Mem->Local.at(Addr);
    });
  // Additions commute, so their order among the cores does not show; other
  // kinds would, mixed on one word.
  for (const Region *Global : {&S->Mem->Global, &S->Mem->High}) {
    if (Kind != Amo::Add || I->Rd != SinkOffset ||
        !allLanesIn(S, I, Kind, *Global))
      continue;
    return forLanes(S, [&](unsigned L) {
      auto *Word =
          reinterpret_cast<uint32_t *>(Global->at(S->lanes(I->Rs1)[L]));
      const uint32_t Addend = S->lanes(I->Rs2)[L];
      S->Count.Changes += Addend != 0;
      __atomic_fetch_add(Word, Addend, __ATOMIC_ACQ_REL);
      return true;
    });
  }
  S->Why = Stop::Atomic;
  ++S->Count.Parks;
  return false;
}

} // namespace vorion::isasim
