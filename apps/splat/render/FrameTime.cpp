#include "render/FrameTime.h"

#include "device/ClockedMachine.h"
#include "io/Mean.h"
#include "vorion/support/Letters.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

std::optional<TimeReport> stageTime(const StageReport &S) {
  std::optional<TimeReport> Sum;
  for (const KernelReport &K : S.Kernels) {
    if (!K.Time)
      return std::nullopt;
    add(Sum, K.Time);
  }
  return Sum;
}

std::optional<TimeReport> frameTime(const std::vector<StageReport> &Stages) {
  std::optional<TimeReport> Sum;
  for (const StageReport &S : Stages) {
    if (!isFrameStage(S.Kind) || S.Kernels.empty())
      continue;
    const auto Time = stageTime(S);
    if (!Time)
      return std::nullopt;
    add(Sum, Time);
  }
  return Sum;
}

namespace {

unsigned launches(const StageReport &S) {
  return std::accumulate(
      S.Kernels.begin(), S.Kernels.end(), 0U,
      [](unsigned Sum, const KernelReport &K) { return Sum + K.Launches; });
}

double milliseconds(const TimeReport &T) {
  return static_cast<double>(T.Cycles) / (1e3 * T.ClockMhz);
}

/// Of a stage's copies between host and device.
double copyMilliseconds(const StageReport &S, const HostTiming &Host) {
  if (Host.CopyMbps == 0)
    return 0; // the cycles have it
  return S.Copies * static_cast<double>(Host.CopyNs) / 1e6 +
         static_cast<double>(S.CopiedBytes) / (1e3 * Host.CopyMbps);
}

double launchMilliseconds(const StageReport &S, const HostTiming &Host) {
  return launches(S) * static_cast<double>(Host.LaunchNs) / 1e6;
}

FrameMilliseconds frameMilliseconds(const std::vector<StageReport> &Stages,
                                    const TimeReport &Sum) {
  FrameMilliseconds F;
  F.Kernels = milliseconds(Sum);
  for (const StageReport &S : Stages)
    if (isFrameStage(S.Kind)) {
      F.Launches += launchMilliseconds(S, Sum.Host);
      F.Copies += copyMilliseconds(S, Sum.Host);
    }
  return F;
}

/// The share of some reasons in all \p Cycles of the units \p Units, in
/// percent.
template <typename Count>
double share(uint64_t Cycles, const std::vector<UnitCounts<Count>> &Units,
             const std::vector<Count> &Some) {
  double Sum = 0;
  for (const UnitCounts<Count> &U : Units)
    for (const Count Reason : Some)
      Sum += static_cast<double>(U[Reason]);
  const double All =
      static_cast<double>(Cycles) * static_cast<double>(Units.size());
  return All > 0 ? 100 * Sum / All : 0;
}

/// Of the cores that wait for rasterizers or for a launch, in percent.
double waitingShare(const TimeReport &T) {
  std::vector<CoreCount> Waits;
  for (const CoreCount Reason : reasonsOf<CoreCount>()) {
    const ReasonGroup Group =
        Reasons<CoreCount>[static_cast<std::size_t>(Reason)].Group;
    if (Group == ReasonGroup::CoreRasterizes ||
        Group == ReasonGroup::CoreAwaitsLaunch)
      Waits.push_back(Reason);
  }
  return share(T.Cycles, T.Cores, Waits);
}

double dramMegabytes(const TimeReport &T) {
  return (static_cast<double>(T.Dram[DramCount::ReadBursts]) +
          static_cast<double>(T.Dram[DramCount::WriteBursts])) *
         T.Host.DramBurstBytes / 1e6;
}

/// A line about the link to the L2; empty for a machine without one.
std::string linkText(const TimeReport &T) {
  const auto Megabytes = [&T](LinkCount Bytes) {
    return static_cast<double>(T.Link[Bytes]) / 1e6;
  };
  const auto Busy = [&T](LinkCount Cycles) {
    return 100 * static_cast<double>(T.Link[Cycles]) /
           static_cast<double>(T.Cycles);
  };
  if (T.Link == UnitCounts<LinkCount>())
    return {};
  return fmt::format(
      "link: {:.2f} MB to the L2, busy {:.1f} %; {:.2f} MB back, "
      "busy {:.1f} %\n",
      Megabytes(LinkCount::BytesToL2), Busy(LinkCount::BusyToL2),
      Megabytes(LinkCount::BytesFromL2), Busy(LinkCount::BusyFromL2));
}

/// A column of the table: a reason for cycles of cores, by the report's name
/// and with the report's figure.
struct Column {
  std::string_view Name;
  CoreCount Reason;
  std::size_t width() const {
    return std::max<std::size_t>(8, Name.size() + 1);
  }
};

/// Rows for stages, and a last one for \p Whole. A reason to which hardly a
/// cycle went has no column.
class Table {
public:
  explicit Table(const TimeReport &Whole) : Whole(Whole) {
    constexpr double Least = 0.5; // percent
    for (const CoreCount Reason : reasonsOf<CoreCount>())
      if (share<CoreCount>(Whole.Cycles, Whole.Cores, {Reason}) >= Least)
        Shown.push_back(
            {CountNames<CoreCount>[static_cast<std::size_t>(Reason)], Reason});
  }

