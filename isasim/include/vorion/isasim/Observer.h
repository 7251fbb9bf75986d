/// What watches a run without changing it (docs/decisions.md, 9): one interface
/// for traces, profiles, checkers and the debugger. Every function does nothing
/// by default. The machine knows no observer by name.
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

/// What is about to run.
struct RunStart {
  const Config &Shape;
  const std::shared_ptr<const Image> &Program;
  uint32_t LaunchBlock;   ///< its address; 0 for none
  const VxLaunch *Launch; ///< what it holds; nullptr for none
  /// All cores, reset. Stay where they are as long as the machine.
  std::span<const std::unique_ptr<Core>> Cores;
  Machine *Device;     ///< nullptr where a test runs a core alone
  uint32_t StackBytes; ///< of each lane
  uint64_t Stacks;     ///< bytes of all of them, below VX_STACK_TOP
};

/// The memory that one instruction accesses.
struct MemoryAccess {
  enum Kind : uint8_t { Load, Store, Atomic } What = Load;
  unsigned Bytes = 0; ///< a lane: 1, 2, 4 or 8
  /// By lane; those of lanes that are not active say nothing.
  std::array<uint32_t, 16> Addresses{};
};

/// An instruction of a warp.
struct Step {
  unsigned Core;
  unsigned Warp;
  uint32_t Pc;
  uint32_t Word;
  uint32_t LaneMask; ///< active lanes before it has executed
  /// Warp instructions that the warp has retired before it.
  uint64_t Retired;
  const Decoded &Insn;
  const MemoryAccess *Access; ///< nullptr if it is no load, store or atomic
  /// Registers and all else, for observers of this library (core/State.h).
  WarpState &State;
};

/// A warp instruction that has been executed. Instructions that wait for other
/// cores are reported when they complete.
struct Commit : Step {
  /// The destination register by lane, empty if there is none.
  std::span<const uint32_t> Result;
  /// Likewise the register behind it, where the two are a pair.
  std::span<const uint32_t> HighResult;
  /// A vx_split or vx_pred whose lanes went different ways.
  bool Diverged;
};

/// Calls come one at a time, those of a run on the thread that called
/// Machine::run and those of the host between runs, so that no observer needs a
/// lock.
class Observer {
public:
  virtual ~Observer() = default;

  // What the host does. Addresses are of global memory.
  /// \p Name says what for: "buffer", "the arguments".
  virtual void allocated(uint32_t /*Address*/, uint64_t /*Bytes*/,
                         const std::string & /*Name*/) {}
  virtual void released(uint32_t /*Address*/) {}
  virtual void hostWrote(uint32_t /*Address*/, uint64_t /*Bytes*/) {}
  virtual void hostRead(uint32_t /*Address*/, uint64_t /*Bytes*/) {}
  /// What the buffer that holds \p Address is for the next run.
  virtual void bufferNamed(uint32_t /*Address*/, const std::string & /*Name*/) {
  }
  /// Local memory that the next run's kernel has; at first, all there is.
  virtual void localUsed(uint64_t /*Bytes*/) {}
  virtual void runNamed(const std::string & /*Name*/) {}

  // What a run does.
  virtual void runBegins(const RunStart &) {}
  /// The instruction is about to execute. One that waits is fetched once.
  virtual void fetch(const Step &) {}
  /// It has executed. One that traps is fetched and never committed.
  virtual void commit(const Commit &) {}
  /// Every core has stopped or used its quantum; what waits has not been
  /// executed yet (docs/abi.md, "Order").
  virtual void syncPoint(std::span<const std::unique_ptr<Core>> /*Cores*/) {}
  /// A rasterizer has executed a command, or a pixel unit the rest of one
  /// (raster/WorkLog.h, for observers of this library).
  virtual void rasterCommand(const raster::CommandWork &) {}
  virtual void tail(const raster::TailWork &) {}
  virtual void trap(const Trap &) {}
  virtual void runEnds(const RunResult &) {}
};

} // namespace vorion::isasim
