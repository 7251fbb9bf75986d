#include "FrameTime.h"

#include "../device/TimeReports.h"
#include "../io/Mean.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

bool isOfTheFrame(const StageReport &S) {
  return S.Name != "build" && S.Name != "upload" && S.Name != "read back";
}

unsigned launches(const StageReport &S) {
  return std::accumulate(
      S.Kernels.begin(), S.Kernels.end(), 0U,
      [](unsigned Sum, const KernelReport &K) { return Sum + K.Launches; });
}

/// The sum over the kernels of a stage; null without the clock.
Json stageTime(const StageReport &S) {
  Json Sum;
  for (const KernelReport &K : S.Kernels)
    if (!K.Time.empty())
      addTimeReport(Sum, ownJson<Json>(K.Time));
  return Sum;
}

/// The frame's kernels in one report, or null.
Json frameTime(const std::vector<StageReport> &Stages) {
  Json Sum;
  for (const StageReport &S : Stages)
    if (isOfTheFrame(S))
      addTimeReport(Sum, stageTime(S));
  return Sum;
}

double milliseconds(const Json &Report) {
  return Report["cycles"].get<double>() /
         (1e3 * Report["clock_mhz"].get<double>());
}

/// Of a stage's copies between host and device.
double copyMilliseconds(const StageReport &S, const Json &Host) {
  return S.Copies * Host["copy_ns"].get<double>() / 1e6 +
         static_cast<double>(S.CopiedBytes) /
             (1e3 * Host["copy_mbps"].get<double>());
}

double launchMilliseconds(const StageReport &S, const Json &Host) {
  return launches(S) * Host["launch_ns"].get<double>() / 1e6;
}

struct FrameMilliseconds {
  double Kernels = 0, Launches = 0, Copies = 0;
  double all() const { return Kernels + Launches + Copies; }
};

FrameMilliseconds frameMilliseconds(const std::vector<StageReport> &Stages,
                                    const Json &Sum) {
  FrameMilliseconds F;
  F.Kernels = milliseconds(Sum);
  for (const StageReport &S : Stages)
    if (isOfTheFrame(S)) {
      F.Launches += launchMilliseconds(S, Sum["host"]);
      F.Copies += copyMilliseconds(S, Sum["host"]);
    }
  return F;
}

/// The share of some reasons in all cycles of the units \p Units, in percent.
double share(const Json &Report, const char *Units,
             std::initializer_list<const char *> Reasons) {
  double Sum = 0;
  for (const Json &U : Report[Units])
    for (const char *R : Reasons)
      Sum += U[R].get<double>();
  const double All = Report["cycles"].get<double>() *
                     static_cast<double>(Report[Units].size());
  return All > 0 ? 100 * Sum / All : 0;
}

double dramMegabytes(const Json &Report) {
  return (Report["dram"]["read_bursts"].get<double>() +
          Report["dram"]["write_bursts"].get<double>()) *
         Report["host"]["dram_burst_bytes"].get<double>() / 1e6;
}

std::string row(const std::string &Name, const Json &T, double FrameCycles) {
  const double Issue = share(T, "cores", {"issue"});
  const double Memory =
      share(T, "cores", {"memory", "lsu_queue", "local", "fence"});
  const double Operand = share(T, "cores", {"operand", "unit"});
  const double Raster = share(T, "cores", {"raster_full", "raster_wait"});
  const auto Cycles = T["cycles"].get<std::uint64_t>();
  return fmt::format("{:<18}{:>12}{:>7.1f}{:>9.3f} |{:>7.1f}{:>8.1f}{:>9.1f}"
                     "{:>8.1f}{:>7.1f} |{:>7.1f}{:>7.1f} |{:>9.2f}\n",
                     Name, Cycles,
                     100 * static_cast<double>(Cycles) / FrameCycles,
                     milliseconds(T), Issue, Memory, Operand, Raster,
                     Cycles ? 100 - Issue - Memory - Operand - Raster : 0.0,
                     share(T, "rasterizers", {"blend"}),
                     share(T, "rasterizers", {"fetch"}), dramMegabytes(T));
}

