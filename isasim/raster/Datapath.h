/// The blend of one primitive into a tile (docs/abi.md, "Rasterizer"). There is
/// one source, compiled for several vector levels of the host; all give the
/// same bits.
#pragma once

#include "raster/BoxWork.h"
#include "raster/PluggedExp.h"
#include "raster/UnitTables.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace vorion::raster {

struct Pixel;

/// The pixel buffer of a whole tile, planes of VR_MAX_TILE columns a row.
struct TileBuffer {
  static constexpr unsigned Stride = VR_MAX_TILE;
  static constexpr unsigned Pixels = VR_MAX_TILE * VR_MAX_TILE;

  alignas(64) float R[Pixels];
  alignas(64) float G[Pixels];
  alignas(64) float B[Pixels];
  /// Transmittance; the sign bit is set once the pixel is saturated.
  alignas(64) float T[Pixels];
  /// Entries of the list up to and with the last one blended, where the command
  /// keeps them.
  alignas(64) uint32_t Last[Pixels];
  /// Pixel centres; NaN outside the tile, which no box contains.
  alignas(64) float CentreX[Stride];
  alignas(64) float CentreY[Stride];
  /// Pixels of each row that are not saturated, and their sum.
  uint32_t RowLive[Stride];
  uint32_t Live;

  /// Colour 0 and transmittance 1 for a tile of \p Width x \p Height pixels
  /// (1 to VR_MAX_TILE each) at picture coordinates \p X, \p Y.
  void reset(unsigned X, unsigned Y, unsigned Width, unsigned Height);

  /// Gives an open pixel of the tile the content \p P; the sign of its
  /// transmittance says whether it is saturated.
  void set(unsigned Row, unsigned Column, const Pixel &P);
};

/// How the density of a Gaussian that rays meet falls off from its centre.
struct RayFalloff {
  bool IsDegree4 = false; ///< by exp(-q^2 / 18)
  bool IsLowPass = false; ///< q is at most that of a blur on the picture
};

/// What a command chooses in the datapath.
struct BlendOptions {
  /// A pixel is saturated if its transmittance would fall below this.
  float StopBelow;
  /// The smallest alpha that is blended.
  float MinAlpha;
  bool SkipSaturated;
  RayFalloff Falloff{};
  /// Whether TileBuffer::Last gets Entry + 1, for the entry of the list that is
  /// blended next.
  bool KeepLast = false;
  uint32_t Entry = 0;
};

/// Blends one primitive (no NaN) into a tile.
template <typename Record>
using BlendFunction = BoxWork (*)(const Record &, const BlendOptions &,
                                  TileBuffer &);

/// By expRow() and vr_options.blend.
template <typename Record> struct BlendTable {
  BlendFunction<Record> Of[ExpRowCount][BlendUnitCount];
};

/// One compilation of the datapath.
struct Datapath {
  const char *Name;
  bool (*HostSupports)();
  BlendTable<Gaussian> Conics;
  BlendTable<RayGaussian> Rays;
  /// By expRow(): the unit alone, in place, \p Count a multiple of 16.
  void (*Exp[ExpRowCount])(float *Values, std::size_t Count);
  /// By vr_options.blend: rounds what a multiplication takes, in place.
  void (*Operand[BlendUnitCount])(float *Values, std::size_t Count);
};

/// The datapaths that this host can run, the fastest last.
std::span<const Datapath *const> datapaths();

} // namespace vorion::raster
