/// The machine as gdb sees it: lanes are threads, with registers and memory.
#pragma once

#include "core/State.h"
#include "vorion/isasim/Observer.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vorion::isasim::gdb {

/// A lane: 1 + (core * warps + warp) * lanes + lane.
using ThreadId = uint32_t;

/// Numbers of registers, as gdb counts RISC-V's.
enum : unsigned { RaNumber = 1, SpNumber = 2, PcNumber = 32 };

/// A register's word before the debugger wrote it.
struct RegisterWrite {
  uint32_t *Word;
  uint32_t Before;
};

class Target {
public:
  void begin(const RunStart &R);

  ThreadId threadOf(const WarpState &S, unsigned Lane) const;
  /// Nullptr for a number that no lane has.
  WarpState *warpOf(ThreadId T) const;
  unsigned laneOf(ThreadId T) const { return (T - 1) % Lanes; }
  bool isActive(ThreadId T) const;
  /// Whether its warp has not ended.
  bool isAlive(ThreadId T) const;
  ThreadId numThreads() const { return Warps * Lanes; }
  /// "core 0, warp 0, lane 3, active".
  std::string describe(ThreadId T) const;
  unsigned coreOf(ThreadId T) const { return (T - 1) / Lanes / WarpsPerCore; }

  /// All registers, in the description's order.
  std::string registers(ThreadId T) const;
  std::optional<uint32_t> readRegister(ThreadId T, unsigned Number) const;
  /// Not for pc and what identifies the lane, unless it has the value already.
  bool writeRegister(ThreadId T, unsigned Number, uint32_t Value);
  /// The words of x and f registers that were written since the last call.
  std::vector<RegisterWrite> takeWrites() { return std::exchange(Writes, {}); }
  static void undo(const std::vector<RegisterWrite> &Writes);
  /// \p T says that it is at \p Pc, though its warp is not.
  void showPc(ThreadId T, uint32_t Pc) { Shown[T] = Pc; }
  void showOwnPcs() { Shown.clear(); }
  /// As many bytes as are mapped from \p Address on.
  std::string readMemory(ThreadId T, uint32_t Address, uint32_t Bytes) const;
  /// Not to code, which is decoded once.
  bool writeMemory(ThreadId T, uint32_t Address, std::string_view Bytes);

  static std::string description();
  const Image &program() const { return **Program; }
  Machine &device() const { return *Device; }

private:
  uint32_t pc(ThreadId T) const;

  Machine *Device = nullptr;
  const std::shared_ptr<const Image> *Program = nullptr;
  std::span<const std::unique_ptr<Core>> Cores;
  unsigned WarpsPerCore = 1, Lanes = 1, Warps = 0;
  std::vector<RegisterWrite> Writes;
  std::map<ThreadId, uint32_t> Shown;
};

} // namespace vorion::isasim::gdb
