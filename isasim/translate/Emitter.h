/// Writes host code, and what all kinds of instructions need for it: where
/// registers are, constants, and the ways into and out of a region.
#pragma once

#include "core/Atomics.h"
#include "translate/HeldVectors.h"
#include "translate/HostVectors.h"
#include "translate/OneLane.h"
#include "translate/Region.h"

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>

namespace vorion::isasim::translate {

/// A register of 16 lanes, or the same number in each.
struct Term {
  int Zmm = -1; ///< or below 0: the number
  uint32_t Bits = 0;
  bool isNumber() const { return Zmm < 0; }
};

/// What has the first active lane's number in every lane.
inline constexpr int FirstLaneZmm = 8;

/// How a place in the host code is entered from the interpreter.
struct Entry {
  const Insn *At;
  unsigned Full; ///< as WarpState::Full
  size_t Offset; ///< in the code
};

/// The host's registers while a region runs:
///   rdi  the WarpState         r8   instructions retired
///   r9   r8 when lanes' instructions were counted last
///   r10  WarpState::RetireLimit, or what is before it: when jumps look for the
///        code for one lane
///   rbx, rbp  loads and stores
///   r12  where the words at the stack pointer lie, or 0 (Stack.cpp)
///   r13, r14, r15  the region Global of the memory view: where it begins, how
///        far vectors of words reach from there, where it lies on the host
///   k1   active lanes (where not all are)
///   zmm0 to zmm7 for one instruction; with AVX2 zmm0 to zmm4 keep what they
///        have of the guest's registers (HeldVectors.h)
///   with AVX-512, zmm8  the first active lane's number
///        zmm9 and on  the guest's registers that are used most
///        k5  the lanes of a comparison in front of a split (keepTest())
/// rax, rcx, rdx, rsi, r11 and k2 to k4 are for one instruction.
class Emitter : public HostVectors {
public:
  /// \p Buffer, in front of which \p OneLane lies, is written; the code may be
  /// executed anywhere else, with that of \p OneLane as far in front.
  Emitter(VectorUnit Unit, const ExecTable &Exec, const CodeTable &Code,
          const std::vector<GuestInsn> &Region, const OneLaneCode &OneLane,
          std::span<uint8_t> Buffer);

  /// The whole region. Throws Xbyak::Error where the buffer is too small.
  void write();
  const std::vector<Entry> &entries() const { return Entries; }

  /// \name For instructions
  /// @{
  bool isFull() const { return Full; }
  /// A guest register's value; x0 is a number.
  Term guest(uint16_t Register);
  /// A zmm for this instruction.
  Xbyak::Zmm scratch();
  /// Another one, for what is written out of line: scratch() does not give it
  /// away.
  static constexpr int SpareZmm = 7;
  /// \p T in a register.
  Xbyak::Zmm inZmm(Term T);
  /// \p Z as a destination: active lanes alone.
  Xbyak::Zmm active(const Xbyak::Zmm &Z) const;
  Xbyak::Opmask active(const Xbyak::Opmask &K) const;
  /// Lets \p Write have the register that becomes \p Register's new value. It
  /// must write active lanes alone, and read no guest register afterwards.
  void result(uint16_t Register,
              const std::function<void(const Xbyak::Zmm &)> &Write);
  /// Where code goes on that lets the interpreter do the present instruction;
  /// stays where it is.
  Xbyak::Label &toInterpreter();
  /// Code that is rarely executed, behind everything else. It goes on by
  /// itself.
  void outOfLine(std::function<void()> Write);
  /// @}

private:
  void allocate();
  void writeMode(unsigned Mode);
  void writeInsn(const GuestInsn &G);
  void writeBranch(const GuestInsn &G);
  void resumeAt(const Insn *To, unsigned Mode);
  void countLanes();
  void addPending();
  void addPresent();
  void countPending();
  void storeRegisters();
  void holdAgain(const HeldVectors &Was);
  void writeEntries();
  void writeExits();
  Handler original(const Insn *I, Op O) const;
  int zmmOf(uint16_t Register) const;

  // Jumps.cpp.
  void writeJump(const GuestInsn &G);
  std::span<const GuestInsn> leafOf(const GuestInsn &Call) const;
  void stopIfEnough(const Insn *Next);
  void limitStretch();
  void writeAtLimit();
  void writeIndirect(const GuestInsn &G);
  void writeTables();
  void goTo(const Insn *To);

  // Float.cpp, Integer.cpp, Memory.cpp.
  void integer(const GuestInsn &G);
  void floating(const GuestInsn &G);
  bool canWait(const GuestInsn &G, bool IsFused) const;
  void makeCanonical(const Xbyak::Zmm &Result, bool Waits,
                     const std::function<void()> &First);
  void load(const GuestInsn &G);
  void store(const GuestInsn &G);

  // Atomics.cpp.
  void atomic(const GuestInsn &G);
  void takeForFunction();
  void writeAtomics();
  void writeAtomic(Amo Kind, bool HasResult, Xbyak::Label &Begin);
  void forLanes(const Xbyak::Zmm &Offsets, bool HasResult,
                const std::function<void(const Xbyak::Address &)> &Update);
  void locateWords(int In, const Xbyak::Zmm &Offsets, const Xbyak::Zmm &Spare,
                   Xbyak::Label &Elsewhere);