std::string head(const Json &Whole) {
  return fmt::format(
      "\n{:<18}{:>12}{:>7}{:>9} |{:>31} in % |{:>15}|\n{:<18}{:>12}{:>7}{:>9} "
      "|{:>7}{:>8}{:>9}{:>8}{:>7} |{:>7}{:>7} |{:>9}\n",
      fmt::format("at {} MHz", Whole["clock_mhz"].get<unsigned>()), "", "", "",
      "cycles of cores", "rasterizers ", "stage", "cycles", "%", "ms", "issue",
      "memory", "operand", "raster", "other", "blend", "fetch", "DRAM MB");
}

/// Cycles in which the busiest of the units \p Units was not idle.
std::uint64_t busyCycles(const Json &Report, const char *Units) {
  std::uint64_t Most = 0;
  for (const Json &U : Report[Units])
    Most = std::max(Most, Report["cycles"].get<std::uint64_t>() -
                              U["idle"].get<std::uint64_t>());
  return Most;
}

/// How long the stages of a sequence took, those of the same name in one. Sum
/// is null, and nothing else known, without the clock.
struct SequenceTimes {
  explicit SequenceTimes(const SequenceResult &R);

  std::vector<StageReport> ByName;
  Json Sum;
  double Total = 0;               ///< ms, launches and copies included
  std::vector<double> Latency;    ///< ms, by picture
  double Cores = 0;               ///< ms that they did not wait for rasterizers
  double Rasters = 0, Pixels = 0; ///< ms of the busiest
  double all() const { return Cores + Rasters + Pixels; }
  double bound() const { return std::max({Cores, Rasters, Pixels}); }
  double kernels() const { return milliseconds(Sum); }
};

SequenceTimes::SequenceTimes(const SequenceResult &R)
    : Sum(frameTime(R.Stages)), Latency(R.Frames.size()) {
  std::vector<double> Begins(R.Frames.size(), -1);
  for (std::size_t N = 0; N < R.Stages.size(); ++N) {
    const StageReport &S = R.Stages[N];
    const Json Time = stageTime(S);
    if (!isOfTheFrame(S) || Time.is_null())
      continue;
    double &Begin = Begins[R.FrameOf[N]];
    if (Begin < 0)
      Begin = Total;
    Total += milliseconds(Time) + launchMilliseconds(S, Sum["host"]) +
             copyMilliseconds(S, Sum["host"]);
    Latency[R.FrameOf[N]] = Total - Begin;
    const auto Same = std::ranges::find(ByName, S.Name, &StageReport::Name);
    if (Same == ByName.end()) {
      ByName.push_back(S);
      continue;
    }
    Same->Kernels.insert(Same->Kernels.end(), S.Kernels.begin(),
                         S.Kernels.end());
    Same->Copies += S.Copies;
    Same->CopiedBytes += S.CopiedBytes;
  }
  if (Sum.is_null())
    return;
  const double PerCycle = 1 / (1e3 * Sum["clock_mhz"].get<double>());
  Cores = kernels() *
          (1 - share(Sum, "cores", {"raster_full", "raster_wait"}) / 100);
  Rasters = PerCycle * static_cast<double>(busyCycles(Sum, "rasterizers"));
  Pixels = PerCycle * static_cast<double>(busyCycles(Sum, "pixel_units"));
}

} // namespace

