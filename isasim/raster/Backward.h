/// The way back of one Gaussian through a tile (docs/abi.md, "Backward"). There
/// is one source, compiled for several vector levels of the host; all give the
/// same bits.
#pragma once

#include "raster/BoxWork.h"
#include "raster/Command.h"
#include "raster/Datapath.h"
#include "raster/PluggedExp.h"
#include "raster/UnitTables.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace vorion::raster {

/// The pixel buffer in the backward mode, planes of VR_MAX_TILE columns a row:
/// six words a pixel, of at most VR_MAX_BACKWARD pixels.
struct BackwardBuffer {
  static constexpr unsigned Stride = VR_MAX_TILE;
  static constexpr unsigned Pixels = VR_MAX_TILE * VR_MAX_TILE;

  alignas(64) float R[Pixels]; ///< dL/dr, dL/dg, dL/db
  alignas(64) float G[Pixels];
  alignas(64) float B[Pixels];
  /// Transmittance in front of the last Gaussian that was gone through.
  alignas(64) float T[Pixels];
  /// What lies behind it, weighted by the gradient: colour . dL/dpixel.
  alignas(64) float Behind[Pixels];
  /// Entries of the list that the pixel takes part in, from the first.
  alignas(64) uint32_t Last[Pixels];
  /// Pixel centres; NaN outside the tile, which no box contains.
  alignas(64) float CentreX[Stride];
  alignas(64) float CentreY[Stride];
  uint32_t RowLast[Stride]; ///< the largest of a row

  /// An empty tile of \p Width x \p Height pixels at picture coordinates \p X,
  /// \p Y: all planes 0.
  void reset(unsigned X, unsigned Y, unsigned Width, unsigned Height);
};

/// What a command chooses in the datapath, and which entry of its list goes
/// through.
struct BackwardOptions {
  Reciprocal Unit = Reciprocal::Exact;
  bool ClampStops = false;
  bool InRows = false;
  bool SkipSaturated = false;
  RayFalloff Falloff{};
  float MinAlpha = 1.0F / 255.0F; ///< the smallest that is blended
  uint32_t Entry = 0;
};

/// Takes one primitive (no NaN) through a tile and writes its sums.
template <typename Record>
using BackFunction = BoxWork (*)(const Record &, const BackwardOptions &,
                                 BackwardBuffer &, GradientSums &);

/// One compilation of the datapath.
struct BackwardDatapath {
  const char *Name;
  bool (*HostSupports)();
  /// \name By expRow()
  /// @{
  BackFunction<Gaussian> Conics[ExpRowCount];
  BackFunction<RayGaussian> Rays[ExpRowCount];
  BackFunction<RayGaussian> Surfels[ExpRowCount]; ///< rays with the low pass
  /// @}
  /// The reciprocal unit alone, in place, \p Count a multiple of 16.
  void (*Reciprocals)(Reciprocal Unit, float *Values, std::size_t Count);
};

/// The datapaths that this host can run, the fastest last.
std::span<const BackwardDatapath *const> backwardDatapaths();

} // namespace vorion::raster
