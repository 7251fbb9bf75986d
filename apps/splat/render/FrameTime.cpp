#include "FrameTime.h"

#include "../device/TimeReports.h"

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

/// The sum over the kernels of a stage; empty without the clock.
std::string stageTime(const StageReport &S) {
  std::string Sum;
  for (const KernelReport &K : S.Kernels)
    Sum = addTimeReports(Sum, K.Time);
  return Sum;
}

/// The frame's kernels in one report, or empty.
std::string frameTime(const std::vector<StageReport> &Stages) {
  std::string Sum;
  for (const StageReport &S : Stages)
    if (isOfTheFrame(S))
      Sum = addTimeReports(Sum, stageTime(S));
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
  return fmt::format("{:<15}{:>12}{:>7.1f}{:>9.3f} |{:>7.1f}{:>8.1f}{:>9.1f}"
                     "{:>8.1f}{:>7.1f} |{:>7.1f}{:>7.1f} |{:>9.2f}\n",
                     Name, Cycles,
                     100 * static_cast<double>(Cycles) / FrameCycles,
                     milliseconds(T), Issue, Memory, Operand, Raster,
                     Cycles ? 100 - Issue - Memory - Operand - Raster : 0.0,
                     share(T, "rasterizers", {"blend"}),
                     share(T, "rasterizers", {"fetch"}), dramMegabytes(T));
}

} // namespace

std::string frameJson(const std::vector<StageReport> &Stages) {
  const std::string Text = frameTime(Stages);
  if (Text.empty())
    return {};
  const Json Sum = Json::parse(Text);
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
    if (const std::string Time = stageTime(S); !Time.empty()) {
      One["time"] = Json::parse(Time);
      for (const KernelReport &K : S.Kernels)
        if (!K.Time.empty())
          One["kernels"].push_back(
              {{"name", K.Name}, {"cycles", Json::parse(K.Time)["cycles"]}});
    }
    All.push_back(std::move(One));
  }
  return Json{{"frame_ms", F.all()},
              {"kernel_ms", F.Kernels},
              {"launch_ms", F.Launches},
              {"copy_ms", F.Copies},
              {"fps", 1e3 / F.all()},
              {"sum", Sum},
              {"stages", All}}
      .dump();
}

std::string frameText(const std::vector<StageReport> &Stages,
                      const std::string &What) {
  const std::string Sum = frameTime(Stages);
  if (Sum.empty())
    return {};
  const Json Whole = Json::parse(Sum);
  const double Cycles = std::max(1.0, Whole["cycles"].get<double>());
  std::string Text = fmt::format(
      "\n{:<15}{:>12}{:>7}{:>9} |{:>31} in % |{:>15}|\n{:<15}{:>12}{:>7}{:>9} "
      "|{:>7}{:>8}{:>9}{:>8}{:>7} |{:>7}{:>7} |{:>9}\n",
      fmt::format("at {} MHz", Whole["clock_mhz"].get<unsigned>()), "", "", "",
      "cycles of cores", "rasterizers ", "stage", "cycles", "%", "ms", "issue",
      "memory", "operand", "raster", "other", "blend", "fetch", "DRAM MB");
  for (const StageReport &S : Stages)
    if (const std::string Time = stageTime(S); !Time.empty())
      Text += row(S.Name, Json::parse(Time), Cycles);
  Text += row(What, Whole, Cycles);
  const FrameMilliseconds F = frameMilliseconds(Stages, Whole);
  return Text + fmt::format("{0} {1:.3f} ms, of it launches {2:.3f} and copies "
                            "{3:.3f}: {4:.2f} {0}s a second\n",
                            What, F.all(), F.Launches, F.Copies, 1e3 / F.all());
}

std::uint64_t frameCycles(const std::vector<StageReport> &Stages) {
  const std::string Sum = frameTime(Stages);
  return Sum.empty() ? 0 : Json::parse(Sum)["cycles"].get<std::uint64_t>();
}

} // namespace vorion::splat
