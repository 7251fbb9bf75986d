/// The shape of a simulated machine, and its JSON form.
#pragma once

#include "vorion/isasim/Timing.h"
#include "vorion/support/Expected.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// Options of the rasterizers (one a socket, docs/abi.md).
struct RasterConfig {
  /// Commands a Raster Agent holds; a write of vr_start to a full queue stalls.
  unsigned QueueDepth = 4;
};

/// How the host executes the cores' instructions (docs/adr/0008-translator.md).
enum class Engine : uint8_t {
  Auto, ///< the translator where the host has what it needs
  Interpreter,
  Translator,    ///< without waiting until a translation is worth it
  TranslatorAvx2 ///< the same with AVX2 alone, also where there is AVX-512
};

/// Everything that fixes a machine. The values here are those of the plain
/// machine `prototype-on-chip`, of which the others are made: 2 sockets of 4
/// cores, 16 lanes, one warp a core. Users begin with defaultMachine().
/// \c HostThreads and \c Runs change how fast a run is and nothing else.
struct Config {
  unsigned Clusters = 1;
  unsigned SocketsPerCluster = 2;
  unsigned CoresPerSocket = 4;
  unsigned WarpsPerCore = 1;  ///< 1 to 32
  unsigned LanesPerWarp = 16; ///< 1 to 16
  unsigned Barriers = 16;     ///< barriers a core, and as many for the device
  /// Nested divergent vx_split a warp may hold; one more is a trap.
  unsigned DivergenceDepth = 32;

  /// 0: as many as the memory map has room for (globalBytes() of MemoryMap.h).
  /// The host commits what is touched.
  uint64_t GlobalBytes = 0;
  uint32_t LocalBytes = 32 << 10; ///< a core, at most 64 KiB
  uint32_t StackBytes = 64 << 10; ///< a lane, a power of two from 4 KiB on

  /// Warp instructions a warp runs at most between two points where all cores
  /// are parked (docs/decisions.md, 10). Fixed by the configuration, since a
  /// program that polls memory can see it.
  uint32_t Quantum = 1 << 16;
  /// Warp instructions of the whole device after which a run ends with
  /// Outcome::LimitReached; 0 for no limit. Checked where all cores are parked.
  uint64_t MaxInstructions = 0;
  unsigned HostThreads = 0; ///< 0: as many as the host has
  /// The translator works in runs without observers and without a clock; in
  /// all others the interpreter does. Machine::create() refuses the translator
  /// by name where the host does not have what it needs.
  Engine Runs = Engine::Auto;

  RasterConfig Raster;
  TimingConfig Timing;

  unsigned sockets() const { return Clusters * SocketsPerCluster; }
  unsigned cores() const { return sockets() * CoresPerSocket; }
  unsigned coresPerCluster() const {
    return SocketsPerCluster * CoresPerSocket;
  }
  unsigned socketOf(unsigned Core) const { return Core / CoresPerSocket; }
  unsigned clusterOf(unsigned Core) const { return Core / coresPerCluster(); }
};

/// Checks the ranges above and that the memory map (docs/abi.md) has room.
Expected<Success> validate(const Config &C);

/// The configuration as a JSON object, keys in declaration order.
std::string toJson(const Config &C);

/// The JSON schema (2020-12) of what parseConfig reads.
std::string configSchema();

/// Sets values by "KEY=VALUE,...", where a key in an object is written
/// "raster.queue_depth", or as the end of it that no other key has, or by its
/// short name (machine/ShortKeys.h), and checks the whole. A name that stands
/// for a set of numbers ("machine", "timing.core.preset") sets all of them but
/// those that
/// \p List gives itself. Of a key that it gives twice the last value counts.
Expected<Success> setValues(Config &C, std::string_view List);

/// The short names as a Markdown table.
std::string shortKeysMarkdown();

/// What of \p List, which made \p After of \p Before, changes nothing, and
/// which key is why: a sentence each. Only what is certain for every program.
std::vector<std::string> idleSettings(const Config &Before, const Config &After,
                                      std::string_view List);

/// Reads what toJson writes. Missing keys are those of defaultMachine(), or
/// what a name that stands for a set of numbers says; an unknown key,
/// a wrong type or a value out of range is an error naming the key. \p Where
/// is the file name for messages.
Expected<Config> parseConfig(std::string_view Json, const std::string &Where);

/// \name Machines that have a name (isasim/configs/)
/// The key "machine" sets all but what belongs to a run: the limit of
/// instructions, the quantum, host threads, and whether there is a clock.
/// @{
std::span<const std::string_view> machineNames();
/// The first of machineNames(), which is meant where nobody names a machine.
const Config &defaultMachine();
/// The one of that place in machineNames().
const Config &namedMachine(size_t Number);

/// The values, as setValues() takes them, that make another machine of
/// \p From, as \p To is. The clock does not make another machine.
std::vector<std::string> changesOf(const Config &From, const Config &To);

struct MachineName {
  /// The name of the machine with the fewest changes, the first of these; with
  /// " with changes" if there are any.
  std::string Name;
  std::vector<std::string> Changes;
};
MachineName nameOf(const Config &C);

/// What parseConfig() takes.
struct MachineSource {
  std::string Json, Where;
};
/// The machine that a text says: JSON, if it begins with a brace; the name of
/// a machine, if it has no dot and no slash; else a file. The error is of a
/// file that cannot be read.
Expected<MachineSource> findMachine(const std::string &Text);
/// @}

} // namespace vorion::isasim
