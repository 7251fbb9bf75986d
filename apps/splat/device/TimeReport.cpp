#include "device/TimeReport.h"

#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// \name The members of a report with their keys, in the report's order
/// Reading and writing follow from these.
/// @{
template <typename Count, typename Visitor>
void visit(UnitCounts<Count> &U, const Visitor &Visit) {
  for (std::size_t I = 0; I != U.Values.size(); ++I)
    Visit(CountNames<Count>[I], U.Values[I]);
}

template <typename Visitor> void visit(HostTiming &H, const Visitor &Visit) {
  Visit("launch_ns", H.LaunchNs);
  Visit("copy_ns", H.CopyNs);
  Visit("copy_mbps", H.CopyMbps);
  Visit("dram_burst_bytes", H.DramBurstBytes);
}

template <typename Visitor> void visit(LaneAreas &A, const Visitor &Visit) {
  Visit("exp", A.Exponential);
  Visit("blend", A.Blend);
  Visit("reciprocal", A.Reciprocal);
  Visit("other", A.Other);
}

template <typename Visitor> void visit(DramTable &T, const Visitor &Visit) {
  Visit("file", T.File);
  Visit("fnv1a64", T.Hash);
}

template <typename Visitor> void visit(Activity &A, const Visitor &Visit) {
  Visit("unit", A.Unit);
  Visit("event", A.Event);
  Visit("count", A.Count);
}

template <typename Visitor> void visit(TimeReport &R, const Visitor &Visit) {
  Visit("cycles", R.Cycles);
  Visit("clock_mhz", R.ClockMhz);
  Visit("clock_version", R.ClockVersion);
  Visit("machine", R.Machine);
  Visit("machine_changes", R.MachineChanges);
  Visit("dram_table", R.TableOfDram);
  Visit("host", R.Host);
  Visit("lane_areas", R.Areas);
  Visit("cores", R.Cores);
  Visit("rasterizers", R.Rasterizers);
  Visit("pixel_units", R.PixelUnits);
  Visit("command_processors", R.CommandProcessors);
  Visit("dma_engines", R.DmaEngines);
  Visit("l2", R.L2);
  Visit("llc", R.Llc);
  Visit("link", R.Link);
  Visit("dram", R.Dram);
  Visit("activities", R.Activities);
  Visit("stale_loads", R.StaleLoads);
  Visit("commands_left", R.CommandsLeft);
  Visit("out_of_order", R.OutOfOrder);
}
/// @}

class Reader {
public:
  void read(const Json &From, uint64_t &To) {
    if (expect(From.is_number_unsigned(), "a count"))
      To = From.get<uint64_t>();
  }
  void read(const Json &From, unsigned &To) {
    uint64_t Wide = 0;
    read(From, Wide);
    if (expect(Wide <= std::numeric_limits<unsigned>::max(), "32 bits"))
      To = static_cast<unsigned>(Wide);
  }
  void read(const Json &From, double &To) {
    if (expect(From.is_number(), "a number"))
      To = From.get<double>();
  }
  void read(const Json &From, std::string &To) {
    if (expect(From.is_string(), "a string"))
      To = From.get<std::string>();
  }
  template <typename T> void read(const Json &From, std::vector<T> &To) {
    if (!expect(From.is_array(), "a list"))
      return;
    To.resize(From.size());
    for (std::size_t I = 0; I != To.size(); ++I)
      read(From[I], To[I]);
  }
  template <typename T> void read(const Json &From, T &To) {
    if (!expect(From.is_object(), "an object"))
      return;
    std::size_t Known = 0;
    visit(To, [&](std::string_view Key, auto &Member) {
      const std::string Outer = Where;
      Where += fmt::format("/{}", Key);
      const auto Found = From.find(std::string(Key));
      if (expect(Found != From.end(), "this member"))
        read(*Found, Member);
      Where = Outer;
      ++Known;
    });
    expect(From.size() == Known, fmt::format("{} members", Known));
  }

  /// The first thing that is wrong, or nothing.
  const std::optional<Error> &problem() const { return Problem; }

private:
  bool expect(bool IsSo, std::string_view What) {
    if (!IsSo && !Problem)
      Problem = Error{
          "the device's time report",
          fmt::format("{}: expected {}", Where.empty() ? "/" : Where, What)};
    return IsSo;
  }

  std::string Where;
  std::optional<Error> Problem;
};

template <typename T> Json written(T &Value);
template <typename T> Json written(std::vector<T> &Values) {
  Json J = Json::array();
  for (T &Value : Values)
    J.push_back(written(Value));
  return J;
}
template <typename T> Json written(T &Value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return Value;
  } else {
    Json J;
    visit(Value, [&J](std::string_view Key, auto &Member) {
      J[std::string(Key)] = written(Member);
    });
    return J;
  }
}

/// Of units in their order; those of one machine are as many.
template <typename T>
void addEach(std::vector<T> &To, const std::vector<T> &Of) {
  for (std::size_t I = 0; I != std::min(To.size(), Of.size()); ++I)
    To[I] += Of[I];
}

/// A part that the machine has in one run only, in cycles of each (the unit
/// "time"), is there for as long as the other run takes, too.
uint64_t during(const Activity &A, uint64_t Own, uint64_t Other) {
  return A.Unit == "time" && Own != 0 ? A.Count / Own * Other : 0;
}

/// By names: runs have activities that others have not.
void addActivities(TimeReport &To, const TimeReport &Of) {
  const auto Same = [](const std::vector<Activity> &In, const Activity &A) {
    return std::ranges::find_if(In, [&](const Activity &Other) {
      return Other.Unit == A.Unit && Other.Event == A.Event;
    });
  };
  std::vector<Activity> Sum = To.Activities;
  for (Activity &A : Sum) {
    const auto Found = Same(Of.Activities, A);
    A.Count += Found != Of.Activities.end() ? Found->Count
                                            : during(A, To.Cycles, Of.Cycles);
  }
  for (const Activity &A : Of.Activities)
    if (Same(To.Activities, A) == To.Activities.end()) {
      Sum.push_back(A);
      Sum.back().Count += during(A, Of.Cycles, To.Cycles);
    }
  To.Activities = std::move(Sum);
}

} // namespace

TimeReport &TimeReport::operator+=(const TimeReport &Later) {
  addActivities(*this, Later);
  Cycles += Later.Cycles;
  addEach(Cores, Later.Cores);
  addEach(Rasterizers, Later.Rasterizers);
  addEach(PixelUnits, Later.PixelUnits);
  addEach(CommandProcessors, Later.CommandProcessors);
  addEach(DmaEngines, Later.DmaEngines);
  addEach(L2, Later.L2);
  Llc += Later.Llc;
  Link += Later.Link;
  Dram += Later.Dram;
  StaleLoads += Later.StaleLoads;
  CommandsLeft = Later.CommandsLeft;
  OutOfOrder += Later.OutOfOrder;
  return *this;
}

void add(std::optional<TimeReport> &Sum,
         const std::optional<TimeReport> &Later) {
  if (!Sum)
    Sum = Later;
  else if (Later)
    *Sum += *Later;
}

Expected<TimeReport> parseTimeReport(std::string_view Text) {
  const auto Whole =
      parseJson<Json>(Text, "the device's time report", "an object");
  if (!Whole)
    return Whole.error();
  TimeReport R;
  Reader In;
  In.read(*Whole, R);
  if (In.problem())
    return *In.problem();
  return R;
}

Json toJson(TimeReport R) { return written(R); }

} // namespace vorion::splat
