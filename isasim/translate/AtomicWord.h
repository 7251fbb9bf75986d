/// An atomic on one word, in the code that is written.
#pragma once

#include "core/Atomics.h"
#include "core/Isa.h"

#include <cassert>
#include <xbyak/xbyak.h>

namespace vorion::isasim::translate {

/// What an atomic instruction does.
inline Amo atomicOf(Op O) {
  switch (O) {
#define AMO(OP, KIND)                                                          \
  case Op::OP:                                                                 \
    return Amo::KIND;
#include "core/insns/memory.def"
  default:
    assert(false && "no atomic");
    return Amo::Add;
  }
}

/// \p New, which is the operand, becomes what the word becomes that was
/// \p Old.
inline void applyAtomic(Xbyak::CodeGenerator &E, Amo Kind,
                        const Xbyak::Reg32 &New, const Xbyak::Reg32 &Old) {
  switch (Kind) {
  case Amo::Add:
    return E.add(New, Old);
  case Amo::Xor:
    return E.xor_(New, Old);
  case Amo::And:
    return E.and_(New, Old);
  case Amo::Or:
    return E.or_(New, Old);
  case Amo::Min:
    E.cmp(Old, New);
    return E.cmovl(New, Old);
  case Amo::Max:
    E.cmp(Old, New);
    return E.cmovg(New, Old);
  case Amo::Minu:
    E.cmp(Old, New);
    return E.cmovb(New, Old);
  case Amo::Maxu:
    E.cmp(Old, New);
    return E.cmova(New, Old);
  case Amo::Swap:
    return;
  case Amo::Cas:
  case Amo::CasPair:
    assert(false && "not translated");
  }
}

} // namespace vorion::isasim::translate
