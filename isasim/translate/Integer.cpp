// Integer arithmetic and branches, from the interpreter's definitions.

#include "translate/Places.h"
#include "translate/Value.h"

namespace vorion::isasim::translate {

using namespace Xbyak::util;

void Emitter::integer(const GuestInsn &G) {
  const Insn *I = G.I;
  if (isSink(I->Rd))
    return;
  const Format F = InsnTable[static_cast<unsigned>(G.Opcode)].Fmt;
  const bool HasImmediate = F == Format::I || F == Format::IShift;
  const Value A(this, guest(I->Rs1));
  const Value B(this, HasImmediate ? Term{-1, static_cast<uint32_t>(I->Imm)}
                                   : guest(I->Rs2));
  const auto Becomes = [&](const Value &V) {
    result(I->Rd, [&](const Xbyak::Zmm &To) { V.into(To); });
    if (V.What == Do::One && isWide())
      keepTest(G);
  };
  switch (G.Opcode) {
#define INT(OP, RESULT)                                                        \
  case Op::OP:                                                                 \
    return Becomes(RESULT);
#include "core/insns/integer.def"
  case Op::RV_CSRRS: // of what every work-item function reads
    return result(I->Rd, [&](const Xbyak::Zmm &To) {
      if (I->Word >> 20 == CSR_THREAD_ID)
        vmovdqa32(To, laneNumbers(1));
      else
        vpbroadcastd(To, dword[rdi + VORION_PLACE(Mask)]);
    });
  default: // lui and auipc
    return Becomes(Value(this, Term{-1, static_cast<uint32_t>(I->Imm)}));
  }
}

void Emitter::writeBranch(const GuestInsn &G) {
  const Insn *I = G.I;
  const Value A(this, guest(I->Rs1)), B(this, guest(I->Rs2));
  Test Taken;
  switch (G.Opcode) {
#define BRANCH(OP, CONDITION)                                                  \
  case Op::OP:                                                                 \
    Taken = CONDITION;                                                         \
    break;
#include "core/insns/branch.def"
  default:
    break;
  }
  Xbyak::Label NotTaken;
  // Taken by some lanes only, it is an error.
  if (!isWide()) {
    Taken.into(eax);
    test(eax, eax);
    jz(NotTaken);
    isFull() ? cmp(eax, AllBits) : cmp(eax, dword[rdi + VORION_PLACE(Mask)]);
    jne(toInterpreter());
  } else {
    Taken.into(k2);
    kortestw(k2, k2);
    jz(NotTaken);
    if (isFull())
      jnc(toInterpreter());
    else {
      kxorw(k3, k1, k2);
      kortestw(k3, k3);
      jnz(toInterpreter());
    }
  }
  addPresent();
  goTo(I + (I->Imm >> 2));
  L(NotTaken);
}

} // namespace vorion::isasim::translate
