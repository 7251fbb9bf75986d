/// A warp's registers and what its instructions need at hand. Plain data: this
/// header is compiled into every vector level (Exec.cpp), so it must not bring
/// in library code that the linker could merge across levels.
#pragma once

#include "vorion/isasim/Counters.h"

#include <cstddef>
#include <cstdint>

namespace vorion::isasim {

inline constexpr unsigned MaxLanes = 16;

/// One 32-bit word for each lane: a register. Lanes that a machine does not
/// have are never active.
using LaneWords = uint32_t __attribute__((vector_size(4 * MaxLanes)));

/// Places in WarpState::Registers.
inline constexpr unsigned XBase = 0;
inline constexpr unsigned FBase = 32;
inline constexpr unsigned SinkRegister = 64; ///< takes what is written to x0
inline constexpr unsigned NumRegisters = 65;

/// Insn::Rs1 of an access by sp.
inline constexpr uint16_t StackPointer = 2 * sizeof(LaneWords);

struct WarpState;
struct Insn;

/// Executes \p I and goes on to the next instruction, until something stops
/// the warp (WarpState::Why). \p Start is the first instruction since the
/// last one that was counted: instructions are counted a straight line at a
/// time.
using Handler = void (*)(WarpState *S, const Insn *I, const Insn *Start);

/// An instruction as it is executed.
struct Insn {
  Handler Run[2]; ///< indexed by WarpState::Full
  /// Byte offsets of operands in WarpState. Rs3 is the destination's old value
  /// where an instruction reads it (amocas).
  uint16_t Rd, Rs1, Rs2, Rs3;
  int32_t Imm; ///< branches and jal: bytes to the target
  uint32_t Word;
};

/// Why a warp does not go on at present.
enum class Stop : uint32_t {
  Ready,   ///< it can
  Ended,   ///< thread mask 0
  Trapped, ///< WarpState::Fault*
  // It waits, at Next, for the point where all cores are parked:
  Atomic,
  RasterCsr,
  GlobalBarrier, ///< has arrived there if AtBarrier
  // It waits for warps of its own core:
  LocalBarrier,
};

/// Insn::Imm of a branch or jal whose target is not code.
inline constexpr int32_t BadTarget = INT32_MIN;

/// A range of guest memory and where it lies on the host.
struct Region {
  uint32_t Lo = 0;
  uint32_t Bytes = 0; ///< at least MaxLanes * 4
  std::byte *Host = nullptr;

  /// Whether [Addr, Addr + Size) lies inside, Size <= MaxLanes * 4.
  bool holds(uint32_t Addr, uint32_t Size) const {
    return Addr - Lo <= Bytes - Size;
  }
  std::byte *at(uint32_t Addr) const { return Host + (Addr - Lo); }
};

/// Harts whose stacks are interleaved on the host.
inline constexpr unsigned StackGroup = 16;

/// What a core can reach.
struct MemoryView {
  /// Global memory in front of the image and, in High, behind it, as far as a
  /// program can write it in one piece; High is Global again if there is none.
  Region Global, Local, Stack, Image;
  Region High;
  /// The pieces behind what it can only read; Global again if there are none.
  Region Rest[2];
  /// Both parts of global memory with what can only be read.
  Region Whole[2];
  /// Logarithm of the bytes of one stack.
  unsigned StackShift = 0;
  /// Writable parts of the image, by address.
  const Region *ImageWritable = nullptr;
  unsigned NumImageWritable = 0;

  /// The number of the stack with \p Addr, from the top. Works on numbers and
  /// on vectors of them.
  template <typename T> T stackOf(T Addr) const {
    return ((Stack.Lo + (Stack.Bytes - 1)) - Addr) >> StackShift;
  }

