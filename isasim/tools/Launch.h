/// Sets up one kernel in a machine's memory, and brings its results home.
#pragma once

#include "tools/Arguments.h"
#include "vorion/isasim/Launch.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Session.h"

namespace vorion::isasim {

class KernelLaunch {
public:
  /// Buffers, arguments and launch block of \p Request in the memory of \p M,
  /// whose image is loaded. \p M must outlive the launch. \p Watch is told who
  /// holds which memory.
  static Expected<KernelLaunch>
  prepare(Machine &M, const KernelRequest &Request, Session &Watch);

  /// The kernel's name.
  const std::string &kernel() const { return Name; }
  /// What Machine::run takes.
  uint32_t launchBlock() const { return static_cast<uint32_t>(Parts.Block); }

  /// Prints what the kernel's printf wrote.
  void print() const;
  /// Writes the buffers that have a file.
  Expected<Success> finish() const;

private:
  KernelLaunch(Machine &Device, Session &WatchIn)
      : Device(&Device), Watch(&WatchIn) {}

  Expected<uint32_t> reserve(uint64_t Bytes, const std::string &What);
  Expected<uint32_t> placeBuffer(const KernelInput &In, size_t Argument,
                                 const std::string &ArgName);
  /// The local memory that they and \p K use.
  Expected<uint64_t> packArguments(const Kernel &K, const KernelRequest &R);
  /// Allocates what \p L, a launch of \p K, needs and writes it there.
  Expected<Success> write(const Launch &L, const Kernel &K);

  struct Output {
    std::string File;
    uint32_t Address;
    uint64_t Bytes;
  };

  Machine *Device;
  Session *Watch;
  std::string Name;
  uint64_t NextFree = 0; ///< in global memory or before it; nothing is
                         ///< ever freed
  uint64_t StacksBegin = UINT64_MAX; ///< nothing lies there or behind it
  std::vector<std::byte> Args;       ///< packed
  LaunchParts Parts;                 ///< addresses
  std::vector<Output> Outputs;
  std::vector<GivenMemory> Given;
};

} // namespace vorion::isasim