  std::string head() const;
  std::string row(std::string_view Name, const TimeReport &T) const;

private:
  const TimeReport &Whole;
  std::vector<Column> Shown;
  /// Of the column of all reasons that have none.
  static constexpr std::size_t OtherWidth = 8;
};

std::string Table::head() const {
  std::string Names;
  for (const Column &C : Shown)
    Names += fmt::format("{:>{}}", C.Name, C.width());
  Names += fmt::format("{:>{}}", "other", OtherWidth);
  return fmt::format("\nmachine: {}\n{:<18}{:>12}{:>7}{:>9} |{:>{}} |{:>15}|\n"
                     "{:<18}{:>12}{:>7}{:>9} |{} |{:>7}{:>7} |{:>9}\n",
                     clockedMachine(Whole), "", "", "", "",
                     "cycles of cores in %", Names.size(), "rasterizers ",
                     "stage", "cycles", "%", "ms", Names, "blend", "fetch",
                     "DRAM MB");
}

std::string Table::row(std::string_view Name, const TimeReport &T) const {
  const double FrameCycles = std::max(1.0, static_cast<double>(Whole.Cycles));
  std::string Shares;
  double Other = T.Cycles ? 100 : 0;
  for (const Column &C : Shown) {
    const double Share = share<CoreCount>(T.Cycles, T.Cores, {C.Reason});
    Shares += fmt::format("{:>{}.1f}", Share, C.width());
    Other -= Share;
  }
  Shares += fmt::format("{:>{}.1f}", std::max(0.0, Other), OtherWidth);
  return fmt::format(
      "{:<18}{:>12}{:>7.1f}{:>9.3f} |{} |{:>7.1f}{:>7.1f} |{:>9.2f}\n", Name,
      T.Cycles, 100 * static_cast<double>(T.Cycles) / FrameCycles,
      milliseconds(T), Shares,
      share<RasterCount>(T.Cycles, T.Rasterizers, {RasterCount::Blend}),
      share<RasterCount>(T.Cycles, T.Rasterizers, {RasterCount::Fetch}),
      dramMegabytes(T));
}

/// Cycles, of \p Cycles, in which the busiest of the units \p Units was not
/// idle.
template <typename Count>
uint64_t busyCycles(uint64_t Cycles,
                    const std::vector<UnitCounts<Count>> &Units) {
  uint64_t Most = 0;
  for (const UnitCounts<Count> &U : Units)
    Most = std::max(Most, Cycles - U[Count::Idle]);
  return Most;
}

/// How long the stages of a sequence took, those of the same kind in one.
/// Nothing is known without the clock.
struct SequenceTimes {
  explicit SequenceTimes(const SequenceResult &R);

  std::vector<StageReport> ByKind;
  std::optional<TimeReport> Sum;
  double Total = 0;               ///< ms, launches and copies included
  std::vector<double> Latency;    ///< ms, by picture
  double Cores = 0;               ///< ms that they had work of their own
  double Rasters = 0, Pixels = 0; ///< ms of the busiest
  double all() const { return Cores + Rasters + Pixels; }
  double bound() const { return std::max({Cores, Rasters, Pixels}); }
  double kernels() const { return milliseconds(*Sum); }
};

SequenceTimes::SequenceTimes(const SequenceResult &R)
    : Sum(frameTime(R.Stages)), Latency(R.Frames.size()) {
  if (!Sum)
    return;
  std::vector<double> Begins(R.Frames.size(), -1);
  for (std::size_t N = 0; N < R.Stages.size(); ++N) {
    const StageReport &S = R.Stages[N];
    const auto Time = stageTime(S);
    if (!isFrameStage(S.Kind) || !Time)
      continue;
    double &Begin = Begins[R.FrameOf[N]];
    if (Begin < 0)
      Begin = Total;
    Total += milliseconds(*Time) + launchMilliseconds(S, Sum->Host) +
             copyMilliseconds(S, Sum->Host);
    Latency[R.FrameOf[N]] = Total - Begin;
    const auto Same = std::ranges::find(ByKind, S.Kind, &StageReport::Kind);
    if (Same == ByKind.end()) {
      ByKind.push_back(S);
      continue;
    }
    Same->Kernels.insert(Same->Kernels.end(), S.Kernels.begin(),
                         S.Kernels.end());
    Same->Copies += S.Copies;
    Same->CopiedBytes += S.CopiedBytes;
  }
  const double PerCycle = 1 / (1e3 * Sum->ClockMhz);
  Cores = kernels() * (1 - waitingShare(*Sum) / 100);
  Rasters =
      PerCycle * static_cast<double>(busyCycles(Sum->Cycles, Sum->Rasterizers));
  Pixels =
      PerCycle * static_cast<double>(busyCycles(Sum->Cycles, Sum->PixelUnits));
}

} // namespace

