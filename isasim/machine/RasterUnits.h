/// The machine's rasterizers and pixel units, and the Raster Agents of its
/// cores.
#pragma once

#include "core/Csr.h"
#include "mem/Memory.h"
#include "pixel/PixelUnit.h"
#include "raster/Rasterizer.h"
#include "vorion/isasim/Config.h"
#include "vorion/isasim/Result.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vorion::isasim {

class RasterUnits {
public:
  /// Keeps references to both. Where \p IsOver says true, commands end early
  /// and their results are not to be used.
  RasterUnits(const Config &C, Memory &Storage, std::function<bool()> IsOver);

  /// Executes the CSR instruction at which \p S of core \p Core is parked;
  /// false if it has to wait until runUnit() has made room or finished.
  bool access(unsigned Core, WarpState *S, const CsrAccess &A);

  /// \p Receiver is told of every command and hand-over; nullptr for nobody.
  void setLog(raster::WorkLog *Receiver);

  unsigned units() const { return static_cast<unsigned>(Units.size()); }
  unsigned pixelUnits() const {
    return static_cast<unsigned>(PixelUnits.size());
  }
  /// Whether a rasterizer can go on with a command.
  bool canRun() const;
  /// Executes commands of rasterizer \p N: all, or until the log has no room.
  /// Different rasterizers may run at the same time.
  void runUnit(unsigned N);

  /// Gives the pixel units what the rasterizers handed over, in the order of
  /// sockets.
  void handOver();
  bool canRunPixelUnits() const;
  /// Executes what pixel unit \p N has been given: all, or until the log has no
  /// room. Different ones may run at the same time.
  void runPixelUnit(unsigned N);

  std::optional<uint32_t> hostRead(unsigned Core, unsigned Number);
  bool hostWrite(unsigned Core, unsigned Number, uint32_t Value);

  /// What is kept from one run to the next, as bytes; none while a command is
  /// under way.
  std::optional<std::vector<std::byte>> state() const;
  /// Goes on with what units of the same shape had; false, and reset, if
  /// \p State is none of those.
  bool setState(std::span<const std::byte> State);

  /// Agents and rasterizers as they were at the beginning.
  void reset();
  /// Sums over all agents, since the last reset().
  RasterCounters counters() const;

private:
  /// As runUnit(), whatever the log says.
  void finishUnit(unsigned N);

  struct GlobalMemory final : raster::RasterMemory {
    GlobalMemory(Memory &StorageIn, std::function<bool()> IsOverIn)
        : Storage(StorageIn), Over(std::move(IsOverIn)) {}
    std::byte *range(uint32_t Addr, uint64_t Bytes) override {
      return Storage.writable(Addr, Bytes);
    }
    bool isOver() override { return Over(); }
    Memory &Storage;
    std::function<bool()> Over;
  };

  const Config &Shape;
  GlobalMemory View;
  std::vector<std::unique_ptr<raster::RasterAgent>> Agents;  ///< by core
  std::vector<std::unique_ptr<raster::Rasterizer>> Units;    ///< by socket
  std::vector<std::unique_ptr<pixel::PixelUnit>> PixelUnits; ///< by cluster
  raster::WorkLog *Log = nullptr;
};

} // namespace vorion::isasim