  // Lanes.cpp.
  void lanes(const GuestInsn &G);
  void split(const GuestInsn &G, bool IsNegated);
  void join(const GuestInsn &G);
  void predicate(const GuestInsn &G, bool IsNegated);
  void predicateOf(uint16_t Register, bool IsNegated);
  void keepTest(const GuestInsn &G);
  void spreadLast(const Xbyak::Zmm &To, const Xbyak::Zmm &From);
  void lastLane(uint16_t Register);
  void vote(const GuestInsn &G);
  void shuffle(const GuestInsn &G);
  void barrier(const GuestInsn &G);
  void changeLanes(bool AreInMask = false);
  void keepLanes(bool AreInMask = false);
  void resumeAtEither(const Insn *To);
  void storeLanes();

  // Memory.cpp.
  Xbyak::Zmm addressesOf(const Insn *I);
  void spreadFirst(const Xbyak::Zmm &To, const Xbyak::Zmm &From);
  void spreadFirstAddress(const Insn *I, int Bytes, const Xbyak::Zmm &To,
                          const Xbyak::Zmm &From);
  void jumpIfApart(const Xbyak::Zmm &All, const Xbyak::Zmm &Spread,
                   Xbyak::Label &Apart);
  void locate(int Size, unsigned Count, bool IsStore, Xbyak::Label &Wrong);
  void locateNeighbours(const Insn *I, const Xbyak::Zmm &Addresses, int Bytes,
                        bool IsStore, const Xbyak::Zmm &Bases,
                        const Xbyak::Zmm &Spread, Xbyak::Label &Apart,
                        Xbyak::Label &Wrong);
  void locateEach(const Insn *I, const Xbyak::Zmm &Addresses, int Bytes,
                  bool IsStore, const Xbyak::Zmm &Offsets, Xbyak::Label &Wrong);
  void writeFinders();

  // Stack.cpp.
  void findStackUses();
  bool isOnStack(const GuestInsn &G) const;
  void loadFromStack(const GuestInsn &G, Xbyak::Label &Wrong);
  void storeToStack(const GuestInsn &G, Xbyak::Label &Wrong);
  void locateOnStack(const Xbyak::Zmm &Addresses, Xbyak::Label &Wrong);
  void loadFromOwnStacks(const GuestInsn &G, const Xbyak::Zmm &Addresses,
                         int Bytes, bool IsSigned, const Xbyak::Zmm &Distances,
                         const Xbyak::Zmm &Spread, Xbyak::Label &Elsewhere);
  void storeToOwnStacks(const Xbyak::Zmm &Addresses, int Bytes,
                        const Xbyak::Zmm &Values, const Xbyak::Zmm &Distances,
                        const Xbyak::Zmm &Spread, Xbyak::Label &Elsewhere);
  void locateOwnLine(const Xbyak::Zmm &Addresses, int Bytes,
                     const Xbyak::Zmm &Distances, const Xbyak::Zmm &Spread,
                     Xbyak::Label &Apart, Xbyak::Label &Elsewhere);
  void locateOwnWords(int Bytes, const Xbyak::Zmm &Distances,
                      const Xbyak::Zmm &Offsets, Xbyak::Label &Elsewhere);
  void firstBits(const Xbyak::Zmm &Shifts, const Xbyak::Zmm &Depths);
  void followStackPointer(const GuestInsn &G);
  void atStackLine(const GuestInsn &G, Xbyak::Label &Wrong,
                   const std::function<void(const Xbyak::RegExp &)> &Access);
  void jumpUnlessOwn(Xbyak::Label &Others);
  void writeStackFinders();
  void writeOwnStackFinder();

  const ExecTable &Exec;
  const CodeTable &Code;
  const std::vector<GuestInsn> &Region;
  const OneLaneCode &OneLane; ///< without entries if there is none
  std::vector<Entry> Entries;
  std::vector<std::function<void()>> Later;

  int Zmms[NumRegisters]; ///< by guest register; below 0: in memory
  bool Written[NumRegisters] = {};
  bool Rounds = false; ///< something depends on frm
  /// Whether r12 is kept, and the least and greatest distance from it.
  bool KeepsStackLine = false;
  int32_t LeastOnStack = 0, GreatestOnStack = 0;

  bool Full = false;
  /// What has been executed and not been counted yet.
  struct {
    unsigned Insns = 0, Loads = 0, Stores = 0;
  } Pending;
  int Scratches = 0;              ///< given away to the present instruction
  HeldVectors Held;               ///< with AVX2
  std::optional<uint16_t> Tested; ///< the register of what k5 has
  bool IsOutOfLine = false;
  /// A result that has not been looked at for NaNs, and what is to be done
  /// where it has some.
  struct Rounded {
    Xbyak::Zmm Result;
    std::function<void()> First;
  };
  std::optional<Rounded> Unchecked;
  /// A label's copies are its own only once it has been used. These stay where
  /// they are.
  std::deque<Xbyak::Label> Lasting;
  Xbyak::Label *ToInterpreter = nullptr; ///< of the present instruction
  std::optional<Xbyak::Label> Leave, Return, Prologue;
  Xbyak::Label AtLimit[2];
  Xbyak::Label FindReadable, FindWritable, FindStackLine, FindOwnStack;
  /// Of places that lead, by WarpState::Full.
  std::map<const Insn *, Xbyak::Label> Labels[2];
  /// Where they are from the table on, by the instruction's number in the
  /// region.
  Xbyak::Label Tables[2];

  /// Functions of a mode, by kind and whether there is a result.
  std::map<std::pair<Amo, bool>, Xbyak::Label> Atomics;
};

} // namespace vorion::isasim::translate
