// What the clock measures of each unit: the reason of every cycle, and counts.
// Enumerations, structures, names, groups, colours, the keys of reports, the
// page of time and docs/tables/clock-reasons.md follow from a record;
// docs/adding-a-clock-reason.md.

class ClockUnit<string name, string one> {
  string Name = name;                 // in C++: CoreCycle, CoreTime
  string One = one;                   // in a sentence
  string Key = "";                    // the list of such units in reports, if they have reasons
}
// Groups of reasons, for tables and pictures without room for each reason. Their
// order is that of stacked bars.
class ReasonGroup<ClockUnit unit, string colour, string label> {
  ClockUnit Unit = unit;
  string Colour = colour;
  string Label = label;               // what the unit does, without a subject
  bit Idle = 0;                       // the unit has nothing to do
  string Helps = "";                  // the key of the configuration, or its beginning, of which more shortens the wait
}
// A cycle has one reason, so a unit's reasons add up to all cycles. The key is
// unique in a unit. The order of the records is that of reports.
class ClockReason<ReasonGroup group, string key, string colour, string meaning> {
  ReasonGroup Group = group;
  string Key = key;
  string Colour = colour;             // where reasons are shown one by one
  string Meaning = meaning;           // goes on after "a cycle in which the UNIT"
}
// Follows the reasons of a unit in reports.
class ClockCount<ClockUnit unit, string key, string meaning> {
  ClockUnit Unit = unit;
  string Key = key;
  string Meaning = meaning;
}

def CoreUnit : ClockUnit<"Core", "core"> { let Key = "cores"; }
def RasterUnit : ClockUnit<"Raster", "rasterizer"> { let Key = "rasterizers"; }
def PixelUnit : ClockUnit<"Pixel", "pixel unit"> { let Key = "pixel_units"; }
def CommandUnit : ClockUnit<"Command", "command processor"> { let Key = "command_processors"; }
def DmaUnit : ClockUnit<"Dma", "DMA engine"> { let Key = "dma_engines"; }
def CacheUnit : ClockUnit<"Cache", "cache">;
def LinkUnit : ClockUnit<"Link", "link to the L2">;
def DramUnit : ClockUnit<"Dram", "DRAM">;

// Where a unit waits for the link to the L2.
defvar Link = "#1b4965";
defvar CrossesLink = "waited while a message was on the link to the L2 or waited for it";
// Where a unit waits for nothing and works on nothing.
defvar Grey = "#c8ccd1";

def CoreIssues : ReasonGroup<CoreUnit, "#009e73", "issues an instruction"> { let Helps = "cores"; }
def CoreAwaitsLaunch : ReasonGroup<CoreUnit, "#5b7083", "waits for its launch">;
def CoreFetches : ReasonGroup<CoreUnit, "#0072b2", "waits for an instruction"> { let Helps = "warps_per_core"; }
def CoreBranches : ReasonGroup<CoreUnit, "#56b4e9", "branches, diverges"> { let Helps = "warps_per_core"; }
def CoreComputes : ReasonGroup<CoreUnit, "#cc79a7", "waits for an operand or a unit"> { let Helps = "warps_per_core"; }
def CoreAccesses : ReasonGroup<CoreUnit, "#d55e00", "waits for accesses"> { let Helps = "warps_per_core"; }
def CoreCrosses : ReasonGroup<CoreUnit, Link, "waits for the link to the L2"> { let Helps = "timing.link"; }
def CoreRasterizes : ReasonGroup<CoreUnit, "#7a5195", "waits for a rasterizer">;
def CoreSynchronizes : ReasonGroup<CoreUnit, "#8c6d31", "waits at a barrier">;
def CoreEnds : ReasonGroup<CoreUnit, Grey, "has ended"> { let Idle = 1; }

