/// What every unit of the machine did in which cycles of the clock
/// (docs/profiling.md, "Timeline").
#pragma once

#include "observe/TraceEvents.h"
#include "timing/common/TimeObserver.h"
#include "vorion/isasim/Config.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vorion::isasim {

class EnergyModel;

/// A run is divided into windows of equal length, as many cycles as it takes
/// to have at most MaxWindows of them. A core, a rasterizer, a pixel unit, the
/// command processor or a DMA engine has a slice for neighbouring windows in
/// which the same reason took most cycles, with the cycles of all reasons. A
/// bank, a channel or a direction of the link has a figure that changes from
/// window to window.
class CycleTimeline final : public TimeObserver {
public:
  static constexpr size_t MaxWindows = 1024;
  static constexpr uint64_t ShortestWindow = 16; ///< cycles
  /// From so many events on, a run is no more than its slice.
  static constexpr uint64_t MaxEvents = 1'000'000;

  /// \p Out as for TraceEvents, which is empty so far.
  /// \p Energy is the model of the chip's power. Null: the default
  /// technology's.
  CycleTimeline(std::FILE *Out, const Config &Shape,
                std::shared_ptr<const EnergyModel> Energy = nullptr);

  void timeBegins(uint64_t Now) override;
  void coreSpent(const CoreSpent &S) override;
  void rasterSpent(unsigned Socket, RasterCycle What, CycleSpan When) override;
  void pixelSpent(unsigned Cluster, PixelCycle What, CycleSpan When) override;
  void linkBusy(bool IsToL2, CycleSpan When) override;
  void commandSpent(CommandCycle What, CycleSpan When) override;
  void dmaSpent(unsigned Engine, DmaCycle What, CycleSpan When) override;
  void bankBusy(BankPlace Where, CycleSpan When) override;
  void dramCommand(unsigned Channel, const dram::Issued &What,
                   CycleSpan Data) override;
  void timeEnds(uint64_t Now) override { End = Now; }

  /// Writes the run, which is called \p Name, if the clock took it; the file is
  /// complete. With \p Time also the chip's power.
  void runEnded(const std::string &Name, const TimeReport *Time = nullptr);

private:
  /// A row of the picture.
  struct Row {
    unsigned Process, Thread;
    std::string Name;
    size_t Reasons;
    std::function<std::string_view(size_t)> NameOf;
    std::vector<uint32_t> Cycles; ///< by window and reason
    /// Of one that has a figure: the last figure, in tenths of a per cent.
    uint64_t Shown = 0;
  };
  template <typename Reason>
  void addUnits(std::vector<Row> &To, unsigned Process, const char *Of,
                unsigned Count);
  void addBanks(std::vector<Row> &To, unsigned Process, const std::string &Of,
                unsigned Count);
  void addShare(std::vector<Row> &To, unsigned Process, const std::string &Of);
  void add(Row &R, size_t Reason, CycleSpan When);
  void widen();
  void writeUnit(const Row &R);
  void writeShare(Row &R);
  void writePower(const TimeReport &Time);
  uint64_t beginOf(size_t Window) const {
    return std::min(Origin + Window * WindowCycles, End);
  }
  bool isFull() const { return Out.events() >= MaxEvents; }

  std::shared_ptr<const EnergyModel> Energy;
  TraceEvents Out;
  std::vector<Row> Cores, Rasters, Pixels;
  std::vector<Row> Link; ///< to the L2 and back, if the machine has one
  std::vector<Row> Commands, Dmas; ///< if the machine has them
  std::vector<Row> L2, Llc, Channels;
  const unsigned L2Banks;
  uint64_t ShownPower = 0;      ///< mW
  uint64_t Origin = 0, End = 0; ///< of the run
  uint64_t WindowCycles = ShortestWindow;
};

} // namespace vorion::isasim
