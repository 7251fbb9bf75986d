#include "energy/Costs.h"

#include "raster/UnitTables.h"
#include "timing/common/DatapathUnits.h"

#include <string>
#include <vector>

namespace vorion::isasim {

std::string_view name(EnergyUnit U) {
  constexpr std::string_view Names[] = {"front end",
                                        "registers",
                                        "arithmetic",
                                        "load and store",
                                        "local memory",
                                        "core clock",
                                        "rasterizer lanes",
                                        "rasterizer buffers",
                                        "rasterizer clock",
                                        "pixel unit",
                                        "wires",
                                        "leakage",
                                        "link",
                                        "l2",
                                        "llc",
                                        "command processor and DMA",
                                        "dram"};
  static_assert(std::size(Names) == size_t(EnergyUnit::Count));
  return Names[size_t(U)];
}

namespace {

using enum EnergyUnit;

constexpr std::string_view Warp = "core warp instructions",
                           Lane = "core lane instructions";

/// What an instruction of a class does in a lane.
struct ClassCost {
  std::string_view Class;
  double Reads, Writes; ///< of registers
  double IntAdds = 0, IntMultiplications = 0, Adds = 0, Multiplications = 0;
};
/// Of operands the mean is meant. An instruction of class fma counts as a
/// multiplication and an addition, though single ones are of the class, too.
/// Division and square root take a subtraction for each bit of the result.
constexpr ClassCost Classes[] = {
    {"alu", 1.5, 1, 1},       {"mul", 2, 1, 0, 1},
    {"div", 2, 1, 34},        {"fma", 2.5, 1, 0, 0, 1, 1},
    {"fcmp", 2, 1, 1},        {"fcvt", 1, 1, 0, 0, 1},
    {"fdiv", 2, 1, 26, 0, 1}, {"fsqrt", 1, 1, 26, 0, 1},
    {"simt", 2, 1, 1},        {"csr", 1, 1, 1},
    {"branch", 2, 0.25, 1},   {"mask", 1, 0.5, 0},
    {"load", 1, 1, 1},        {"store", 2, 0, 1},
    {"atomic", 2, 1, 2},      {"fence", 0, 0, 0},
    {"barrier", 2, 0, 0},
};

/// 64 bytes in words of 64 bits, as the rows of memories have them.
constexpr double LineWords = 8;
/// From a core or rasterizer to the edge of the paper's 1.6 mm2 of cores.
constexpr double ToEdgeMm = 1;

constexpr EventCost Others[] = {
    {"instruction cache", "misses", FrontEnd, "SRAM 8 KiB", LineWords},
    {"instruction cache", "misses", Wires, "wire byte mm", 64 * ToEdgeMm},
    {"lsu", "lines requested", LoadStore, "line of an access", 1},
    {"lsu", "lines requested", Wires, "wire byte mm", 64 * ToEdgeMm},
    {"data cache", "hits", LoadStore, "SRAM 8 KiB", LineWords},
    {"local memory", "lane accesses", LocalMemory, "SRAM 8 KiB", 0.5},
    {"rasterizer", "commands", RasterBuffers, "tile command", 1},
    {"rasterizer", "gaussians fetched", RasterBuffers, "Gaussian dispatched",
     1},
    {"rasterizer", "gaussians fetched", Wires, "wire byte mm", 64 * ToEdgeMm},
    {"rasterizer", "pixels evaluated", RasterBuffers, "pixel of the buffer", 1},
    {"rasterizer", "pixels blended", RasterBuffers, "pixel of the buffer", 1},
    {"rasterizer", "pixels loaded or stored", RasterBuffers,
     "pixel of the buffer", 1},
    {"rasterizer", "pixels loaded or stored", Wires, "wire byte mm",
     16 * ToEdgeMm},
    // A quarter of a bank's row.
    {"rasterizer", "words of ranges loaded", RasterBuffers,
     "pixel of the buffer", 0.25},
    {"rasterizer", "words of ranges loaded", Wires, "wire byte mm",
     4 * ToEdgeMm},
    {"rasterizer", "rows of blocks tested", RasterLanes, "fp32 multiplication",
     8},
    {"rasterizer", "rows of blocks tested", RasterLanes, "fp32 addition", 8},
    {"rasterizer", "rows of blocks tested", RasterLanes, "adder bit", 26 * 24},
    {"rasterizer front end", "pixels in front", RasterBuffers,
     "pixel of the buffer", 1},
    {"rasterizer gradients", "pixels", RasterLanes, "fp32 multiplication", 16},
    {"rasterizer gradients", "pixels", RasterLanes, "fp32 addition", 4 + 9},
    {"rasterizer gradients", "pixels", RasterBuffers, "pixel of the buffer", 2},
    {"rasterizer gradients", "pixels of rays", RasterLanes,
     "fp32 multiplication", 23},
    {"rasterizer gradients", "pixels of rays", RasterLanes, "fp32 addition",
     4 + 12},
    {"rasterizer gradients", "pixels of rays", RasterBuffers,
     "pixel of the buffer", 2},
    // t dx and t dy, and their sums.
    {"rasterizer gradients", "pixels of surfels", RasterLanes,
     "fp32 multiplication", 2},
    {"rasterizer gradients", "pixels of surfels", RasterLanes, "fp32 addition",
     2},
    {"pixel unit", "visits", PixelUnit, "fp32 multiplication", 7 + 1 + 5},
    {"pixel unit", "visits", PixelUnit, "fp32 addition", 4 + 2 + 5},
    {"pixel unit", "tails", PixelUnit, "tile command", 1},
    // Flip-flops are nearly all of lanes, and the rows are of 16.
    {"time", "core lanes", CoreClock, "core cycle", 1.0 / 16},
    {"time", "busy rasterizer lanes", RasterClock, "rasterizer cycle",
     1.0 / 16},
    {"time", "busy pixel unit lanes", PixelUnit, "rasterizer cycle", 1.0 / 16},
    {"link", "bytes to the L2", Link, "pad byte", 1},
    {"link", "bytes from the L2", Link, "pad byte", 1},
    {"l2", "line reads", L2, "SRAM 1 MiB", LineWords},
    {"l2", "line writes", L2, "SRAM 1 MiB", LineWords},
    {"l2", "write-backs", L2, "SRAM 1 MiB", LineWords},
    // Of 64 bytes, written to the queue and read.
    {"command processor", "commands", Host, "SRAM 8 KiB", 2 * LineWords},
    {"command processor", "commands", Host, "tile command", 1},
    // Written to an engine's buffer and read.
    {"dma", "lines", Host, "SRAM 8 KiB", 2 * LineWords},
    {"host link", "bytes", Host, "pad byte", 1},
    {"llc", "line reads", Llc, "SRAM 1 MiB", LineWords},
    {"llc", "line writes", Llc, "SRAM 1 MiB", LineWords},
};

/// What a unit of a lane does for a pixel, with every part of it once.
void add(std::vector<EventCost> &To, std::string_view Unit,
         std::string_view Event, const DatapathUnit &U) {
  const auto Add = [&](std::string_view Row, double Count) {
    if (Count != 0)
      To.push_back({Unit, Event, RasterLanes, Row, Count});
  };
  Add("fp32 multiplication", U.Multipliers);
  Add("fp32 addition", U.Adders);
  Add("product bit", U.ProductBits);
  Add("adder bit", U.AdderBits);
  Add("table bit", U.TableBits);
  Add("choice bit", U.ChoiceBits);
  Add("register bit", U.RegisterBits);
}

/// Of rays: the squares of dx and dy, their sum, a comparison and a choice.
constexpr DatapathUnit LowPass{.Name = "low pass",
                               .Latency = 0,
                               .Interval = 1,
                               .Multipliers = 2,
                               .Adders = 2,
                               .ProductBits = 0,
                               .AdderBits = 0,
                               .TableBits = 0,
                               .Source = "beside the quotient of rays; ours",
                               .ChoiceBits = 32};

/// Where a lane has its units, in the order of datapathUnits().
enum Place : uint8_t { Power, Exponential, Alpha, Blend };

raster::LaneUnits paperLane() {
  return {.Exp = raster::expRowOf(raster::VR_EXP_TABLE),
          .Blend = raster::VR_BLEND_FP32};
}

} // namespace

std::span<const EventCost> eventCosts() {
  static const std::vector<EventCost> All = [] {
    std::vector<EventCost> Made;
    for (const ClassCost &C : Classes) {
      Made.push_back({Warp, C.Class, FrontEnd, "instruction fetched", 1});
      Made.push_back({Warp, C.Class, FrontEnd, "instruction decoded", 1});
      Made.push_back({Lane, C.Class, Registers, "register read", C.Reads});
      Made.push_back({Lane, C.Class, Registers, "register written", C.Writes});
      Made.push_back({Lane, C.Class, Registers, "lane latches", 1});
      for (const auto &[Row, Count] :
           {std::pair{"int32 addition", C.IntAdds},
            {"int32 multiplication", C.IntMultiplications},
            {"fp32 addition", C.Adds},
            {"fp32 multiplication", C.Multiplications}})
        if (Count != 0)
          Made.push_back({Lane, C.Class, Arithmetic, Row, Count});
    }
    Made.insert(Made.end(), std::begin(Others), std::end(Others));
    for (const Place P : {Power, Alpha})
      add(Made, "rasterizer", "pixels evaluated",
          datapathUnits(paperLane())[P]);
    for (uint8_t N = 0; N != raster::ExpUnitCount; ++N) {
      const DatapathUnit &U = datapathUnits({.Exp = N})[Exponential];
      add(Made, "rasterizer exponential", U.Name, U);
    }
    for (uint8_t N = 0; N != raster::BlendUnitCount; ++N) {
      const DatapathUnit &U = datapathUnits({.Blend = N})[Blend];
      add(Made, "rasterizer blend", U.Name, U);
    }
    add(Made, "rasterizer gradients", "pixels", backwardUnits(0)[0]);
    // T / (1 - alpha), and l / D in the other lane's divider.
    DatapathUnit Divisions = backwardUnits(0)[0];
    Divisions.Multipliers *= 2;
    Divisions.ProductBits *= 2;
    for (unsigned *Bits :
         {&Divisions.AdderBits, &Divisions.ChoiceBits, &Divisions.RegisterBits})
      *Bits *= 2;
    add(Made, "rasterizer gradients", "pixels of rays", Divisions);
    for (uint8_t N = 1; N != std::size(raster::FrontEnds); ++N) {
      const std::string_view Name = raster::FrontEnds[N].Name;
      add(Made, "rasterizer front end", Name,
          datapathUnits({.FrontEnd = N})[0]);
      if (!raster::FrontEnds[N].IsOpaque)
        add(Made, "rasterizer front end", Name,
            datapathUnits({.FrontEnd = N})[Alpha]);
      Made.push_back({"rasterizer front end", Name, RasterBuffers,
                      "pixel of the buffer", 1});
    }
    add(Made, "rasterizer front end", LowPass.Name, LowPass);
    std::erase_if(Made, [](const EventCost &C) { return C.Count == 0; });
    return Made;
  }();
  return All;
}

std::span<const FreeEvent> freeEvents() {
  static constexpr FreeEvent All[] = {
      {"data cache", "stale loads"},
      {"local memory", "conflict cycles"},
      {"time", "cores"},
      {"time", "busy rasterizers"},
      {"time", "busy pixel units"},
      {"time", "links"},
      {"time", "command processors"},
      {"time", "DMA engines"},
      {"time", "lines of DMA engines"},
      {"time", "rasterizers"},
      {"time", "rasterizer lanes"},
      {"time", "places for Gaussians"},
      {"time", "second pixel buffers"},
      {"time", "block tests"},
      {"time", "maps of closed blocks"},
      {"time", "pixel unit lanes"},
      {"time", "KiB of instruction caches"},
      {"time", "KiB of data caches"},
      {"time", "KiB of local memories"},
      {"time", "KiB of the L2"},
      {"time", "KiB of the llc"},
  };
  return All;
}

std::span<const AreaCost> areaCosts() {
  static const std::vector<AreaCost> All = [] {
    constexpr std::string_view CoreLane = "core lanes",
                               RasterLane = "rasterizer lanes";
    constexpr double KibBits = 8192;
    std::vector<AreaCost> Made = {
        // A lane's FMA, integer multiplier, ALU with shifter, divider of a bit
        // a cycle, and a pipelined fp32 divider and root of 26 rows each.
        {"core lanes", CoreLane, "fp32 multiplier", 1},
        {"core lanes", CoreLane, "fp32 adder", 1},
        {"core lanes", CoreLane, "product bit", 32 * 32},
        {"core lanes", CoreLane, "adder bit", 3 * 32 + 2 * 26 * 24},
        {"core lanes", CoreLane, "choice bit", 2 * 5 * 32 + 2 * 26 * 24},
        // Operands, results and the stages of the units.
        {"core lanes", CoreLane, "register bit", 800 + 2 * 483},
        {"register files", CoreLane, "register file bit", 2 * 32 * 32},
        {"register files", "lanes of further warps", "register file bit",
         2 * 32 * 32},
        // Snitch, a whole core of 32 bits, has 10,000 gates; warps, the
        // scoreboard and the stack of splits are ours.
        {"core control", "cores", "gate", 40'000},
        {"core control", "further warps", "gate", 10'000},
        // Four commands of 480 bits, and a batch of gradients: 16 records of
        // nine words, twice.
        {"raster agents", "cores", "register bit", 4 * 480 + 2 * 16 * 9 * 32},
        {"local memories", "KiB of local memories", "SRAM bit", KibBits},
        {"instruction caches", "KiB of instruction caches", "SRAM bit",
         KibBits},
        {"data caches", "KiB of data caches", "SRAM bit", KibBits},
        {"rasterizer lanes", RasterLane, "register bit", 1200},
        // A tile of 64 x 64 pixels of 128 bits.
        {"pixel buffers", "rasterizers", "buffer bit", 64 * 64 * 128},
        // A triangle as dispatch takes it, with its box: steps of 32 bits and
        // edges of 40, a plane, an ID (test/rtl/cut.sv). A Gaussian needs less.
        {"rasterizer control", "places for Gaussians", "buffer bit",
         3 * (2 * 32 + 40) + 4 * 32 + 4 * 7},
        // Triangles are restated at the tile's first pixel, in two cycles.
        {"rasterizer control", "rasterizers", "product bit", 3 * 32 * 16},
        {"rasterizer control", "rasterizers", "adder bit", 3 * 64},
        {"rasterizer control", "rasterizers", "fp32 multiplier", 1},
        {"rasterizer control", "rasterizers", "fp32 adder", 1},
        // Which memory of a bank has a pixel.
        {"rasterizer control", "rasterizers", "choice bit", 16 * 128},
        // Pixels from 16 lanes to 16 banks and back.
        {"rasterizer control", "rasterizers", "choice bit", 2 * 16 * 15 * 128},
        {"rasterizer control", "rasterizers", "gate", 30'000},
        {"pixel buffers", "second pixel buffers", "buffer bit", 64 * 64 * 128},
        // Where an ellipse begins and ends in a row of blocks: two roots of a
        // quadratic equation, by a root of 26 rows, in a pipeline.
        {"block tests", "block tests", "fp32 multiplier", 8},
        {"block tests", "block tests", "fp32 adder", 8},
        {"block tests", "block tests", "adder bit", 26 * 24},
        {"block tests", "block tests", "choice bit", 26 * 24},
        {"block tests", "block tests", "register bit", 800},
        // A count of 5 bits of the open pixels of each of 256 blocks.
        {"block tests", "maps of closed blocks", "register bit", 256 * 5},
        {"pixel unit", "pixel unit lanes", "fp32 multiplier", 13},
        {"pixel unit", "pixel unit lanes", "fp32 adder", 11},
        {"pixel unit", "pixel unit lanes", "register bit", 1200},
        {"pixel unit", "pixel unit lanes", "buffer bit", 64 * 48 * 8 / 4.0},
        // A core of 32 bits, as above, and a queue; a controller of half that.
        {"host units", "command processors", "gate", 20'000, Host},
        {"host units", "DMA engines", "gate", 10'000, Host},
        {"host units", "lines of DMA engines", "buffer bit", 64 * 8, Host},
        {"l2", "KiB of the L2", "SRAM bit", KibBits, L2},
        {"llc", "KiB of the llc", "SRAM bit", KibBits, Llc},
    };
    const auto Add = [&](std::string_view Part, const DatapathUnit &U,
                         double Share, std::string_view Event) {
      for (const auto &[Row, Count] : {std::pair<std::string_view, double>{
                                           "fp32 multiplier", U.Multipliers},
                                       {"fp32 adder", U.Adders},
                                       {"product bit", U.ProductBits},
                                       {"adder bit", U.AdderBits},
                                       {"table bit", U.TableBits},
                                       {"choice bit", U.ChoiceBits},
                                       {"register bit", U.RegisterBits}})
        if (Count != 0)
          Made.push_back({Part, Event, Row, Share * Count});
    };
    for (const DatapathUnit &U : datapathUnits(paperLane()))
      Add("rasterizer lanes", U, 1, RasterLane);
    // A triangle's depth takes multipliers and adders of the power, by a choice
    // of six operands. Its edges and its test are its own
    // (docs/unification.md).
    constexpr unsigned DepthMultipliers = 2, DepthAdders = 2;
    DatapathUnit Edges = datapathUnits(
        {.FrontEnd = raster::frontEndRowOf(raster::VR_PRIMITIVE_TRIANGLE)})[0];
    Edges.Multipliers -= DepthMultipliers;
    Edges.Adders -= DepthAdders;
    Edges.ChoiceBits += 6 * 32;
    Add("rasterizer lanes", Edges, 1, RasterLane);
    // Rays have the multipliers and adders of the power, by a choice of two
    // operands for each, and more.
    const DatapathUnit &Conic = datapathUnits(paperLane())[Power];
    const raster::LaneUnits OfRays{
        .FrontEnd = raster::frontEndRowOf(raster::VR_PRIMITIVE_RAY)};
    DatapathUnit Rays = datapathUnits(OfRays)[Power];
    Rays.Multipliers -= Conic.Multipliers;
    Rays.Adders -= Conic.Adders;
    Rays.ChoiceBits += (Conic.Multipliers + Conic.Adders) * 2 * 32;
    Add("ray units", Rays, 1, "lanes that meet rays");
    for (std::size_t N = 1; N != backwardUnits(0).size(); ++N) {
      DatapathUnit More = backwardUnits(0, OfRays)[N];
      More.Multipliers -= backwardUnits(0)[N].Multipliers;
      More.Adders -= backwardUnits(0)[N].Adders;
      Add("ray units", More, 0.5, "lanes that meet rays");
    }
    // Of a batch of gradients three words more, of both batches of an agent.
    Made.push_back(
        {"ray units", "cores that meet rays", "register bit", 2 * 16 * 3 * 32});
    // The low pass, whose multipliers a pair's other lane has for the products
    // of the gradients, two accumulators of a pair, and two words more.
    Add("surfel units", LowPass, 1, "lanes that meet surfels");
    Made.push_back(
        {"surfel units", "lanes that meet surfels", "fp32 adder", 0.5 * 2});
    Made.push_back({"surfel units", "cores that meet surfels", "register bit",
                    2 * 16 * 2 * 32});
    // What a pair of lanes has for gradients, with an exact divider.
    for (const DatapathUnit &U : backwardUnits(0))
      Add("backward mode", U, 0.5, RasterLane);
    return Made;
  }();
  return All;
}

std::span<const std::string_view> energyRows() {
  static constexpr std::string_view All[] = {
      "fp32 addition",       "fp32 multiplication",
      "int32 addition",      "int32 multiplication",
      "product bit",         "adder bit",
      "table bit",           "choice bit",
      "register bit",        "register read",
      "register written",    "lane latches",
      "instruction fetched", "instruction decoded",
      "line of an access",   "SRAM 8 KiB",
      "SRAM 1 MiB",          "pixel of the buffer",
      "Gaussian dispatched", "tile command",
      "core cycle",          "rasterizer cycle",
      "wire byte mm",        "pad byte",
      "leakage of a mm2"};
  return All;
}

std::span<const std::string_view> areaRows() {
  static constexpr std::string_view All[] = {
      "fp32 multiplier", "fp32 adder", "product bit",  "adder bit",
      "table bit",       "choice bit", "register bit", "register file bit",
      "SRAM bit",        "buffer bit", "gate"};
  return All;
}

} // namespace vorion::isasim