def : ClockReason<CoreIssues, "issue", "#009e73", "issued an instruction; this is also the number of warp instructions">;
def : ClockReason<CoreAwaitsLaunch, "launch", "#5b7083", "waited for the command processor to start the launch, or for copies that this waits for; only with `timing.host.dma_engines`">;
def : ClockReason<CoreFetches, "start", Grey, "was reset at the launch: `timing.core.start_cycles`">;
def : ClockReason<CoreFetches, "fetch", "#0072b2", "waited for the warp's next instruction, from its front end or the instruction cache">;
def : ClockReason<CoreComputes, "operand", "#cc79a7", "waited for a result of an ALU, SFU or FPU">;
def : ClockReason<CoreAccesses, "memory", "#d55e00", "waited for a value from global memory">;
def : ClockReason<CoreAccesses, "local", "#f0c05a", "waited for a value from local memory">;
def : ClockReason<CoreComputes, "unit", "#b07aa1", "waited for a unit that was busy">;
def : ClockReason<CoreComputes, "slot", "#9c755f", "lost an issue slot: it was the turn of a warp whose instruction could not issue yet">;
def : ClockReason<CoreAccesses, "lsu_queue", "#e69f00", "waited for a place among the accesses in flight">;
def : ClockReason<CoreBranches, "branch", "#56b4e9", "waited for the front end behind a branch">;
def : ClockReason<CoreBranches, "divergence", "#8ecae6", "waited for the front end behind an instruction that sets the active lanes">;
def : ClockReason<CoreAccesses, "fence", "#9e2a2b", "waited for its accesses to be done, at a fence or before `vr_start`">;
def : ClockReason<CoreCrosses, "link", Link, CrossesLink>;
def : ClockReason<CoreRasterizes, "raster_full", "#7a5195", "waited for a place in its rasterizer's queue">;
def : ClockReason<CoreRasterizes, "raster_wait", "#b39ddb", "waited for its rasterizer to finish, or for a batch of gradients">;
def : ClockReason<CoreSynchronizes, "barrier", "#8c6d31", "waited for others at a barrier">;
def : ClockReason<CoreEnds, "ended", Grey, "had nothing left to do while others still ran">;

def RasterBlends : ReasonGroup<RasterUnit, "#009e73", "blends"> { let Helps = "rasterizers"; }
def RasterClips : ReasonGroup<RasterUnit, "#8ecae6", "finds out what is clipped"> { let Helps = "rasterizers"; }
def RasterFetches : ReasonGroup<RasterUnit, "#0072b2", "waits for Gaussians"> { let Helps = "timing.dram.channels"; }
def RasterCrosses : ReasonGroup<RasterUnit, Link, "waits for the link to the L2"> { let Helps = "timing.link"; }
def RasterConflicts : ReasonGroup<RasterUnit, "#cc79a7", "waits for a pixel"> { let Helps = "rasterizers"; }
def RasterChangesTile : ReasonGroup<RasterUnit, "#e69f00", "begins or ends a tile"> { let Helps = "rasterizers"; }
def RasterIdles : ReasonGroup<RasterUnit, Grey, "is idle"> { let Idle = 1; }

def : ClockReason<RasterBlends, "blend", "#009e73", "gave pixels to its lanes">;
def : ClockReason<RasterClips, "clip", "#8ecae6", "dropped a Gaussian that misses the tile">;
def : ClockReason<RasterFetches, "fetch", "#0072b2", "waited for a Gaussian's record">;
def : ClockReason<RasterCrosses, "link", Link, CrossesLink>;
def : ClockReason<RasterConflicts, "hazard", "#cc79a7", "waited for a pixel that was still being updated">;
def : ClockReason<RasterChangesTile, "begin", "#e69f00", "took a command, and cleared or loaded the pixel buffer">;
def : ClockReason<RasterChangesTile, "flush", "#f0c05a", "waited for its lanes to empty">;
def : ClockReason<RasterChangesTile, "drain", "#d55e00", "wrote the tile, or waited for a core to take gradients">;
def : ClockReason<RasterIdles, "idle", Grey, "had no command">;

def : ClockCount<RasterUnit, "commands", "commands taken">;
def : ClockCount<RasterUnit, "gaussians", "Gaussians dispatched">;
def : ClockCount<RasterUnit, "clipped", "of these, those that miss the tile">;
def : ClockCount<RasterUnit, "lane_slots", "pixels given to lanes">;

def PixelEvaluates : ReasonGroup<PixelUnit, "#009e73", "evaluates">;
def PixelFetches : ReasonGroup<PixelUnit, "#0072b2", "waits for Gaussians">;
def PixelCrosses : ReasonGroup<PixelUnit, Link, "waits for the link to the L2">;
def PixelChangesTail : ReasonGroup<PixelUnit, "#e69f00", "begins or ends a hand-over">;
def PixelIdles : ReasonGroup<PixelUnit, Grey, "is idle"> { let Idle = 1; }