std::string frameJson(const std::vector<StageReport> &Stages) {
  const Json Sum = frameTime(Stages);
  if (Sum.is_null())
    return {};
  const FrameMilliseconds F = frameMilliseconds(Stages, Sum);
  Json All = Json::array();
  for (const StageReport &S : Stages) {
    Json One{{"name", S.Name},
             {"of_the_frame", isOfTheFrame(S)},
             {"launches", launches(S)},
             {"launch_ms", launchMilliseconds(S, Sum["host"])},
             {"copies", S.Copies},
             {"copied_bytes", S.CopiedBytes},
             {"copy_ms", copyMilliseconds(S, Sum["host"])}};
    if (Json Time = stageTime(S); !Time.is_null()) {
      One["time"] = std::move(Time);
      for (const KernelReport &K : S.Kernels)
        if (!K.Time.empty())
          One["kernels"].push_back(
              {{"name", K.Name}, {"cycles", ownJson<Json>(K.Time)["cycles"]}});
    }
    All.push_back(std::move(One));
  }
  return jsonText(Json{{"frame_ms", F.all()},
                       {"kernel_ms", F.Kernels},
                       {"launch_ms", F.Launches},
                       {"copy_ms", F.Copies},
                       {"fps", 1e3 / F.all()},
                       {"sum", Sum},
                       {"stages", All}});
}

std::string frameText(const std::vector<StageReport> &Stages,
                      const std::string &What) {
  const Json Whole = frameTime(Stages);
  if (Whole.is_null())
    return {};
  const double Cycles = std::max(1.0, Whole["cycles"].get<double>());
  std::string Text = head(Whole);
  for (const StageReport &S : Stages)
    if (const Json Time = stageTime(S); !Time.is_null())
      Text += row(S.Name, Time, Cycles);
  Text += row(What, Whole, Cycles);
  const FrameMilliseconds F = frameMilliseconds(Stages, Whole);
  return Text + fmt::format("{0} {1:.3f} ms, of it launches {2:.3f} and copies "
                            "{3:.3f}: {4:.2f} {0}s a second\n",
                            What, F.all(), F.Launches, F.Copies, 1e3 / F.all());
}

std::uint64_t frameCycles(const std::vector<StageReport> &Stages) {
  const Json Sum = frameTime(Stages);
  return Sum.is_null() ? 0 : Sum["cycles"].get<std::uint64_t>();
}

std::string sequenceJson(const SequenceResult &R) {
  const SequenceTimes T(R);
  if (T.Sum.is_null())
    return {};
  Json Stages = Json::array();
  for (const StageReport &S : T.ByName)
    Stages.push_back({{"name", S.Name}, {"time", stageTime(S)}});
  return jsonText(
      Json{{"pictures", R.Frames.size()},
           {"total_ms", T.Total},
           {"fps", 1e3 * static_cast<double>(R.Frames.size()) / T.Total},
           {"latency_ms", T.Latency},
           {"kernel_ms", T.kernels()},
           {"core_busy_ms", T.Cores},
           {"rasterizer_busy_ms", T.Rasters},
           {"pixel_unit_busy_ms", T.Pixels},
           {"bound_ms", T.bound()},
           {"beside_ms", T.all() - T.kernels()},
           {"sum", T.Sum},
           {"stages", Stages}});
}

std::string sequenceText(const SequenceResult &R) {
  const SequenceTimes T(R);
  if (T.Sum.is_null())
    return {};
  const double Cycles = std::max(1.0, T.Sum["cycles"].get<double>());
  std::string Text = head(T.Sum);
  for (const StageReport &S : T.ByName)
    Text += row(S.Name, stageTime(S), Cycles);
  Text += row("all", T.Sum, Cycles);
  return Text +
         fmt::format(
             "{} pictures in {:.3f} ms: {:.2f} a second, {:.3f} ms from a "
             "picture's beginning to its end\nbusy: cores {:.3f} ms, "
             "rasterizers {:.3f}, pixel units {:.3f}; {:.3f} ms beside each "
             "other, bound {:.3f} ms\n",
             R.Frames.size(), T.Total,
             1e3 * static_cast<double>(R.Frames.size()) / T.Total,
             meanOf(T.Latency), T.Cores, T.Rasters, T.Pixels,
             T.all() - T.kernels(), T.bound());
}

} // namespace vorion::splat
