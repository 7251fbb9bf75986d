// Integer arithmetic and branches of one lane, from the interpreter's
// definitions.

#include "translate/OneLaneWriter.h"

#include <bit>
#include <cassert>

namespace vorion::isasim::translate::lane {

using namespace Xbyak;
using namespace Xbyak::util;

Is Writer::compare(const Test &T) {
  const Reg32 X = inRegister(T.X);
  if (T.Y.In == Word::Number)
    cmp(X, T.Y.Bits);
  else
    with(T.Y, [&](const Operand &Y) { cmp(X, Y); });
  return T.Of;
}

namespace {

Writer *either(const Word &A, const Word &B) { return A.By ? A.By : B.By; }

/// \p Fold of numbers; else \p Write(register, word), the register having \p A.
template <typename Fold, typename Function>
Word binary(const Word &A, const Word &B, bool Commutes, Fold Compute,
            Function Write) {
  if (A.In == Word::Number && B.In == Word::Number) {
    Word R(Compute(A.Bits, B.Bits));
    R.By = either(A, B);
    return R;
  }
  if (Commutes && A.In != Word::Temporary &&
      (B.In == Word::Temporary || A.In == Word::Number))
    return binary(B, A, false, Compute, Write);
  Writer *By = either(A, B);
  const Reg32 To = By->ownCopy(A);
  Write(By, To, B);
  return By->made(To);
}

#define VORION_BINARY(OPERATOR, COMMUTES, INSN)                                \
  Word operator OPERATOR(const Word &A, const Word &B) {                       \
    return binary(                                                             \
        A, B, COMMUTES, [](uint32_t X, uint32_t Y) { return X OPERATOR Y; },   \
        [](Writer *By, const Reg32 &To, const Word &Y) {                       \
          if (Y.In == Word::Number)                                            \
            return By->INSN(To, Y.Bits);                                       \
          By->with(Y, [&](const Operand &From) { By->INSN(To, From); });       \
        });                                                                    \
  }
VORION_BINARY(+, true, add)
VORION_BINARY(-, false, sub)
VORION_BINARY(&, true, and_)
VORION_BINARY(|, true, or_)
VORION_BINARY(^, true, xor_)
#undef VORION_BINARY

Word operator*(const Word &A, const Word &B) {
  return binary(
      A, B, true, [](uint32_t X, uint32_t Y) { return X * Y; },
      [](Writer *By, const Reg32 &To, const Word &Y) {
        if (Y.In == Word::Number)
          return By->imul(To, To, static_cast<int>(Y.Bits));
        By->with(Y, [&](const Operand &From) { By->imul(To, From); });
      });
}
Word operator~(const Word &A) { return A ^ Word(~0U); }
Word operator-(const Word &A) { return Word(0) - A; }

/// By \p Y modulo 32, as the host's instructions do it.
#define VORION_SHIFT(NAME, FOLD, INSN, VARIABLE)                               \
  Word NAME(const Word &A, const Word &B) {                                    \
    return binary(                                                             \
        A, B, false, [](uint32_t X, uint32_t Y) -> uint32_t { return FOLD; },  \
        [](Writer *By, const Reg32 &To, const Word &Y) {                       \
          if (Y.In == Word::Number)                                            \
            return By->INSN(To, static_cast<int>(Y.Bits & 31));                \
          By->load(ecx, Y);                                                    \
          VARIABLE;                                                            \
        });                                                                    \
  }
VORION_SHIFT(operator<<, X << (Y & 31), shl, By->shlx(To, To, ecx))
VORION_SHIFT(operator>>, X >> (Y & 31), shr, By->shrx(To, To, ecx))
VORION_SHIFT(shiftDown,
             static_cast<uint32_t>(static_cast<int32_t>(X) >> (Y & 31)), sar,
             By->sarx(To, To, ecx))
VORION_SHIFT(rotateLeft, std::rotl(X, static_cast<int>(Y & 31)), rol,
             By->rol(To, cl))
#undef VORION_SHIFT

Word shiftLeft(const Word &A, const Word &B) { return A << B; }
Word bit(const Word &B) { return Word(1) << B; }
Signed asI(const Word &A) { return {A}; }
Word asU(const Signed &A) { return A.Of; }
Mask asU(const Test &A) { return {A}; }
Signed operator>>(const Signed &A, const Signed &B) {
  return {shiftDown(A.Of, B.Of)};
}
Signed operator>>(const Signed &A, unsigned B) {
  return {shiftDown(A.Of, Word(B))};
}

Test test(Is Of, bool IsSigned, const Word &A, const Word &B) {
  return {either(A, B), Of, IsSigned, A, B};
}
Test operator==(const Word &A, const Word &B) {
  return test(Is::Equal, false, A, B);
}
Test operator!=(const Word &A, const Word &B) {
  return test(Is::NotEqual, false, A, B);
}
Test operator<(const Word &A, const Word &B) {
  return test(Is::Less, false, A, B);
}
Test operator>=(const Word &A, const Word &B) {
  return test(Is::NotLess, false, A, B);
}
Test operator<(const Signed &A, const Signed &B) {
  return test(Is::Less, true, A.Of, B.Of);
}
Test operator>=(const Signed &A, const Signed &B) {
  return test(Is::NotLess, true, A.Of, B.Of);
}

/// The host's instruction of each relation.
#define VORION_BY_RELATION(T, BY, STEM, ...)                                   \
  switch ((BY)->compare(T)) {                                                  \
  case Is::Equal:                                                              \
    (BY)->STEM##e(__VA_ARGS__);                                                \
    break;                                                                     \
  case Is::NotEqual:                                                           \
    (BY)->STEM##ne(__VA_ARGS__);                                               \
    break;                                                                     \
  case Is::Less:                                                               \
    (T).IsSigned ? (BY)->STEM##l(__VA_ARGS__) : (BY)->STEM##b(__VA_ARGS__);    \
    break;                                                                     \
  case Is::NotLess:                                                            \
    (T).IsSigned ? (BY)->STEM##ge(__VA_ARGS__) : (BY)->STEM##ae(__VA_ARGS__);  \
    break;                                                                     \
  }

Word one(const Test &A) {
  VORION_BY_RELATION(A, A.By, set, cl)
  const Reg32 To = A.By->temporary();
  A.By->movzx(To, cl);
  return A.By->made(To);
}
Word select(const Mask &If, const Word &Then, const Word &Else) {
  Writer *By = If.Of.By;
  const Reg32 Held = By->inRegister(Then);
  By->load(ecx, Else); // changes no flag, nor do loads behind the comparison
  VORION_BY_RELATION(If.Of, By, cmov, ecx, Held)
  const Reg32 To = By->temporary();
  By->mov(To, ecx);
  return By->made(To);
}
Word operator&(const Word &A, const Mask &B) { return select(B, A, Word(0)); }

/// The upper half of a product whose factors are extended with a sign or not.
Word upperHalf(const Word &A, bool IsSigned, const Word &B, bool IsOther) {
  Writer *By = either(A, B);
  const Reg32 To = By->temporary();
  const auto Extend = [By](const Reg32 &Into, const Word &W, bool Sign) {
    By->load(Into, W);
    if (Sign)
      By->movsxd(Reg64(Into.getIdx()), Into);
  };
  Extend(To, A, IsSigned);
  Extend(ecx, B, IsOther);
  By->imul(Reg64(To.getIdx()), rcx);
  By->shr(Reg64(To.getIdx()), 32);
  return By->made(To);
}
Word mulHigh(const Word &A, const Word &B) {
  return upperHalf(A, true, B, true);
}
Word mulHighSU(const Word &A, const Word &B) {
  return upperHalf(A, true, B, false);
}
Word mulHighU(const Word &A, const Word &B) {
  return upperHalf(A, false, B, false);
}

/// The quotient or the remainder. Neither operand is a temporary.
Word divided(const Word &A, const Word &B, bool IsSigned, bool IsRemainder) {
  Writer *By = either(A, B);
  By->load(ecx, B);
  [[maybe_unused]] const Reg32 Low = By->temporary(), High = By->temporary();
  assert(Low == eax && High == edx);
  By->load(eax, A);
  Label Zero, MinusOne, Done;
  By->test(ecx, ecx);
  By->jz(Zero);
  if (IsSigned) {
    By->cmp(ecx, -1);
    By->je(MinusOne);
    By->cdq();
    By->idiv(ecx);
  } else {
    By->xor_(edx, edx);
    By->div(ecx);
  }
  By->jmp(Done);
  By->L(Zero);
  By->mov(edx, eax);
  By->mov(eax, -1);
  if (IsSigned) {
    By->jmp(Done);
    By->L(MinusOne);
    By->neg(eax);
    By->xor_(edx, edx);
  }
  By->L(Done);
  return By->made(IsRemainder ? edx : eax);
}
Word divS(const Word &A, const Word &B) { return divided(A, B, true, false); }
Word divU(const Word &A, const Word &B) { return divided(A, B, false, false); }
Word remS(const Word &A, const Word &B) { return divided(A, B, true, true); }
Word remU(const Word &A, const Word &B) { return divided(A, B, false, true); }

#define VORION_UNARY(NAME, WRITE)                                              \
  Word NAME(const Word &A) {                                                   \
    Writer *By = A.By;                                                         \
    const Reg32 To = By->ownCopy(A);                                           \
    By->WRITE;                                                                 \
    return By->made(To);                                                       \
  }
VORION_UNARY(countLeading, lzcnt(To, To))
VORION_UNARY(countTrailing, tzcnt(To, To))
VORION_UNARY(popCount, popcnt(To, To))
VORION_UNARY(swapBytes, bswap(To))
#undef VORION_UNARY

/// All ones for each byte that is not 0.
Word orBytes(const Word &A) {
  const Word X = A.By->made(A.By->ownCopy(A));
  const Word Low = A.By->made(A.By->temporary());
  const Reg32 Sum(static_cast<int>(Low.Bits));
  constexpr uint32_t Lows = 0x7F7F7F7F, Tops = 0x80808080;
  A.By->load(Sum, X);
  A.By->and_(Sum, Lows);
  A.By->add(Sum, Lows); // the top bit: whether any of the lower ones is set
  return (((Low | X) & Word(Tops)) >> Word(7)) * Word(0xFF);
}

} // namespace

void Writer::integer(const GuestInsn &G) {
  const Insn *I = G.I;
  const Format F = InsnTable[static_cast<unsigned>(G.Opcode)].Fmt;
  const bool HasImmediate = F == Format::I || F == Format::IShift;
  if (isSink(I->Rd))
    return;
  switch (G.Opcode) {
  case Op::RV_CSRRS: // of what every work-item function reads
    mov(ecx,
        dword[rdi + (I->Word >> 20 == CSR_THREAD_ID ? VORION_PLACE(LastLane)
                                                    : VORION_PLACE(Mask))]);
    return result(I->Rd, made(ecx));
  case Op::RV_LUI:
  case Op::RV_AUIPC:
    return result(I->Rd, Word(static_cast<uint32_t>(I->Imm)));
  default:
    break;
  }
  const Word A = guest(I->Rs1);
  Word B = HasImmediate ? Word(static_cast<uint32_t>(I->Imm)) : guest(I->Rs2);
  B.By = this;
  switch (G.Opcode) {
#define INT(OP, RESULT)                                                        \
  case Op::OP:                                                                 \
    return result(I->Rd, RESULT);
#define classify(A) A // nobody's (isLeft())
#include "core/insns/integer.def"
#undef classify
  default:
    break;
  }
}

void Writer::branch(const GuestInsn &G) {
  const Insn *I = G.I;
  const Word A = guest(I->Rs1), B = guest(I->Rs2);
  Test Taken{};
  switch (G.Opcode) {
#define BRANCH(OP, CONDITION)                                                  \
  case Op::OP:                                                                 \
    Taken = CONDITION;                                                         \
    break;
#include "core/insns/branch.def"
  default:
    break;
  }
  // The opposite relation is the other one of a pair.
  Test NotTaken = Taken;
  NotTaken.Of = static_cast<Is>(static_cast<unsigned>(Taken.Of) ^ 1);
  Label On;
  VORION_BY_RELATION(NotTaken, this, j, On)
  addPresent();
  const Insn *To = I + (I->Imm >> 2);
  stopIfEnough(To);
  resumeAt(To);
  L(On);
}

} // namespace vorion::isasim::translate::lane
