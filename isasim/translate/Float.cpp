// Single precision on the host's unit, from the interpreter's definitions. A
// region with any of it is only entered while frm says "to nearest", which the
// host's unit then does (core/HostFp.h). Lanes that are not active raise no
// flag (HostVectors.h).

#include "core/SoftFloat.h"
#include "translate/Places.h"
#include "translate/Value.h"

#include <algorithm>
#include <utility>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

/// vcmpps: quiet where only signaling NaNs are invalid, as the guest's are.
constexpr uint8_t EqualQuiet = 0, LessSignaling = 1, LessEqualSignaling = 2;

struct Float {
  Zmm In;
  bool IsNegated = false;
  Float operator-() const { return {In, !IsNegated}; }
};

using Operation = void (*)(Emitter *, const Zmm &To, const Zmm &A,
                           const Zmm &B);
struct Sum {
  Operation Write;
};
#define VORION_ROUNDED(INSN)                                                   \
  {[](Emitter *E, const Zmm &To, const Zmm &A, const Zmm &B) {                 \
    E->INSN(To, A, B);                                                         \
  }}
Sum operator+(Float, Float) { return VORION_ROUNDED(vaddps); }
Sum operator-(Float, Float) { return VORION_ROUNDED(vsubps); }
Sum operator*(Float, Float) { return VORION_ROUNDED(vmulps); }
Sum operator/(Float, Float) { return VORION_ROUNDED(vdivps); }
#undef VORION_ROUNDED
Sum squareRoot(Float) {
  return {[](Emitter *E, const Zmm &To, const Zmm &A, const Zmm &) {
    E->vsqrtps(To, A);
  }};
}

uint8_t operator==(Float, Float) { return EqualQuiet; }
uint8_t operator<(Float, Float) { return LessSignaling; }
uint8_t operator<=(Float, Float) { return LessEqualSignaling; }

/// Infinity times zero is invalid even if the addend is a quiet NaN, of which
/// x86 says nothing. In the lanes of k2.
void flagZeroTimesInfinity(Emitter *E, const Zmm &A, const Zmm &B,
                           const Zmm &Spare) {
  constexpr uint32_t InfiniteShifted = 0xFF000000;
  for (const auto &[X, Y] : {std::pair{A, B}, {B, A}}) {
    Label None;
    E->vpslld(Spare, X, 1);
    E->vptestnmd(k3 | k2, Spare, Spare);
    E->vpslld(Spare, Y, 1);
    E->vpcmpeqd(k4 | k3, Spare, E->constant(InfiniteShifted));
    E->kortestw(k4, k4);
    E->jz(None);
    E->or_(dword[rdi + VORION_PLACE(Fflags)], Invalid);
    E->L(None);
  }
}

void fused(Emitter *E, const Zmm &To, Float A, Float B, Float C) {
  if (C.IsNegated)
    A.IsNegated ? E->vfnmsub231ps(To, A.In, B.In)
                : E->vfmsub231ps(To, A.In, B.In);
  else
    A.IsNegated ? E->vfnmadd231ps(To, A.In, B.In)
                : E->vfmadd231ps(To, A.In, B.In);
}

/// Whether its result may be a NaN that is not canonical before it is looked
/// at. It does not leave the region.
bool isRounded(Op O) {
  switch (O) {
#define FLOAT(OP, SOFT, RESULT) case Op::OP:
#define FUSED(OP, SOFT, FACTOR, ADDEND) case Op::OP:
#include "core/insns/float.def"
    return true;
  default:
    return false;
  }
}

} // namespace

/// Whether the result of \p G may be looked at together with that of the next
/// instruction, which computes the same from any NaN. \p IsFused if the factors
/// of \p G must be there until then.
bool Emitter::canWait(const GuestInsn &G, bool IsFused) const {
  const GuestInsn *Next = &G + 1;
  if (Unchecked || zmmOf(G.I->Rd) < 0 ||
      Next == Region.data() + Region.size() || Next->I != G.I + 1 ||
      Next->Leads || Next->Is != Kind::Float || !isRounded(Next->Opcode) ||
      Next->I->Rd == G.I->Rd)
    return false;
  return !IsFused || std::ranges::none_of(
                         std::array{G.I->Rs1, G.I->Rs2}, [&](uint16_t Factor) {
                           return zmmOf(Factor) < 0 || Factor == G.I->Rd ||
                                  Factor == Next->I->Rd;
                         });
}

