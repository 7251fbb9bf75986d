#include "timing/common/DatapathUnits.h"
#include "vorion/isasim/Timing.h"
#include "vorion/support/Json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

using Json = nlohmann::ordered_json;

std::span<const TimingParam> timingParams() {
  static const TimingParam All[] = {
#define PARAM(GROUP, OF, NAME, MEMBER, DEFAULT, LOW, HIGH, UNIT, SOURCE)       \
  {#GROUP,   #NAME,                                                            \
   #UNIT,    SOURCE,                                                           \
   #DEFAULT, LOW,                                                              \
   HIGH,     [](TimingConfig &C) -> uint32_t & { return C.OF.MEMBER; },                            \
   nullptr},
#define WORD(GROUP, OF, NAME, MEMBER, DEFAULT, UNIT, SOURCE)                   \
  {#GROUP,                                                                     \
   #NAME,                                                                      \
   #UNIT,                                                                      \
   SOURCE,                                                                     \
   DEFAULT,                                                                    \
   0,                                                                          \
   0,                                                                          \
   nullptr,                                                                    \
   [](TimingConfig &C) -> std::string & { return C.OF.MEMBER; }},
#include "vorion/isasim/TimingParams.def"
  };
  return All;
}

namespace {

/// The cycles of a unit with reasons, and its counts.
template <typename Time> Json json(const Time &T) {
  Json J;
  if constexpr (requires { T.Cycles; })
    for (size_t N = 0; N != T.Cycles.size(); ++N)
      J[std::string(name(static_cast<typename Time::Reason>(N)))] = T.Cycles[N];
  for (const ClockCount<Time> &C : ClockCounts<Time>)
    J[std::string(C.Key)] = T.*C.Member;
  return J;
}

template <typename Time> Json json(const std::vector<Time> &Units) {
  Json J = Json::array();
  for (const Time &T : Units)
    J.push_back(json(T));
  return J;
}

/// The sum over units, by reason.
template <typename Time> Time sum(const std::vector<Time> &Units) {
  Time Sum;
  for (const Time &U : Units)
    for (size_t N = 0; N != Sum.Cycles.size(); ++N)
      Sum.Cycles[N] += U.Cycles[N];
  return Sum;
}

template <typename Time>
std::string shares(std::string_view Who, const std::vector<Time> &Units,
                   uint64_t Cycles) {
  const Time Sum = sum(Units);
  const double All =
      static_cast<double>(Cycles) * static_cast<double>(Units.size());
  std::string Text = fmt::format("{:<12}", Who);
  for (size_t N = 0; N != Sum.Cycles.size(); ++N)
    if (Sum.Cycles[N])
      Text += fmt::format(" {} {:.1f} %",
                          name(static_cast<typename Time::Reason>(N)),
                          100.0 * static_cast<double>(Sum.Cycles[N]) / All);
  return Text + "\n";
}

std::string line(std::string_view Who, const CacheTime &T) {
  const uint64_t Requests = T.Reads + T.Writes + T.Atomics;
  return fmt::format("{:<12} {} requests, {:.1f} % hits, {} written back\n",
                     Who, Requests,
                     Requests ? 100.0 * static_cast<double>(T.Hits + T.Merged) /
                                    static_cast<double>(Requests)
                              : 0.0,
                     T.Writebacks);
}

} // namespace

std::string toJson(const TimeReport &R) {
  Json J{{"cycles", R.Cycles},
         {"clock_mhz", R.ClockMhz},
         {"clock_version", ClockVersion},
         {"machine", R.Machine},
         {"machine_changes", R.MachineChanges},
         {"dram_table",
          {{"file", R.DramTableFile}, {"fnv1a64", R.DramTableHash}}}};
  // With units these are part of the cycles.
  const bool IsBeside = R.DmaEngines.empty();
  J["host"] = {{"launch_ns", IsBeside ? R.Host.LaunchNs : 0},
               {"copy_ns", IsBeside ? R.Host.CopyNs : 0},
               {"copy_mbps", IsBeside ? R.Host.CopyMbps : 0},
               {"dram_burst_bytes", R.DramBurstBytes}};
  J["lane_areas"] = ownJson<Json>(areasJson());
  J["cores"] = json(R.Cores);
  J["rasterizers"] = json(R.Rasters);
  J["pixel_units"] = json(R.PixelUnits);
  J["command_processors"] = json(R.CommandProcessors);
  J["dma_engines"] = json(R.DmaEngines);
  J["l2"] = json(R.L2);
  J["llc"] = json(R.Llc);
  J["link"] = json(R.Link);
  J["dram"] = json(R.Dram);
  Json Activities = Json::array();
  for (const Activity &A : R.Activities)
    Activities.push_back(
        {{"unit", A.Unit}, {"event", A.Event}, {"count", A.Count}});
  J["activities"] = std::move(Activities);
  J["stale_loads"] = R.StaleLoads;
  J["commands_left"] = R.CommandsLeft;
  J["out_of_order"] = R.OutOfOrder;
  return jsonText(J);
}

std::string toText(const TimeReport &R) {
  std::string Text =
      fmt::format("cycles       {} ({:.3f} ms at {} MHz, clock version {})\n",
                  R.Cycles, static_cast<double>(R.Cycles) / (1e3 * R.ClockMhz),
                  R.ClockMhz, ClockVersion);
  Text += fmt::format("machine      {}\n", R.Machine);
  if (R.Cycles == 0)
    return Text;
  const auto Percent = [&R](uint64_t Part) {
    return 100.0 * static_cast<double>(Part) / static_cast<double>(R.Cycles);
  };
  Text += shares("cores", R.Cores, R.Cycles);
  Text += shares("rasterizers", R.Rasters, R.Cycles);
  Text += shares("pixel units", R.PixelUnits, R.Cycles);
  if (!R.DmaEngines.empty()) {
    Text += shares("commands", R.CommandProcessors, R.Cycles);
    Text += shares("dma engines", R.DmaEngines, R.Cycles);
  }
  for (size_t N = 0; N != R.L2.size(); ++N)
    Text += line(R.L2.size() == 1 ? "l2" : fmt::format("l2 {}", N), R.L2[N]);
  Text += line("llc", R.Llc);
  if (R.Link.BytesToL2 || R.Link.BytesFromL2)
    Text +=
        fmt::format("{:<12} {} bytes to the L2, busy {:.1f} %, and {} back, "
                    "busy {:.1f} %\n",
                    "link", R.Link.BytesToL2, Percent(R.Link.BusyToL2),
                    R.Link.BytesFromL2, Percent(R.Link.BusyFromL2));
  const uint64_t Rows = R.Dram.RowHits + R.Dram.RowMisses + R.Dram.RowConflicts;
  Text += fmt::format(
      "{:<12} {} read and {} write bursts, row hits of {:.1f} % of lines\n",
      "dram", R.Dram.ReadBursts, R.Dram.WriteBursts,
      Rows ? 100.0 * static_cast<double>(R.Dram.RowHits) /
                 static_cast<double>(Rows)
           : 0.0);
  if (R.StaleLoads)
    Text += fmt::format(
        "stale        {} loads hit data cache lines that other cores had "
        "written since\n",
        R.StaleLoads);
  if (R.CommandsLeft)
    Text += fmt::format("pending      {} tile commands without a wait\n",
                        R.CommandsLeft);
  return Text;
}

} // namespace vorion::isasim