def : ClockReason<PixelEvaluates, "evaluate", "#009e73", "gave its lanes a Gaussian">;
def : ClockReason<PixelFetches, "fetch", "#0072b2", "waited for a Gaussian's record">;
def : ClockReason<PixelCrosses, "link", Link, CrossesLink>;
def : ClockReason<PixelChangesTail, "load", "#e69f00", "waited for a hand-over's record or pixels">;
def : ClockReason<PixelChangesTail, "store", "#d55e00", "emptied its lanes and wrote the last pixels">;
def : ClockReason<PixelIdles, "idle", Grey, "had no hand-over">;

def : ClockCount<PixelUnit, "tails", "hand-overs taken">;
def : ClockCount<PixelUnit, "visits", "Gaussians examined, summed over pixels">;

def CommandWorks : ReasonGroup<CommandUnit, "#5b7083", "fetches or decodes a command">;
def CommandIdles : ReasonGroup<CommandUnit, Grey, "has no command to decode"> { let Idle = 1; }

def : ClockReason<CommandWorks, "fetch", "#0072b2", "waited for a command from the host's memory">;
def : ClockReason<CommandWorks, "decode", "#009e73", "decoded a command">;
def : ClockReason<CommandIdles, "idle", Grey, "had no command to decode; those that are decoded may wait for others">;

def : ClockCount<CommandUnit, "commands", "commands decoded, launches and copies">;

def DmaMoves : ReasonGroup<DmaUnit, "#009e73", "moves lines">;
def DmaAwaitsHost : ReasonGroup<DmaUnit, "#5b7083", "waits for the host's link">;
def DmaAwaitsMemory : ReasonGroup<DmaUnit, "#d55e00", "waits for memory">;
def DmaIdles : ReasonGroup<DmaUnit, Grey, "has no copy"> { let Idle = 1; }

def : ClockReason<DmaMoves, "move", "#009e73", "began a line">;
def : ClockReason<DmaAwaitsHost, "host_link", "#5b7083", "had all its lines in flight, or its last, and waited for the host's link">;
def : ClockReason<DmaAwaitsMemory, "memory", "#d55e00", "had all its lines in flight, or its last, and waited for memory">;
def : ClockReason<DmaIdles, "idle", Grey, "had no copy">;

def : ClockCount<DmaUnit, "copies", "copies begun">;
def : ClockCount<DmaUnit, "lines", "lines begun">;
def : ClockCount<DmaUnit, "bytes", "bytes of the copies that ended">;

def : ClockCount<CacheUnit, "reads", "requests of a line that a bank has accepted, to read">;
def : ClockCount<CacheUnit, "writes", "the same, to write">;
def : ClockCount<CacheUnit, "atomics", "the same, of atomics">;
def : ClockCount<CacheUnit, "hits", "requests of any kind whose line was present">;
def : ClockCount<CacheUnit, "merged", "requests of any kind whose line was already requested (secondary misses)">;
def : ClockCount<CacheUnit, "writebacks", "dirty lines written to the next level">;
def : ClockCount<CacheUnit, "kept", "lines that the intersect hint protected from replacement">;
def : ClockCount<CacheUnit, "bank_cycles", "cycles that requests waited for their bank, summed over requests">;
def : ClockCount<CacheUnit, "mshr_cycles", "cycles that misses waited for an MSHR, summed over misses">;

def : ClockCount<LinkUnit, "bytes_to_l2", "bytes of the messages to the L2 that were sent in the run, headers included">;
def : ClockCount<LinkUnit, "bytes_from_l2", "the same, back">;
def : ClockCount<LinkUnit, "busy_to_l2", "cycles of the chip in which the direction to the L2 carried a message; 0 without a limit on its rate">;
def : ClockCount<LinkUnit, "busy_from_l2", "the same, back">;

def : ClockCount<DramUnit, "read_bursts", "bursts that read">;
def : ClockCount<DramUnit, "write_bursts", "bursts that write">;
def : ClockCount<DramUnit, "row_hits", "lines whose row was open when the controller first considered them">;
def : ClockCount<DramUnit, "row_misses", "lines of whose bank no row was open then">;
def : ClockCount<DramUnit, "row_conflicts", "lines of whose bank another row was open then">;
def : ClockCount<DramUnit, "forwarded", "reads that were forwarded from a queued write">;
def : ClockCount<DramUnit, "activations", "rows opened">;
def : ClockCount<DramUnit, "drains", "number of times that a controller started to drain its writes">;
def : ClockCount<DramUnit, "refreshes", "refreshes of ranks or banks, those of unused channels included">;
def : ClockCount<DramUnit, "bus_ps", "picoseconds in which data buses were occupied, summed over channels">;
