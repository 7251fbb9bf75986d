/// What rasterizer and pixel unit have in common in how they execute a command:
/// its list, its rows of pixels.
#pragma once

#include "raster/RasterAgent.h"
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

/// The oldest command of \p Agent, checked and not begun.
CommandWork beginCommand(const RasterAgent &Agent, RasterMemory &Memory);

/// The datapath of \p Lanes that \p J, which was not refused, asks for.
inline Datapath::BlendFunction blendFunction(const Job &J,
                                             const Datapath &Lanes) {
  return Lanes.Blend[expRow(J.Units.Exp)][J.Units.Blend];
}

/// Host address of row \p Row of the output of \p J, or nullptr if it is not
/// all global memory.
std::byte *outputRow(const Job &J, RasterMemory &Memory, unsigned Row);

/// Likewise the row of last contributors of a command that keeps or reads them,
/// and the row of gradients of a backward one.
std::byte *lastRow(const Job &J, RasterMemory &Memory, unsigned Row);
std::byte *upstreamRow(const Job &J, RasterMemory &Memory, unsigned Row);

/// Entries of a list between two looks at whether the run is over or the log is
/// full: of the largest tiles milliseconds.
inline constexpr uint32_t LongestStretch = 4096;

/// One entry of a list, and the record that it names.
struct Fetched {
  Gaussian Record;
  uint32_t Address; ///< of the record
  bool Intersects;
};

/// VR_NAN if a float of \p G is a NaN, else VR_OK.
uint32_t checkGaussian(const Gaussian &G);

/// The list of a command that was not refused.
class GaussianList {
public:
  GaussianList(const Job &J, RasterMemory &Memory);

  /// Reads entry \p I, below vr_count, with its record: VR_OK, VR_UNMAPPED or
  /// VR_NAN.
  uint32_t fetch(uint32_t I, Fetched &Out) const;

private:
  uint32_t entry(uint32_t I) const;
  uint64_t address(uint32_t Entry) const;
  const std::byte *record(uint32_t Entry) const;

  uint32_t Gaussians; ///< address of the records
  uint32_t Count;
  RasterMemory &Memory;
  const std::byte *Entries;
};

} // namespace vorion::raster
