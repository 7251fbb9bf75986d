/// The configuration of a simulated machine, and its JSON form.
#pragma once

#include "vorion/isasim/Timing.h"
#include "vorion/support/Expected.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// Options of the rasterizers (one per socket, docs/abi.md).
struct RasterConfig {
  /// Depth of a Raster Agent's command queue; a write of vr_start to a full
  /// queue stalls.
  unsigned QueueDepth = 4;
};

/// How the host executes the cores' instructions (docs/adr/0008-translator.md).
enum class Engine : uint8_t {
  Auto, ///< the translator where the host has what it needs
  Interpreter,
  Translator,    ///< without waiting until a translation is worth it
  TranslatorAvx2 ///< the same with AVX2 alone, also where there is AVX-512
};

/// The complete configuration of a machine. The initial values are those of the
/// base machine `prototype-on-chip`, from which the others are derived: 2
/// sockets of 4 cores, 16 lanes, one warp per core. Users start from
/// defaultMachine(). \c HostThreads and \c Runs affect only simulation speed.
struct Config {
  unsigned Clusters = 1;
  unsigned SocketsPerCluster = 2;
  unsigned CoresPerSocket = 4;
  unsigned WarpsPerCore = 1;  ///< 1 to 32
  unsigned LanesPerWarp = 16; ///< 1 to 16
  unsigned Barriers = 16;     ///< barriers a core, and as many for the device
  /// Capacity of a warp's divergence stack; an overflow traps.
  unsigned DivergenceDepth = 32;

  /// 0: the maximum of the memory map (globalBytes() of MemoryMap.h). The host
  /// commits only touched pages.
  uint64_t GlobalBytes = 0;
  uint32_t LocalBytes = 32 << 10; ///< a core, at most 64 KiB
  uint32_t StackBytes = 64 << 10; ///< a lane, a power of two from 4 KiB on

  /// Maximum number of warp instructions that a warp executes between two
  /// points where all cores are parked (docs/decisions.md, 10). Part of the
  /// configuration, since a program that polls memory can observe it.
  uint32_t Quantum = 1 << 16;
  /// Warp instructions of all cores after which a run stops with
  /// Outcome::LimitReached; 0 for no limit. Checked where all cores are parked.
  uint64_t MaxInstructions = 0;
  unsigned HostThreads = 0; ///< 0: as many as the host has
  /// The translator is used in runs without observers and clock; other runs use
  /// the interpreter. Machine::create() rejects an explicit translator on a
  /// host that does not support it.
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

/// Checks the ranges above and that the configuration fits in the memory map
/// (docs/abi.md).
Expected<Success> validate(const Config &C);

/// The configuration as a JSON object, keys in declaration order.
std::string toJson(const Config &C);

/// The JSON schema (2020-12) of what parseConfig reads.
std::string configSchema();

/// Sets values from "KEY=VALUE,...", and validates the result. A key is a path
/// ("raster.queue_depth"), an unambiguous suffix of one, or a short name
/// (machine/ShortKeys.h). A name of a set of values ("machine",
/// "timing.core.preset") sets all of them except those that
/// \p List sets explicitly. The last value of a repeated key is used.
Expected<Success> setValues(Config &C, std::string_view List);

/// The short names as a Markdown table.
std::string shortKeysMarkdown();

/// One sentence for each setting in \p List, which changed \p Before to \p
/// After, that has no effect for any program, with the key that is the reason.
std::vector<std::string> idleSettings(const Config &Before, const Config &After,
                                      std::string_view List);

/// Parses the output of toJson(). Missing keys have the values of
/// defaultMachine(), or of a named set of values; an unknown key, a wrong type
/// or a value out of range is an error that names the key. \p Where is the file
/// name for messages.
Expected<Config> parseConfig(std::string_view Json, const std::string &Where);

/// \name Named machines (isasim/configs/)
/// The key "machine" sets all values except those of a run: the instruction
/// limit, the quantum, host threads, and whether timing is enabled.
/// @{
std::span<const std::string_view> machineNames();
/// The default machine, the first of machineNames().
const Config &defaultMachine();
/// The machine with this index in machineNames().
const Config &namedMachine(size_t Number);

/// The settings, in the syntax of setValues(), that change the machine \p From
/// to \p To. The clock frequency is not compared.
std::vector<std::string> changesOf(const Config &From, const Config &To);

struct MachineName {
  /// The name of the machine with the fewest changes, the first of these; with
  /// " with changes" if there are any.
  std::string Name;
  std::vector<std::string> Changes;
};
MachineName nameOf(const Config &C);

/// A configuration text, and the file name for messages, as arguments of
/// parseConfig().
struct MachineSource {
  std::string Json, Where;
};
/// The machine described by a text: JSON if it begins with a brace; the name of
/// a machine if it has no dot and no slash; else a file. Error: the file cannot
/// be read.
Expected<MachineSource> findMachine(const std::string &Text);
/// @}

} // namespace vorion::isasim
