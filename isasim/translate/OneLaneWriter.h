/// Writes a region for one active lane: where its registers are, words, and
/// the ways in and out.
#pragma once

#include "translate/OneLane.h"
#include "translate/Places.h"

#include <deque>
#include <functional>
#include <map>
#include <span>
#include <vector>
#include <xbyak/xbyak.h>

namespace vorion::isasim::translate::lane {

class Writer;

/// A word while code is written.
struct Word {
  enum Place : uint8_t { Number, Temporary, Register, Memory };
  Writer *By = nullptr;
  Place In = Number;
  uint32_t Bits = 0; ///< the number, the host's register, or the guest's

  Word() = default;
  Word(uint32_t Value) : Bits(Value) {}
  Word(Writer *Of, Place Where, uint32_t Which)
      : By(Of), In(Where), Bits(Which) {}
};

/// The same bits with a sign.
struct Signed {
  Word Of;
};
/// The host's relations of two words.
enum class Is : uint8_t { Equal, NotEqual, Less, NotLess };
struct Test {
  Writer *By;
  Is Of;
  bool IsSigned;
  Word X, Y;
};
/// All ones where a test holds.
struct Mask {
  Test Of;
};

/// The host's registers:
///   rdi  the WarpState         r8   instructions retired
///   r9   the active lane's word of register 0
///   r14, r15  where the region lies on the host that stores, or loads, were
///        in last
///   r12  where the word at the stack pointer lies, or 0
///   r13  loads, stores and splits since the entry, CountBits bits each
///   rbx, rbp, r10, r11, xmm4 and on  the guest's registers that are used most
///   eax, edx, esi, ecx, xmm0 to xmm3  for one instruction; ecx for shifts and
///        addresses
class Writer : public Xbyak::CodeGenerator {
public:
  using Register = uint16_t; ///< an operand of Insn

  Writer(const ExecTable &ExecIn, const CodeTable &CodeIn,
         const std::vector<GuestInsn> &RegionIn, std::span<uint8_t> Buffer)
      : CodeGenerator(Buffer.size(), Buffer.data()), Exec(ExecIn), Code(CodeIn),
        Region(RegionIn) {}

  OneLaneCode write();

  /// \name For words
  /// @{
  Xbyak::Reg32 temporary();
  Word made(const Xbyak::Reg32 &In) {
    return {this, Word::Temporary, static_cast<uint32_t>(In.getIdx())};
  }
  /// Calls \p Use with an operand of the host: a register, or what is in
  /// memory.
  template <typename Function> void with(const Word &W, Function Use) {
    if (W.In == Word::Memory)
      Use(place(static_cast<Register>(W.Bits)));
    else
      Use(Xbyak::Reg32(static_cast<int>(W.Bits)));
  }
  void load(const Xbyak::Reg32 &To, const Word &W);
  /// \p W in a register, which the caller does not change.
  Xbyak::Reg32 inRegister(const Word &W);
  /// A temporary that has \p W: its own, if it is one.
  Xbyak::Reg32 ownCopy(const Word &W);
  /// Compares, for Jcc, SETcc or CMOVcc by what is returned.
  Is compare(const Test &T);
  /// @}

private:
  void allocate();
  int heldWord(Register R) const { return Words[numberOf(R)]; }
  int heldFloat(Register R) const { return Floats[numberOf(R)]; }
  Xbyak::Address place(Register R) {
    return Xbyak::util::dword[Xbyak::util::r9 + R];
  }
  Word guest(Register R);
  void result(Register R, const Word &W);
  Xbyak::Xmm guestFloat(Register R, int Spare);
  void floatResult(Register R, const Xbyak::Xmm &From);

  void writeInsn(const GuestInsn &G);
  void integer(const GuestInsn &G);
  void branch(const GuestInsn &G);
  void jump(const GuestInsn &G);
  void indirect(const GuestInsn &G);
  void lanes(const GuestInsn &G);
  void vote(const GuestInsn &G);
  void floating(const GuestInsn &G);
  template <typename Function>
  void rounded(const GuestInsn &G, Function Compute);
  template <typename Function> void fused(const GuestInsn &G, Function Compute);
  void leastOrGreatest(const GuestInsn &G, bool IsLeast);
  void toInt(const GuestInsn &G, bool IsSigned);
  void fromInt(const GuestInsn &G, bool IsSigned);
  void returnAddress(const Insn *I);

  void access(const GuestInsn &G);
  void atomic(const GuestInsn &G);
  void accessOnStack(const GuestInsn &G, Xbyak::Label &Elsewhere,
                     Xbyak::Label &Wrong);
  void accessInRegion(const GuestInsn &G, Xbyak::Label &Elsewhere);
  void move(const GuestInsn &G, const Xbyak::RegExp &At, int Bytes);
  void addressOf(const Insn *I, const Xbyak::Reg32 &To);
  void followStackPointer(const GuestInsn &G);
  /// For the entry.
  void beginMemory();
  void writeStackFinders();
  void writeFinder(bool IsStore);

  Xbyak::Label &toInterpreter();
  void outOfLine(std::function<void()> Write) {
    Later.push_back(std::move(Write));
  }
  void addPending();
  void countPending() {
    addPending();
    Pending = {};
  }
  void addPresent();
  void stopIfEnough(const Insn *Next);
  void resumeAt(const Insn *To);
  void writeEntries();
  void writeExits();
  void writeTable();

  const ExecTable &Exec;
  const CodeTable &Code;
  const std::vector<GuestInsn> &Region;
  OneLaneCode Result;
  int Words[NumRegisters], Floats[NumRegisters]; ///< of the host; -1: memory
  bool Written[NumRegisters] = {};
  bool KeepsStackPointer = false; ///< r12
  int32_t LeastOnStack = 0, GreatestOnStack = 0;
  size_t Given = 0; ///< of Temporaries
  struct {
    unsigned Insns = 0, Loads = 0, Stores = 0, Splits = 0;
  } Pending;
  std::map<const Insn *, Xbyak::Label> Labels;
  std::deque<Xbyak::Label> ToInterpreters;
  Xbyak::Label *ToInterpreter = nullptr; ///< of the present instruction
  std::vector<std::function<void()>> Later;
  Xbyak::Label Leave, Return, Prologue, Table, FindOnStack, FollowStack,
      FindLoad, FindStore;
};

} // namespace vorion::isasim::translate::lane
