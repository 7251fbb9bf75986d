/// What a rasterizer or a pixel unit did for a command: the clock, observers
/// and checkers are told the same.
#pragma once

#include "raster/Job.h"

#include <cstdint>
#include <vector>

namespace vorion::raster {

/// A Gaussian, or another primitive, that was fetched.
struct GaussianWork {
  uint32_t Address; ///< of its record, 0 for a pushed one
  /// Its box cut to the tile, in pixels of the tile; Width 0 if it misses.
  uint8_t X, Y, Width, Height;
  uint16_t Slots;  ///< pixels given to lanes
  bool SpansTiles; ///< the entry's or the tag's intersect bit
  /// Of the tile's blocks of 4 x 4 pixels those that WorkLog::blockTests()
  /// leaves of the box.
  uint16_t Blocks = 0;
  /// Of the box's pixels, a Gaussian's that are in these blocks, or an opaque
  /// primitive's that were handed over.
  uint16_t ChosenPixels = 0;
};

/// A command that a rasterizer has executed.
struct CommandWork {
  unsigned Core = 0; ///< who started it
  Job What;
  uint32_t Status = VR_OK; ///< any other: nothing is written
  bool HandedOver = false; ///< the pixel unit goes on
  uint32_t Saturated = 0;  ///< pixels of the tile that took no more
  Counters Counts;
  /// Entries of its list that a backward command goes through, from this one
  /// down to the first.
  uint32_t Entries = 0;
  /// The entry of its list that any other fetches first.
  uint32_t First = 0;
  /// In the order of the fetches, up to one that cannot be blended; without
  /// those of earlier parts. Empty where nobody wants them.
  std::vector<GaussianWork> Gaussians;
  std::vector<Gaussian> Pushed; ///< what the command took

  bool hasFailed() const { return Status != VR_OK; }
};

/// A hand-over that a pixel unit has executed.
struct TailWork {
  /// A pixel that was not saturated.
  struct OpenPixel {
    uint8_t X, Y;    ///< in the tile
    uint32_t Visits; ///< Gaussians that it examined
  };
  unsigned Core = 0;   ///< who started the command
  uint32_t Record = 0; ///< address of the vx_tail
  Job What;            ///< as that says
  uint32_t Status = VR_OK;
  uint32_t Saturated = 0; ///< of the pixels taken over, those that took no more
  Counters Counts;
  std::vector<uint32_t> Records; ///< of Gaussians, in the list's order
  std::vector<OpenPixel> Pixels; ///< in rows
};

/// Receives what has been executed, on the thread that executed it: one at a
/// time for each rasterizer and each pixel unit.
class WorkLog {
public:
  virtual ~WorkLog() = default;
  /// The command has been executed. Of a backward one, the last batch may not
  /// have been taken.
  virtual void command(CommandWork &&Work) = 0;
  virtual void tail(TailWork &&Work) = 0;

  /// Whether the fetches are wanted: Gaussians, Records and Pixels.
  virtual bool wantsFetches() const { return false; }
  /// Only then: what has been fetched of a command, of which there is more to
  /// come. Of \p Begun nothing is known but Core, What, Entries and First.
  virtual void part(const CommandWork & /*Begun*/,
                    std::vector<GaussianWork> && /*Fetched*/) {}
  /// Whether the rasterizer, or the pixel unit, of core \p Core may go on.
  /// Otherwise it does after the log has made room.
  virtual bool hasRoom(unsigned /*Core*/) const { return true; }
  virtual bool hasRoomForTail(unsigned /*Core*/) const { return true; }

  /// Tests of blocks (BlockTest) whose results are wanted.
  virtual unsigned blockTests() const { return 0; }
};

} // namespace vorion::raster
