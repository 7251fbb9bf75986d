/// Interface of observers, which do not change a run (docs/decisions.md, 9):
/// traces, profiles, checkers and the debugger. Every function is empty by
/// default. The machine does not depend on specific observers.
#pragma once

#include "vorion/isasim/Config.h"
#include "vorion/isasim/Image.h"
#include "vorion/isasim/Result.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vorion::raster {
struct CommandWork;
struct TailWork;
} // namespace vorion::raster

namespace vorion::isasim {

class Core;
class Machine;
struct Decoded;
struct VxLaunch;
struct WarpState;

/// A run that is about to start.
struct RunStart {
  const Config &Shape;
  const std::shared_ptr<const Image> &Program;
  uint32_t LaunchBlock;   ///< its address; 0 for none
  const VxLaunch *Launch; ///< what it holds; nullptr for none
  /// All cores, reset. Their addresses are valid for the lifetime of the
  /// machine.
  std::span<const std::unique_ptr<Core>> Cores;
  Machine *Device;     ///< nullptr where a test runs a core alone
  uint32_t StackBytes; ///< of each lane
  uint64_t Stacks;     ///< bytes of all of them, below VX_STACK_TOP
};

/// The memory access of an instruction.
struct MemoryAccess {
  enum Kind : uint8_t { Load, Store, Atomic } What = Load;
  unsigned Bytes = 0; ///< a lane: 1, 2, 4 or 8
  /// By lane; undefined for inactive lanes.
  std::array<uint32_t, 16> Addresses{};
};

/// An instruction of a warp.
struct Step {
  unsigned Core;
  unsigned Warp;
  uint32_t Pc;
  uint32_t Word;
  uint32_t LaneMask; ///< active lanes before it has executed
  /// Number of warp instructions that the warp has retired before it.
  uint64_t Retired;
  const Decoded &Insn;
  const MemoryAccess *Access; ///< nullptr if it is no load, store or atomic
  /// Complete state of the core, for observers internal to this library
  /// (core/State.h).
  WarpState &State;
};

/// An executed warp instruction. Parked instructions are reported when they
/// complete.
struct Commit : Step {
  /// The destination register by lane, empty if there is none.
  std::span<const uint32_t> Result;
  /// The second register of a register pair, likewise.
  std::span<const uint32_t> HighResult;
  /// A vx_split or vx_pred that diverged.
  bool Diverged;
};

/// Calls are serialized: those during a run are made on the thread that called
/// Machine::run, and those of the host between runs. So observers need no
/// locks.
class Observer {
public:
  virtual ~Observer() = default;

  // Actions of the host. Addresses are in global memory.
  /// \p Name describes the use: "buffer", "the arguments".
  virtual void allocated(uint32_t /*Address*/, uint64_t /*Bytes*/,
                         const std::string & /*Name*/) {}
  virtual void released(uint32_t /*Address*/) {}
  virtual void hostWrote(uint32_t /*Address*/, uint64_t /*Bytes*/) {}
  virtual void hostRead(uint32_t /*Address*/, uint64_t /*Bytes*/) {}
  /// The use of the buffer that contains \p Address in the next run.
  virtual void bufferNamed(uint32_t /*Address*/, const std::string & /*Name*/) {
  }
  /// Size of the local memory of the next run's kernel; initially all local
  /// memory.
  virtual void localUsed(uint64_t /*Bytes*/) {}
  virtual void runNamed(const std::string & /*Name*/) {}

  // Events of a run.
  virtual void runBegins(const RunStart &) {}
  /// The instruction is about to execute. A parked instruction is reported
  /// once.
  virtual void fetch(const Step &) {}
  /// The instruction has executed. One that traps is not committed.
  virtual void commit(const Commit &) {}
  /// Every core has stopped or used its quantum; parked instructions have not
  /// been executed yet (docs/abi.md, "Order").
  virtual void syncPoint(std::span<const std::unique_ptr<Core>> /*Cores*/) {}
  /// A rasterizer has executed a command, or a pixel unit the tail of one
  /// (raster/WorkLog.h, internal to this library).
  virtual void rasterCommand(const raster::CommandWork &) {}
  virtual void tail(const raster::TailWork &) {}
  virtual void trap(const Trap &) {}
  virtual void runEnds(const RunResult &) {}
};

} // namespace vorion::isasim
