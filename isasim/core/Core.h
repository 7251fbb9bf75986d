/// A SIMT core: its warps, its barriers, what it has printed.
#pragma once

#include "core/CodeTable.h"
#include "core/State.h"
#include "vorion/isasim/Config.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vorion::isasim {

/// Threads: a core belongs to one host thread at a time.
class Core {
public:
  Core(const Config &C, unsigned Id);
  Core(const Core &) = delete;
  Core &operator=(const Core &) = delete;

  /// Warp 0 runs lane 0 at \p Entry, the others have ended; registers are 0.
  /// \p LaunchWarps of each core run groups, 0 if it is no launch.
  void reset(const CodeTable &Code, uint32_t Entry, uint32_t LaunchBlock,
             unsigned LaunchWarps, const MemoryView &View, Watch *Watcher);
  /// Warp \p Warp writes the clock's trace there until the next reset().
  void setTrace(unsigned Warp, CoreTrace *Trace) { Warps[Warp].Trace = Trace; }

  /// Runs every warp until it stops or has used \p Quantum instructions.
  /// \p MustStop is asked now and then; true ends the round where it is.
  void runRound(
      const ExecTable &Exec, uint32_t Quantum,
      const std::function<bool()> &MustStop = [] { return false; });

  /// Runs \p S out of turn, until it stops or has used \p Most instructions;
  /// an atomic does not wait. For observers, also while a warp is running.
  static void runApart(WarpState &S, const ExecTable &Exec, uint64_t Most);

  /// Where a warp was found after it had executed so much without a stop.
  struct Stretch {
    const Insn *End;
    uint64_t Executed; ///< warp instructions
    const WarpState *Of;
  };
  /// Those of the last round, except short ones and the last of a warp.
  std::span<const Stretch> stretches() const { return Stretches; }

  unsigned id() const { return Id; }
  std::span<WarpState> warps() { return Warps; }
  std::span<const WarpState> warps() const { return Warps; }
  /// Whether some warp can go on.
  bool isReady() const;
  /// Whether all warps have ended.
  bool hasEnded() const;
  /// The warps that have, as bits.
  uint32_t endedWarps() const;
  /// Warp instructions retired by all warps.
  uint64_t retired() const;

  /// The parked instruction of \p S has been executed: goes on behind it.
  static void complete(WarpState &S);

  /// The instruction at \p Pc, or the one behind the code, which traps.
  const Insn *find(uint32_t Pc) const { return Code->find(Pc); }

  // For instructions.
  /// vx_wspawn by \p S; false if it trapped, since \p Entry is no code.
  bool spawn(WarpState &S, uint32_t Count, uint32_t Entry);
  bool arrive(WarpState &S, uint32_t Id, uint32_t Count);
  /// Local memory of \p S begins \p Offset bytes behind the core's, as
  /// vx_local_offset says.
  void moveLocal(WarpState &S, uint32_t Offset);
  uint32_t activeWarps() const;
  void print(char Byte) { Console.push_back(Byte); }
  void exitWith(uint32_t Code);

  const Config &Shape;
  uint32_t LaunchBlock = 0;         ///< mscratch
  std::string Console;              ///< not yet handed on
  std::optional<uint32_t> ExitCode; ///< the first that was not 0

private:
  unsigned Id;
  const CodeTable *Code = nullptr;
  std::vector<WarpState> Warps;
  std::vector<Divergence> Stacks;
  std::vector<uint32_t> Arrived; ///< by barrier
  Region Local;
  std::vector<MemoryView> Views; ///< by warp
  std::vector<Stretch> Stretches;
};

} // namespace vorion::isasim