  /// Where the byte at guest address \p Addr of a stack lies after Stack.Host.
  /// The same word of 16 neighbouring harts' stacks is one cache line: lanes
  /// mostly access the same place of their stacks, and at the guest's distance
  /// of a power of two they would all fall into one set of the host's cache.
  /// Works on numbers and on vectors of them.
  template <typename T> T stackOffset(T Addr) const {
    const T FromTop = (Stack.Lo + (Stack.Bytes - 1)) - Addr;
    const T Hart = FromTop >> StackShift;
    const T Word = (FromTop & ((1U << StackShift) - 1)) >> 2;
    return (Hart / StackGroup << (StackShift + 4)) + Word * (4 * StackGroup) +
           Hart % StackGroup * 4 + Addr % 4;
  }
};

/// One divergent vx_split that has not been joined.
struct Divergence {
  uint32_t Mask;  ///< before the split
  uint32_t Other; ///< lanes of the side that waits, 0 once it has run
  const Insn *Pc; ///< where that side starts
};

/// A warp's part of its core's counters.
struct WarpCounters : CoreCounters {
  /// Atomics that changed memory, and reads of what changes by itself: with
  /// Stores, what tells a warp that waits in vain (machine/HangDetector.h).
  uint64_t Changes = 0;
};

class Core;
class Watch;
struct CoreTrace;

struct alignas(64) WarpState {
  LaneWords
      Registers[NumRegisters]; ///< x0..x31, f0..f31, the sink; at offset 0
  LaneWords MaskWords;         ///< all ones in active lanes
  uint32_t Mask = 0;           ///< active lanes
  uint32_t Full = 0;           ///< 1 if all MaxLanes lanes are active
  uint32_t LaneCount = 0;      ///< active lanes
  uint32_t LastLane = 0;       ///< the highest active one
  /// Whether an instruction with this rounding mode field rounds as the host
  /// does at present, which is as frm says (HostFp.h).
  uint8_t RmIsHost[8] = {};

  const Insn *Code = nullptr; ///< the instruction at CodeLo
  uint32_t CodeLo = 0;
  uint32_t CodeCount = 0; ///< instructions
  const MemoryView *Mem = nullptr;

  WarpCounters Count;
  /// Stop where the program may go back (branch, jump, vx_join) when
  /// Count.WarpInstructions has reached it.
  uint64_t RetireLimit = 0;
  uint64_t TurnEnd = 0;       ///< the RetireLimit of the whole round
  const Insn *Next = nullptr; ///< where to go on
  Stop Why = Stop::Ended;

  Divergence *Stack = nullptr;
  uint32_t StackDepth = 0;
  uint32_t StackLimit = 0;

  uint32_t Frm = 0;
  uint32_t Fflags = 0; ///< those of the host unit are added when it stops
  uint32_t AllLanes = 0;
  /// The mask before any split or predicate: that of the last vx_tmc.
  uint32_t WholeMask = 0;
  uint32_t WarpId = 0;
  uint32_t LocalOffset = 0; ///< vx_local_offset
  /// The number of lane 0's stack, from the top; NoOwnStack where stacks are
  /// the program's affair.
  static constexpr uint32_t NoOwnStack = ~0U;
  uint32_t FirstStack = NoOwnStack;
  /// While translated code runs and knows the line of the stack pointer
  /// (translate/Stack.cpp): bytes from the top of lane 0's stack to its stack
  /// pointer, and bytes of a stack.
  uint32_t StackPointerDepth = 0;
  uint32_t StackBytes = 0;
  /// Whether sp may point to a lane's own stack alone, as in launches.
  bool KeepsStacks = false;
  bool AtBarrier = false;
  uint32_t BarrierId = 0;
  uint32_t BarrierCount = 0;

  uint32_t FaultCause = 0; ///< a TrapCause
  uint32_t FaultLane = 0;
  uint32_t FaultAddress = 0;

  Core *Owner = nullptr;
  Watch *Watcher = nullptr; ///< of the observed level
  bool Moved = false; ///< by an observer, which sets it: it goes on elsewhere
  CoreTrace *Trace = nullptr; ///< for the clock, or nullptr

  /// What translated code has no register of the host for
  /// (translate/Narrow.h).
  LaneWords HostSpare[8];

  uint32_t pcOf(const Insn *I) const {
    return CodeLo + static_cast<uint32_t>(I - Code) * 4;
  }
  template <typename T> T &reg(unsigned Offset) {
    return *reinterpret_cast<T *>(reinterpret_cast<std::byte *>(this) + Offset);
  }
  uint32_t *lanes(unsigned Offset) {
    return reinterpret_cast<uint32_t *>(reinterpret_cast<std::byte *>(this) +
                                        Offset);
  }
};

} // namespace vorion::isasim