/// NaN results become the canonical one, where there are any; \p First is done
/// before in that case, and may use k2, which has these lanes, and k3 and k4.
void Emitter::makeCanonical(const Zmm &Result, bool Waits,
                            const std::function<void()> &First) {
  if (Waits) {
    Unchecked = {Result, First};
    return;
  }
  const std::optional<Rounded> Before = std::exchange(Unchecked, std::nullopt);
  Label Nans, Back;
  jumpIfNan(Result, Before ? Before->Result : Result, isFull(), Nans);
  L(Back);
  outOfLine([=, this]() mutable {
    L(Nans);
    const auto Mend = [this](const Rounded &R) {
      vcmpps(active(k2), R.Result, R.Result, Unordered);
      R.First();
      vpbroadcastd(R.Result | k2, number(CanonicalNan));
    };
    if (Before)
      Mend(*Before);
    Mend({Result, First});
    jmp(Back);
  });
}

void Emitter::floating(const GuestInsn &G) {
  const Insn *I = G.I;
  const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
  const auto Source = [&](File F, uint16_t Register) -> Float {
    return {F == File::None ? Zmm(0) : inZmm(guest(Register))};
  };
  const Float A = Source(Info.Rs1, I->Rs1), B = Source(Info.Rs2, I->Rs2);
  const auto Compute = [&](Sum Of) {
    result(I->Rd, [&](const Zmm &To) {
      Of.Write(this, To, A.In, B.In);
      makeCanonical(Zmm(To.getIdx()), canWait(G, false), [] {});
    });
  };
  const auto Fuse = [&](Float Factor, Float Addend) {
    result(I->Rd, [&](const Zmm &To) {
      // The factors are looked at once more where the result is no number.
      const bool Overwrites =
          To.getIdx() == A.In.getIdx() || To.getIdx() == B.In.getIdx();
      const Zmm Into = Overwrites ? scratch() : Zmm(To.getIdx());
      if (Into.getIdx() != Addend.In.getIdx())
        vmovaps(Overwrites ? Into : To, Addend.In);
      fused(this, active(Into), Factor, B, Addend);
      makeCanonical(Into, canWait(G, true), [this, A = A.In, B = B.In] {
        flagZeroTimesInfinity(this, A, B, Zmm(SpareZmm));
      });
      if (Overwrites)
        vmovaps(To, Into);
    });
  };
  const auto Compare = [&](uint8_t Condition) {
    vcmpps(active(k2), A.In, B.In, Condition);
    result(I->Rd, [&](const Zmm &To) {
      const Zmm Ones = scratch();
      vpbroadcastd(Ones | k2 | T_z, number(1));
      vmovdqa32(To, Ones);
    });
  };
  // NaNs are the interpreter's affair. Nothing has been written yet.
  const auto Choose = [&](bool IsLeast) {
    jumpIfNan(A.In, B.In, isFull(), toInterpreter());
    result(I->Rd, [&](const Zmm &To) {
      IsLeast ? least(To, A.In, B.In) : greatest(To, A.In, B.In);
    });
  };
  // So is what does not fit.
  const auto Mode = static_cast<uint32_t>(I->Imm);
  const auto ToInt = [&](bool IsSigned) {
    const Zmm R = scratch(), Spare = scratch();
    toInt(active(R), A.In, Mode, IsSigned, Spare, toInterpreter());
    result(I->Rd, [&](const Zmm &To) { vmovdqa32(To, R); });
  };
  const auto FromInt = [&](bool IsSigned) {
    const Zmm Spare = scratch();
    result(I->Rd,
           [&](const Zmm &To) { fromInt(To, A.In, Mode, IsSigned, Spare); });
  };
  switch (G.Opcode) {
#define FLOAT(OP, SOFT, RESULT)                                                \
  case Op::OP:                                                                 \
    return Compute(RESULT);
#define FUSED(OP, SOFT, FACTOR, ADDEND)                                        \
  case Op::OP: {                                                               \
    const Float C = Source(Info.Rs3, I->Rs3);                                  \
    return Fuse(FACTOR, ADDEND);                                               \
  }
#define COMPARE(OP, CONDITION, QUIET_IS_INVALID)                               \
  case Op::OP:                                                                 \
    return Compare(CONDITION);
#define MINMAX(OP, IS_MIN)                                                     \
  case Op::OP:                                                                 \
    return Choose(IS_MIN);
#define TOINT(OP, SIGNED, SOFT)                                                \
  case Op::OP:                                                                 \
    return ToInt(SIGNED);
#define FROMINT(OP, SIGNED, SOFT)                                              \
  case Op::OP:                                                                 \
    return FromInt(SIGNED);
#include "core/insns/float.def"
  default:
    break;
  }
}

} // namespace vorion::isasim::translate
