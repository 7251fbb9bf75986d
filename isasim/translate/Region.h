/// The piece of a program that is translated at once.
#pragma once

#include "core/CodeTable.h"
#include "core/Isa.h"
#include "translate/VectorUnit.h"

#include <vector>

namespace vorion::isasim::translate {

/// What a translation does with an instruction.
enum class Kind : uint8_t {
  Integer,
  Float,
  Branch,
  Jump,
  Indirect, ///< jalr
  Lanes,    ///< changes which are active
  Vote,     ///< what all active lanes say
  Shuffle,  ///< what other lanes have
  Barrier,
  Fence,
  Load,
  Store,
  Atomic,
  Other ///< leaves it to the interpreter
};

/// Which of WarpState::Registers an instruction's operand is.
inline unsigned numberOf(uint16_t Operand) {
  return Operand / sizeof(LaneWords);
}

/// Whether what goes to \p Register (an operand of Insn) is nobody's.
inline bool isSink(uint16_t Register) {
  return numberOf(Register) == SinkRegister;
}

struct GuestInsn {
  const Insn *I;
  Op Opcode;
  Kind Is;
  /// Whether code may come here otherwise than from the one in front.
  bool Leads = false;
  /// Whether the interpreter finds the translation here.
  bool Enters = false;
  unsigned Loops = 0; ///< how many it lies in
  /// Of a load: all active lanes probably name one address.
  bool HasOneAddress = false;
  /// Of a load or store: they probably name neither one nor neighbours.
  bool IsScattered = false;
  /// Of a load or store: it probably accesses the lanes' own stacks.
  bool IsInStacks = false;
};

/// What a load or store accesses.
struct Element {
  int Bytes;
  bool IsSigned;
};
Element elementOf(Op O);

/// Instructions that \p Head reaches by branches, jumps and falling through,
/// nearest first until there are enough; in the order of their addresses.
/// Empty if it is not worth it.
std::vector<GuestInsn> findRegion(VectorUnit Unit, const CodeTable &Code,
                                  const Insn *Head);

/// Of a region, by numberOf().
struct RegisterUses {
  std::vector<unsigned> MostUsed; ///< those that are used, the most first
  bool Written[NumRegisters] = {};
};
RegisterUses usesOf(const std::vector<GuestInsn> &Region);

/// Sets GuestInsn::HasOneAddress, IsScattered and IsInStacks of a region's
/// loads and stores by what \p S has in its registers, if it stands in the
/// region, and what becomes of that on every way from there. What is wrong
/// costs time alone: a translation looks at each address.
void guessAddresses(std::vector<GuestInsn> &Region, const WarpState &S);

} // namespace vorion::isasim::translate
