// What a report has as activities: how often each unit of the machine did what,
// which energy is counted by (docs/energy.md).
#include "raster/BlockTests.h"
#include "timing/Clock.h"
#include "timing/common/DatapathUnits.h"
#include "timing/dram/TimingTable.h"

#include <algorithm>

namespace vorion::isasim {

void Clock::collectActivities(TimeReport &R) const {
  const auto Add = [&R](std::string_view Unit, std::string_view Event,
                        uint64_t Count) {
    R.Activities.push_back({Unit, Event, Count});
  };
  for (size_t K = 0; K != size_t(OpClass::Count); ++K) {
    uint64_t Warp = 0, Lane = 0;
    for (const CoreClock &C : Cores) {
      Warp += C.classes()[K].Warp;
      Lane += C.classes()[K].Lane;
    }
    Add("core warp instructions", name(static_cast<OpClass>(K)), Warp);
    Add("core lane instructions", name(static_cast<OpClass>(K)), Lane);
  }
  uint64_t Lines = 0, Conflicts = 0, LocalLanes = 0, L1Hits = 0, Stale = 0;
  for (const CoreClock &C : Cores) {
    Lines += C.linesRequested();
    Conflicts += C.localConflicts();
    LocalLanes += C.localLanes();
    L1Hits += C.l1Hits();
    Stale += C.staleLoads();
  }
  if (Timing.Socket.IcacheKib) {
    uint64_t Misses = 0;
    for (const InstructionCache &C : Codes)
      Misses += C.misses();
    Add("instruction cache", "misses", Misses);
  }
  Add("lsu", "lines requested", Lines);
  if (Timing.Core.DcacheKib) {
    Add("data cache", "hits", L1Hits);
    Add("data cache", "stale loads", Stale);
  }
  R.StaleLoads = Stale;
  Add("local memory", "conflict cycles", Conflicts);
  Add("local memory", "lane accesses", LocalLanes);
  collectRasters(R);
  CacheTime L2;
  for (const CacheTime &T : R.L2) {
    L2.Reads += T.Reads;
    L2.Writes += T.Writes + T.Atomics;
    L2.Writebacks += T.Writebacks;
  }
  if (L2Link::exists(Timing)) {
    Add("link", "bytes to the L2", R.Link.BytesToL2);
    Add("link", "bytes from the L2", R.Link.BytesFromL2);
  }
  if (Host) {
    uint64_t DmaLines = 0;
    for (const DmaTime &T : R.DmaEngines)
      DmaLines += T.Lines;
    Add("command processor", "commands", Host->processor().Commands);
    Add("dma", "lines", DmaLines);
    Add("host link", "bytes", Host->linkBytes());
  }
  Add("l2", "line reads", L2.Reads);
  Add("l2", "line writes", L2.Writes);
  Add("l2", "write-backs", L2.Writebacks);
  Add("llc", "line reads", R.Llc.Reads);
  Add("llc", "line writes", R.Llc.Writes + R.Llc.Atomics);
  Add("dram", "read bursts", R.Dram.ReadBursts);
  Add("dram", "write bursts", R.Dram.WriteBursts);
  Add("dram", "activations", R.Dram.Activations);
  Add("dram", "refreshes", R.Dram.Refreshes);
  collectTimes(R);
}

/// What rasterizers and pixel units did.
void Clock::collectRasters(TimeReport &R) const {
  const auto Add = [&R](std::string_view Unit, std::string_view Event,
                        uint64_t Count) {
    R.Activities.push_back({Unit, Event, Count});
  };
  RasterTime Raster;
  for (const RasterTime &T : R.Rasters) {
    Raster.Commands += T.Commands;
    Raster.Gaussians += T.Gaussians;
    Raster.LaneSlots += T.LaneSlots;
  }
  Add("rasterizer", "commands", Raster.Commands);
  Add("rasterizer", "gaussians fetched", Raster.Gaussians);
  LaneWork Work;
  for (const RasterClock &C : Rasters)
    Work += C.laneWork();
  Add("rasterizer", "pixels evaluated", Raster.LaneSlots - Work.allCovered());
  Add("rasterizer", "pixels blended", Work.allBlended());
  Add("rasterizer", "pixels loaded or stored", Work.Moved);
  if (Work.RangeWords != 0)
    Add("rasterizer", "words of ranges loaded", Work.RangeWords);
  if (Timing.Raster.SkipBlocks != 0)
    Add("rasterizer", "rows of blocks tested", Work.BlockRows);
  for (uint8_t N = 0; N != raster::ExpUnitCount; ++N)
    Add("rasterizer exponential", expUnitName(N), Work.Evaluated[N]);
  for (uint8_t N = 0; N != raster::BlendUnitCount; ++N)
    Add("rasterizer blend", blendUnitName(N), Work.Blended[N]);
  Add("rasterizer gradients", "pixels", Work.Gradients);
  if (Work.RayGradients != 0)
    Add("rasterizer gradients", "pixels of rays", Work.RayGradients);
  if (Work.SurfelGradients != 0)
    Add("rasterizer gradients", "pixels of surfels", Work.SurfelGradients);
  if (Work.LowPassed != 0)
    Add("rasterizer front end", "low pass", Work.LowPassed);
  if (Work.allCovered() != 0) {
    for (size_t N = 1; N != Work.Covered.size(); ++N)
      if (Work.Covered[N] != 0)
        Add("rasterizer front end", raster::FrontEnds[N].Name, Work.Covered[N]);
    Add("rasterizer front end", "pixels in front", Work.Passed);
  }
  PixelTime Tails;
  for (const PixelTime &T : R.PixelUnits) {
    Tails.Tails += T.Tails;
    Tails.Visits += T.Visits;
  }
  Add("pixel unit", "tails", Tails.Tails);
  Add("pixel unit", "visits", Tails.Visits);
}

/// What there is for as long as the run takes, in cycles of each.
void Clock::collectTimes(TimeReport &R) const {
  const auto Add = [&R](std::string_view Event, uint64_t Count) {
    R.Activities.push_back({"time", Event, Count});
  };
  const auto Each = [&R](uint64_t Number) { return Number * R.Cycles; };
  Add("cores", Each(Shape.cores()));
  Add("core lanes", Each(uint64_t{Shape.cores()} * Shape.LanesPerWarp));
  if (const uint64_t Further =
          uint64_t{Shape.cores()} * (Shape.WarpsPerCore - 1)) {
    Add("further warps", Each(Further));
    Add("lanes of further warps", Each(Further * Shape.LanesPerWarp));
  }
  Add("rasterizers", Each(Shape.sockets()));
  Add("places for Gaussians",
      Each(uint64_t{Shape.sockets()} * Timing.Raster.BufferEntries));
  if (Timing.Raster.TileOverlap == 2)
    Add("second pixel buffers", Each(Shape.sockets()));
  if (Timing.Raster.SkipBlocks & raster::OutsideEllipse)
    Add("block tests", Each(Shape.sockets()));
  if (Timing.Raster.SkipBlocks & raster::ClosedBlock)
    Add("maps of closed blocks", Each(Shape.sockets()));
  if (L2Link::exists(Timing))
    Add("links", Each(1));
  if (Host) {
    Add("command processors", Each(1));
    Add("DMA engines", Each(Timing.Host.DmaEngines));
    Add("lines of DMA engines",
        Each(uint64_t{Timing.Host.DmaEngines} * Timing.Host.DmaRequests));
  }
  Add("rasterizer lanes",
      Each(uint64_t{Shape.sockets()} * Timing.Raster.Lanes));
  // A machine that no command asks for rays is one without their units.
  const auto Lanes = Each(uint64_t{Shape.sockets()} * Timing.Raster.Lanes);
  if (std::ranges::any_of(Rasters, [](const RasterClock &C) {
        return C.laneWork()
                   .Covered[raster::frontEndRowOf(raster::VR_PRIMITIVE_RAY)] !=
               0;
      })) {
    Add("lanes that meet rays", Lanes);
    Add("cores that meet rays", Each(Shape.cores()));
  }
  if (std::ranges::any_of(Rasters, [](const RasterClock &C) {
        return C.laneWork().LowPassed != 0;
      })) {
    Add("lanes that meet surfels", Lanes);
    Add("cores that meet surfels", Each(Shape.cores()));
  }
  Add("pixel unit lanes", Each(uint64_t{Shape.Clusters} * Timing.Pixel.Lanes));
  uint64_t Rasterizing = 0, Tailing = 0;
  for (const RasterTime &T : R.Rasters)
    Rasterizing += R.Cycles - T.Cycles[size_t(RasterCycle::Idle)];
  for (const PixelTime &T : R.PixelUnits)
    Tailing += R.Cycles - T.Cycles[size_t(PixelCycle::Idle)];
  Add("busy rasterizers", Rasterizing);
  Add("busy rasterizer lanes", Rasterizing * Timing.Raster.Lanes);
  Add("busy pixel units", Tailing);
  Add("busy pixel unit lanes", Tailing * Timing.Pixel.Lanes);
  Add("KiB of instruction caches",
      Each(uint64_t{Shape.sockets()} * Timing.Socket.IcacheKib));
  Add("KiB of data caches",
      Each(uint64_t{Shape.cores()} * Timing.Core.DcacheKib));
  Add("KiB of local memories",
      Each(uint64_t{Shape.cores()} * (Shape.LocalBytes / 1024)));
  Add("KiB of the L2", Each(uint64_t{Shape.Clusters} * Timing.L2.Kib));
  Add("KiB of the llc", Each(Timing.Llc.Kib));
  R.Activities.push_back({"dram channels",
                          dram::reportName(Timing.Dram.Standard),
                          Each(Timing.Dram.Channels)});
}

} // namespace vorion::isasim
