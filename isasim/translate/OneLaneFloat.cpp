// Single precision of one lane on the host's unit, rounded to nearest, as
// Float.cpp has it.

#include "core/SoftFloat.h"
#include "translate/OneLaneWriter.h"

namespace vorion::isasim::translate::lane {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

struct Float {
  bool IsNegated = false;
  Float operator-() const { return {!IsNegated}; }
};
using Operation = void (*)(Writer *, const Xmm &To, const Xmm &A, const Xmm &B);
#define VORION_ROUNDED(NAME, INSN)                                             \
  Operation NAME(Float, Float) {                                               \
    return [](Writer *By, const Xmm &To, const Xmm &A, const Xmm &B) {         \
      By->INSN(To, A, B);                                                      \
    };                                                                         \
  }
VORION_ROUNDED(operator+, vaddss)
VORION_ROUNDED(operator-, vsubss)
VORION_ROUNDED(operator*, vmulss)
VORION_ROUNDED(operator/, vdivss)
#undef VORION_ROUNDED
Operation squareRoot(Float) {
  return [](Writer *By, const Xmm &To, const Xmm &A, const Xmm &) {
    By->vsqrtss(To, A, A);
  };
}
/// vcmpss: quiet where only signaling NaNs are invalid, as the guest's are.
uint8_t operator==(Float, Float) { return 0; }
uint8_t operator<(Float, Float) { return 1; }
uint8_t operator<=(Float, Float) { return 2; }

} // namespace

/// A NaN becomes the canonical one.
template <typename Function>
void Writer::rounded(const GuestInsn &G, Function Compute) {
  const Insn *I = G.I;
  const bool HasTwo =
      InsnTable[static_cast<unsigned>(G.Opcode)].Rs2 != File::None;
  const Xmm A = guestFloat(I->Rs1, 1);
  const Xmm B = HasTwo ? guestFloat(I->Rs2, 2) : A;
  const Xmm To = heldFloat(I->Rd) >= 0 ? Xmm(heldFloat(I->Rd)) : xmm0;
  Label Nan, Back;
  Compute(this, To, A, B);
  vucomiss(To, To);
  jp(Nan);
  L(Back);
  floatResult(I->Rd, To);
  outOfLine([=, this]() mutable {
    L(Nan);
    mov(ecx, CanonicalNan);
    vmovd(To, ecx);
    jmp(Back);
  });
}

/// A NaN is the interpreter's affair: infinity times zero is invalid whatever
/// is added.
template <typename Function>
void Writer::fused(const GuestInsn &G, Function Compute) {
  const Insn *I = G.I;
  const Xmm A = guestFloat(I->Rs1, 1), B = guestFloat(I->Rs2, 2);
  vmovaps(xmm0, guestFloat(I->Rs3, 0));
  Compute(A, B);
  vucomiss(xmm0, xmm0);
  jp(toInterpreter());
  floatResult(I->Rd, xmm0);
}

/// With its own sign where both are zero; NaNs are the interpreter's affair.
void Writer::leastOrGreatest(const GuestInsn &G, bool IsLeast) {
  const Xmm A = guestFloat(G.I->Rs1, 1), B = guestFloat(G.I->Rs2, 2);
  Label Differ, Done;
  vucomiss(A, B);
  jp(toInterpreter());
  jne(Differ);
  IsLeast ? vorps(xmm0, A, B) : vandps(xmm0, A, B);
  jmp(Done);
  L(Differ);
  IsLeast ? vminss(xmm0, A, B) : vmaxss(xmm0, A, B);
  L(Done);
  floatResult(G.I->Rd, xmm0);
}

/// What does not fit is the interpreter's affair, and so are negative numbers
/// without a sign: the host would call their rounding inexact.
void Writer::toInt(const GuestInsn &G, bool IsSigned) {
  Xmm A = guestFloat(G.I->Rs1, 1);
  Label &Wrong = toInterpreter();
  if (!IsSigned) {
    vmovd(eax, A);
    test(eax, eax);
    js(Wrong);
  }
  const auto Mode = static_cast<unsigned>(G.I->Imm);
  if (Mode == Rdn || Mode == Rup) {
    constexpr uint8_t Down = 1, Up = 2;
    vroundss(xmm0, A, A, Mode == Rdn ? Down : Up);
    A = xmm0;
  }
  const bool IsNearest = Mode == Rne || Mode == DynamicRm;
  if (IsSigned) {
    constexpr uint32_t DoesNotFit = 0x80000000;
    IsNearest ? vcvtss2si(eax, A) : vcvttss2si(eax, A);
    cmp(eax, DoesNotFit);
    je(Wrong);
  } else {
    IsNearest ? vcvtss2si(rax, A) : vcvttss2si(rax, A);
    mov(rcx, rax);
    shr(rcx, 32);
    jnz(Wrong);
  }
  result(G.I->Rd, made(eax));
}

void Writer::fromInt(const GuestInsn &G, bool IsSigned) {
  load(ecx, guest(G.I->Rs1));
  vxorps(xmm0, xmm0, xmm0);
  IsSigned ? vcvtsi2ss(xmm0, xmm0, ecx) : vcvtsi2ss(xmm0, xmm0, rcx);
  floatResult(G.I->Rd, xmm0);
}

void Writer::floating(const GuestInsn &G) {
  const Float A, B, C;
  const auto Fuse = [&](Float Factor, Float Addend) {
    fused(G, [&](const Xmm &X, const Xmm &Y) {
      if (Addend.IsNegated)
        Factor.IsNegated ? vfnmsub231ss(xmm0, X, Y) : vfmsub231ss(xmm0, X, Y);
      else
        Factor.IsNegated ? vfnmadd231ss(xmm0, X, Y) : vfmadd231ss(xmm0, X, Y);
    });
  };
  const auto Compare = [&](uint8_t Condition) {
    vcmpss(xmm0, guestFloat(G.I->Rs1, 1), guestFloat(G.I->Rs2, 2), Condition);
    vmovd(eax, xmm0);
    and_(eax, 1);
    result(G.I->Rd, made(eax));
  };
  switch (G.Opcode) {
#define FLOAT(OP, SOFT, RESULT)                                                \
  case Op::OP:                                                                 \
    return rounded(G, RESULT);
#define FUSED(OP, SOFT, FACTOR, ADDEND)                                        \
  case Op::OP:                                                                 \
    return Fuse(FACTOR, ADDEND);
#define COMPARE(OP, CONDITION, QUIET_IS_INVALID)                               \
  case Op::OP:                                                                 \
    return Compare(CONDITION);
#define MINMAX(OP, IS_MIN)                                                     \
  case Op::OP:                                                                 \
    return leastOrGreatest(G, IS_MIN);
#define TOINT(OP, SIGNED, SOFT)                                                \
  case Op::OP:                                                                 \
    return toInt(G, SIGNED);
#define FROMINT(OP, SIGNED, SOFT)                                              \
  case Op::OP:                                                                 \
    return fromInt(G, SIGNED);
#include "core/insns/float.def"
  default:
    break;
  }
}

} // namespace vorion::isasim::translate::lane
