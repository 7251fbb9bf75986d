/// What rasterizer and pixel unit have in common in how they take a command:
/// its checks, its list, its rows of pixels.
#pragma once

#include "raster/Command.h"
#include "raster/Datapath.h"
#include "raster/RasterMemory.h"
#include "raster/WorkLog.h"

#include <cfenv>

namespace vorion::raster {

/// fp32 with default rounding whatever the core was doing on this host thread,
/// and none of our exceptions in its fcsr.
class DefaultFloatEnvironment {
public:
  DefaultFloatEnvironment() {
    std::fegetenv(&Saved);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatEnvironment() { std::fesetenv(&Saved); }
  DefaultFloatEnvironment(const DefaultFloatEnvironment &) = delete;
  DefaultFloatEnvironment &operator=(const DefaultFloatEnvironment &) = delete;

private:
  std::fenv_t Saved;
};

/// The status code of \p C before anything is blended: all checks of
/// docs/rasterizer.md#status-codes but those of list entries.
std::uint32_t checkCommand(const Command &C, RasterMemory &Memory);

/// The smallest alpha that \p C blends.
float leastAlpha(const Command &C);

/// The datapath's part of vr_options and vr_cutoff.
BlendOptions blendOptions(const Command &C);

/// The datapath that vr_options of a checked command asks for.
Datapath::BlendFunction blendFunction(const Command &C, const Datapath &Lanes);

/// The units that it has, for the log of the work.
LaneUnits laneUnits(const Command &C);

/// Host address of row \p Row of the output of a checked \p C, or nullptr if it
/// is not all global memory.
std::byte *outputRow(const Command &C, RasterMemory &Memory, unsigned Row);

/// Likewise the row of last contributors of a command that keeps or reads them,
/// and the row of gradients of a backward one.
std::byte *lastRow(const Command &C, RasterMemory &Memory, unsigned Row);
std::byte *upstreamRow(const Command &C, RasterMemory &Memory, unsigned Row);

/// One entry of a list, and the record that it names.
struct Fetched {
  Gaussian Record;
  std::uint32_t Address; ///< of the record
  bool Intersects;
};

/// VR_NAN if a float of \p G is a NaN, else VR_OK.
std::uint32_t checkGaussian(const Gaussian &G);

/// The list of a checked command.
class GaussianList {
public:
  GaussianList(const Command &C, RasterMemory &Memory);

  /// Reads entry \p I, below vr_count, with its record: VR_OK, VR_UNMAPPED or
  /// VR_NAN.
  std::uint32_t fetch(std::uint32_t I, Fetched &Out) const;

private:
  std::uint32_t entry(std::uint32_t I) const;
  std::uint64_t address(std::uint32_t Entry) const;
  const std::byte *record(std::uint32_t Entry) const;

  const Command &C;
  RasterMemory &Memory;
  const std::byte *Entries;
};

} // namespace vorion::raster
