/// What a rasterizer did for a command, in enough detail to say how long it
/// took (isasim/timing/).
#pragma once

#include <cstdint>
#include <vector>

namespace vorion::raster {

/// The units of a lane that vr_options chooses.
struct LaneUnits {
  std::uint8_t Exp = 0;   ///< vr_options.exp
  std::uint8_t Blend = 0; ///< vr_options.blend
};

/// A Gaussian that was fetched.
struct GaussianWork {
  std::uint32_t Address; ///< of its record, 0 for a pushed one
  /// Its box cut to the tile, in pixels of the tile; Width 0 if it misses.
  std::uint8_t X, Y, Width, Height;
  std::uint16_t Slots; ///< pixels given to lanes
  bool SpansTiles;     ///< the tag's intersect bit
};

struct CommandWork {
  std::uint32_t List = 0; ///< address of the index list, 0 for pushed ones
  std::uint32_t Output = 0, OutputPitch = 0;
  std::uint16_t Width = 0, Height = 0;
  LaneUnits Units;
  bool Drains = false; ///< to the agent, not to memory
  bool Failed = false; ///< writes nothing
  std::vector<GaussianWork> Gaussians;
  /// Address of the vx_tail with which the pixel unit goes on, 0 if it does
  /// not.
  std::uint32_t TailRecord = 0;
  /// Address of the last contributors, 0 if none are kept or read.
  std::uint32_t Last = 0;

  /// \name Of a backward command
  /// @{
  bool Backward = false; ///< Gaussians are in the order of the fetches
  std::uint8_t Reciprocal = 0;
  std::uint32_t Upstream = 0; ///< address of the pixels' gradients
  /// @}
};

/// What a pixel unit did for a hand-over.
struct TailWork {
  struct OpenPixel {
    std::uint8_t X, Y;    ///< in the tile
    std::uint32_t Visits; ///< Gaussians that it examined
  };
  std::uint32_t Record = 0; ///< address of the vx_tail
  std::uint32_t List = 0;   ///< of its first entry
  std::uint32_t Output = 0, OutputPitch = 0;
  LaneUnits Units;
  std::vector<std::uint32_t> Records; ///< of Gaussians, in the list's order
  std::vector<OpenPixel> Pixels;      ///< in rows
};

/// Receives the work of every command when it has been executed, on the thread
/// that executes it: one at a time for each rasterizer.
class WorkLog {
public:
  virtual ~WorkLog() = default;
  /// \p Agent: place among the rasterizer's agents.
  virtual void command(unsigned Agent, CommandWork &&Work) = 0;
  /// Likewise of every hand-over of core \p Core, one at a time for each pixel
  /// unit.
  virtual void tail(unsigned Core, TailWork &&Work) = 0;
};

} // namespace vorion::raster
