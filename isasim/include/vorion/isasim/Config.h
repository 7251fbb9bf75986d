/// The shape of a simulated machine, and its JSON form.
#pragma once

#include "vorion/isasim/Timing.h"
#include "vorion/support/Expected.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace vorion::isasim {

/// Options of the rasterizers (one a socket, docs/abi.md).
struct RasterConfig {
  /// Commands a Raster Agent holds; a write of vr_start to a full queue stalls.
  unsigned QueueDepth = 4;
};

/// Everything that fixes a machine. The defaults are the paper's prototype:
/// 2 sockets of 4 cores, 16 lanes, one warp a core. \c HostThreads changes how
/// fast a run is and nothing else.
struct Config {
  unsigned Clusters = 1;
  unsigned SocketsPerCluster = 2;
  unsigned CoresPerSocket = 4;
  unsigned WarpsPerCore = 1;  ///< 1 to 32
  unsigned LanesPerWarp = 16; ///< 1 to 16
  unsigned Barriers = 16;     ///< barriers a core, and as many for the device
  /// Nested divergent vx_split a warp may hold; one more is a trap.
  unsigned DivergenceDepth = 32;

  uint64_t GlobalBytes = uint64_t{1} << 30; ///< committed when first touched
  uint32_t LocalBytes = 32 << 10;           ///< a core, at most 64 KiB
  uint32_t StackBytes = 64 << 10; ///< a lane, a power of two from 4 KiB on

  /// Warp instructions a warp runs at most between two points where all cores
  /// are parked (docs/decisions.md, 10). Fixed by the configuration, since a
  /// program that polls memory can see it.
  uint32_t Quantum = 1 << 16;
  /// Warp instructions of the whole device after which a run ends with
  /// Outcome::LimitReached; 0 for no limit. Checked where all cores are parked.
  uint64_t MaxInstructions = 0;
  unsigned HostThreads = 0; ///< 0: as many as the host has

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
/// "raster.queue_depth", from left to right, and checks the whole. A name that
/// stands for a set of numbers ("timing.core.preset") sets all of them.
Expected<Success> setValues(Config &C, std::string_view List);

/// Reads what toJson writes. Missing keys keep their default, or what a name
/// that stands for a set of numbers says; an unknown key,
/// a wrong type or a value out of range is an error naming the key. \p Where
/// is the file name for messages.
Expected<Config> parseConfig(std::string_view Json, const std::string &Where);

} // namespace vorion::isasim