std::optional<FrameMilliseconds>
frameMilliseconds(const std::vector<StageReport> &Stages) {
  const auto Sum = frameTime(Stages);
  if (!Sum)
    return std::nullopt;
  return frameMilliseconds(Stages, *Sum);
}

Json frameJson(const std::vector<StageReport> &Stages) {
  const auto Sum = frameTime(Stages);
  if (!Sum)
    return {};
  const FrameMilliseconds F = frameMilliseconds(Stages, *Sum);
  Json All = Json::array();
  for (const StageReport &S : Stages) {
    Json One{{"name", name(S.Kind)},
             {"of_the_frame", isFrameStage(S.Kind)},
             {"launches", launches(S)},
             {"launch_ms", launchMilliseconds(S, Sum->Host)},
             {"copies", S.Copies},
             {"copied_bytes", S.CopiedBytes},
             {"copy_ms", copyMilliseconds(S, Sum->Host)}};
    if (const auto Time = stageTime(S)) {
      One["time"] = toJson(*Time);
      for (const KernelReport &K : S.Kernels)
        if (K.Time)
          One["kernels"].push_back(
              {{"name", K.Name}, {"cycles", K.Time->Cycles}});
    }
    All.push_back(std::move(One));
  }
  return {{"frame_ms", F.all()},
          {"kernel_ms", F.Kernels},
          {"launch_ms", F.Launches},
          {"copy_ms", F.Copies},
          {"fps", 1e3 / F.all()},
          {"sum", toJson(*Sum)},
          {"stages", All}};
}

std::string frameText(const std::vector<StageReport> &Stages,
                      const std::string &What) {
  const auto Whole = frameTime(Stages);
  if (!Whole)
    return {};
  const Table Rows(*Whole);
  std::string Text = Rows.head();
  for (const StageReport &S : Stages)
    if (const auto Time = stageTime(S))
      Text += Rows.row(name(S.Kind), *Time);
  Text += Rows.row(What, *Whole) + linkText(*Whole);
  const FrameMilliseconds F = frameMilliseconds(Stages, *Whole);
  return Text + fmt::format("{0} {1:.3f} ms, of which launches {2:.3f} and "
                            "copies {3:.3f}: {4:.2f} {0}s per second\n",
                            What, F.all(), F.Launches, F.Copies, 1e3 / F.all());
}

Json sequenceJson(const SequenceResult &R) {
  const SequenceTimes T(R);
  if (!T.Sum)
    return {};
  Json Stages = Json::array();
  for (const StageReport &S : T.ByKind)
    Stages.push_back({{"name", name(S.Kind)}, {"time", toJson(*stageTime(S))}});
  return {{"pictures", R.Frames.size()},
          {"total_ms", T.Total},
          {"fps", 1e3 * static_cast<double>(R.Frames.size()) / T.Total},
          {"latency_ms", T.Latency},
          {"kernel_ms", T.kernels()},
          {"core_busy_ms", T.Cores},
          {"rasterizer_busy_ms", T.Rasters},
          {"pixel_unit_busy_ms", T.Pixels},
          {"bound_ms", T.bound()},
          {"beside_ms", T.all() - T.kernels()},
          {"sum", toJson(*T.Sum)},
          {"stages", Stages}};
}

std::string sequenceText(const SequenceResult &R) {
  const SequenceTimes T(R);
  if (!T.Sum)
    return {};
  const Table Rows(*T.Sum);
  std::string Text = Rows.head();
  for (const StageReport &S : T.ByKind)
    Text += Rows.row(name(S.Kind), *stageTime(S));
  Text += Rows.row("all", *T.Sum) + linkText(*T.Sum);
  return Text +
         fmt::format("{} in {:.3f} ms: {:.2f} per second, latency {:.3f} ms "
                     "per picture\nbusy: cores {:.3f} ms, "
                     "rasterizers {:.3f}, pixel units {:.3f}; {:.3f} ms "
                     "overlapped, bound {:.3f} ms\n",
                     counted(R.Frames.size(), "picture"), T.Total,
                     1e3 * static_cast<double>(R.Frames.size()) / T.Total,
                     meanOf(T.Latency), T.Cores, T.Rasters, T.Pixels,
                     T.all() - T.kernels(), T.bound());
}

} // namespace vorion::splat
