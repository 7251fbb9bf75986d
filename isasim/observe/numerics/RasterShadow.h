/// The numeric sanitizer's part in rasterizers and pixel units.
#pragma once

#include "observe/numerics/ShadowMemory.h"
#include "raster/WorkLog.h"
#include "vorion/isasim/Observer.h"

#include <map>
#include <span>
#include <unordered_map>

namespace vorion::isasim {

/// What a stage did in all fragments whose alpha counts, in fp32 or in the
/// shadow.
struct StageCounts {
  uint64_t Results = 0;
  /// Relative errors (of the power, absolute ones), at most 1: against the
  /// stage in double on the operands that it had, and against the shadow of all
  /// that came before.
  double OwnSum = 0, OwnMax = 0, TotalSum = 0, TotalMax = 0;
  uint64_t Differ = 0;    ///< decisions that the shadow takes otherwise
  uint64_t NotFinite = 0; ///< Inf or NaN
  uint64_t Subnormal = 0;
  // Where OwnMax was.
  uint32_t Gaussian = 0;
  unsigned X = 0, Y = 0;
  float Actual = 0;
  double Reference = 0;
};

enum class RasterStage : uint8_t {
#define VORION_RASTER_STAGE(MEMBER, NAME, DECISION) MEMBER,
#include "observe/numerics/RasterStages.def"
  Count
};

struct GaussianCounts {
  uint64_t Fragments = 0;
  double AlphaMax = 0; ///< largest relative error of an alpha
  double Colour = 0;   ///< sum of what it is off by in the picture
  uint64_t Differ = 0; ///< decisions
};

struct PixelFinding {
  unsigned X = 0, Y = 0;
  raster::Pixel Actual;
  double Reference[4] = {}; ///< r, g, b, T
  double Off = 0;           ///< the largest difference of r, g, b
};

struct RasterFindings {
  std::array<StageCounts, static_cast<size_t>(RasterStage::Count)> Stages;
  std::unordered_map<uint32_t, GaussianCounts> Gaussians; ///< by number
  std::vector<PixelFinding> WorstPixels; ///< the worst first, WorstKept of them
  uint64_t Commands = 0, Tails = 0, Pixels = 0;
  double OffSum = 0; ///< of all pixels
  /// Pixels in which the replay has other bits than the unit wrote: a bug of
  /// ours.
  uint64_t NotReplayed = 0;
  static constexpr size_t WorstKept = 100;
};

/// Repeats each command that renders with the unit's own datapath on a tile of
/// its own, and beside it each fragment in double from the shadows of the
/// records. Follows the decisions of the datapath; counts those that the shadow
/// takes otherwise. What the commands write has shadows afterwards.
class RasterShadow : public Observer {
public:
  /// \p Lanes: what the units have.
  RasterShadow(NumericSites &Sites, ShadowMemory &Memory,
               const raster::Datapath &Lanes = *raster::datapaths().back());
  ~RasterShadow() override;

  void runBegins(const RunStart &R) override;
  void rasterCommand(const raster::CommandWork &W) override;
  void tail(const raster::TailWork &W) override;

  /// The same for tests: \p Storage is what the commands see.
  void useMemory(raster::RasterMemory &Storage) { Global = &Storage; }

  const RasterFindings &findings() const { return Found; }

private:
  struct Tile;
  class Replay;

  void finish(const raster::Job &J, const Tile &T);

  ShadowMemory &Memory;
  const raster::Datapath &Lanes;
  uint32_t Site; ///< that its results come from
  RasterFindings Found;
  std::unique_ptr<raster::RasterMemory> Machines;
  raster::RasterMemory *Global = nullptr;
  /// Tiles that the pixel unit goes on with, by core and output.
  std::map<std::pair<unsigned, uint32_t>, std::unique_ptr<Tile>> HandedOver;
};

} // namespace vorion::isasim
