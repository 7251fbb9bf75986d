#include "Sweep.h"

#include "../io/Metrics.h"
#include "../render/Options.h"
#include "Points.h"
#include "Process.h"
#include "Reference.h"
#include "Thumbnail.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// One run of `splat render` for a point.
struct Run {
  Json Report;
  ExactImage Picture;
};

class PointMeasurement {
public:
  PointMeasurement(const SweepPlan &Plan, const Point &Which)
      : P(Plan), Of(Which),
        Base(fmt::format("{}/work/{}", P.Folder, asFileName(Of.name()))) {}

  Expected<Json> measure();

private:
  Expected<Run> run(const std::vector<std::string> &Arguments);
  Expected<Json> errors(const ExactImage &Picture, const ExactImage &Right);

  const SweepPlan &P;
  const Point &Of;
  const std::string Base;
};

Expected<Run> PointMeasurement::run(const std::vector<std::string> &Arguments) {
  const std::string PictureFile = Base + ".npz", ReportFile = Base + ".json";
  std::vector<std::string> Words{
      "render",      P.ScenePath, "--cameras", P.CameraFile, "--view",
      Of.View->Name, "-o",        PictureFile, "--json",     ReportFile};
  Words.insert(Words.end(), P.CommonArguments.begin(), P.CommonArguments.end());
  Words.insert(Words.end(), Arguments.begin(), Arguments.end());
  if (auto Done = runSplat(Words, Base + ".log"); !Done)
    return Done.error();
  auto Report = readJson(ReportFile);
  if (!Report)
    return Report.error();
  auto Picture = readImage(PictureFile);
  if (!Picture)
    return Picture.error();
  for (const char *Ending : {".npz", ".json", ".log"})
    std::filesystem::remove(Base + Ending);
  return Run{std::move(*Report), std::move(*Picture)};
}

Expected<Json> PointMeasurement::errors(const ExactImage &Picture,
                                        const ExactImage &Right) {
  if (Picture.Width != Right.Width || Picture.Height != Right.Height)
    return Error{Base, "picture and reference differ in size, expected a "
                       "folder of this scene and these cameras"};
  const Difference D = compare(Right.Render, Picture.Render, 3);
  Json J{{"ssim", ssim(Right.Render, Picture.Render,
                       static_cast<std::size_t>(Right.Width), 3)},
         {"largest", D.MaxAbs},
         {"off_share", D.OffShare}};
  // JSON has no infinity: nothing stands for equal pictures.
  J["psnr_db"] = std::isfinite(D.PsnrDb) ? Json(D.PsnrDb) : Json();
  return J;
}

/// Seconds of what a user waits for each frame: not compiling the kernels.
double wallSeconds(const Json &Report) {
  double Sum = 0;
  for (const Json &S : Report["stages"])
    if (S["name"] != "build")
      Sum += S["seconds"].get<double>();
  return Sum;
}

double laneArea(const Json &Areas, const Setting &S) {
  const auto Of = [&](const char *Knob,
                      const std::vector<std::string> &ByNumber) {
    const auto Place =
        std::find(ByNumber.begin(), ByNumber.end(), S.value(Knob));
    return Areas[Knob]
        .at(static_cast<std::size_t>(Place - ByNumber.begin()))
        .get<double>();
  };
  std::vector<std::string> Exps(ExpUnitNames.begin(), ExpUnitNames.end());
  return Areas["other"].get<double>() + Of("exp", Exps) +
         Of("blend", {"fp32", "bf16", "fp16"});
}

/// Cycles in which the busiest rasterizer gives pixels to lanes.
double laneCycles(const Json &Time) {
  double Most = 0;
  for (const Json &R : Time["rasterizers"])
    Most = std::max(Most, R["blend"].get<double>());
  return Most;
}

Expected<Json> PointMeasurement::measure() {
  const auto Right = referenceOf(P, Of);
  if (!Right)
    return Right.error();
  // Without the clock for the simulator's own speed, with it for the machine's.
  const auto Plain = run(Of.Chosen.arguments());
  if (!Plain)
    return Plain.error();
  std::vector<std::string> Timed = Of.Chosen.arguments();
  Timed.emplace_back("--time");
  const auto Clocked = run(Timed);
  if (!Clocked)
    return Clocked.error();
  auto Errors = errors(Plain->Picture, *Right);
  if (!Errors)
    return Errors.error();

  const Json &Time = Clocked->Report["time"]["sum"];
  const double Cycles = Time["cycles"].get<double>();
  const double Area = laneArea(Time["lane_areas"], Of.Chosen);
  const double Relative = Area / laneArea(Time["lane_areas"], Setting());
  const double LaneCycles = laneCycles(Time);
  Json Times{{"cycles", Cycles},
             {"equal_area_cycles", Cycles + LaneCycles * (Relative - 1)},
             {"cores_cycles", nullptr},
             {"wall_seconds", wallSeconds(Plain->Report)}};
  Json Kernels;
  if (auto Cores = Of.Chosen.coresArguments(); Cores && P.Cores) {
    Cores->emplace_back("--time");
    const auto OnCores = run(*Cores);
    if (!OnCores)
      return OnCores.error();
    Times["cores_cycles"] = OnCores->Report["time"]["sum"]["cycles"];
    auto Their = errors(OnCores->Picture, *Right);
    if (!Their)
      return Their.error();
    Kernels = std::move(*Their);
  }
  auto Small = thumbnail(Plain->Picture, P.ThumbWidth);
  auto Apart = differenceThumbnail(Plain->Picture, *Right, P.ThumbWidth);
  if (!Small || !Apart)
    return Small ? Apart.error() : Small.error();
  Json Made = Plain->Report;
  Made.erase("stages");
  return Json{
      {"setting", Of.Chosen.name()},    {"view", Of.View->Name},
      {"errors", std::move(*Errors)},   {"cores_errors", std::move(Kernels)},
      {"times", std::move(Times)},      {"lane_cycles", LaneCycles},
      {"lane_area_um2", Area},          {"lane_area_relative", Relative},
      {"made_by", std::move(Made)},     {"picture", std::move(*Small)},
      {"difference", std::move(*Apart)}};
}

/// Of equal pictures, for orders: beyond any PSNR of unequal ones.
double decibels(const Json &Value) {
  return Value.is_null() ? std::numeric_limits<double>::infinity()
                         : Value.get<double>();
}

} // namespace

std::string Point::name() const { return Chosen.name() + "@" + View->Name; }

std::vector<Point> pointsOf(const SweepPlan &P,
                            const std::vector<Setting> &Settings) {
  std::vector<Point> All;
  for (const Camera &View : P.Views)
    for (const Setting &S : Settings)
      All.push_back({S, &View});
  return All;
}

Expected<Point> pointNamed(const SweepPlan &P, const std::string &Name) {
  const std::size_t At = Name.find('@');
  const auto Chosen = Setting::parse(Name.substr(0, At));
  if (!Chosen)
    return Chosen.error();
  for (const Camera &View : P.Views)
    if (At != std::string::npos && View.Name == Name.substr(At + 1))
      return Point{*Chosen, &View};
  return Error{"",
               fmt::format("point '{}': no such view, expected SETTING@VIEW "
                           "as --list prints",
                           Name),
               ExitCode::Usage};
}

std::string fileOf(const SweepPlan &P, const Point &Of) {
  return fmt::format("{}/points/{}.json", P.Folder, asFileName(Of.name()));
}

std::vector<Point> missing(const SweepPlan &P, const std::vector<Point> &Of) {
  std::vector<Point> Left;
  for (const Point &One : Of)
    if (!std::filesystem::exists(fileOf(P, One)))
      Left.push_back(One);
  return Left;
}

Expected<Json> readPoint(const SweepPlan &P, const Point &Of) {
  return readJson(fileOf(P, Of));
}

Expected<Success> measure(const SweepPlan &P, const std::vector<Point> &Points,
                          const std::function<void(std::string_view)> &Said) {
  if (auto Made = makeReferences(P, Points, Said); !Made)
    return Made;
  std::vector<Measuring> Wanted;
  Wanted.reserve(Points.size());
  for (const Point &Of : Points)
    Wanted.push_back({Of.name(), fileOf(P, Of),
                      [&P, &Of] { return PointMeasurement(P, Of).measure(); },
                      [](const Json &M) {
                        return fmt::format("{:.1f} dB, {:.0f} cycles",
                                           decibels(M["errors"]["psnr_db"]),
                                           M["times"]["cycles"].get<double>());
                      }});
  return measureAll(Wanted, P.Jobs, Said);
}

Expected<std::vector<Candidate>>
candidates(const SweepPlan &P, const std::vector<Setting> &Settings,
           const std::vector<const Camera *> &Views) {
  std::vector<Candidate> All;
  for (const Setting &S : Settings) {
    Candidate C{S, std::numeric_limits<double>::infinity(), {}};
    C.Times.fill(0.0);
    for (const Camera *View : Views) {
      const auto M = readPoint(P, {S, View});
      if (!M)
        return M.error();
      C.Db = std::min(C.Db, decibels((*M)["errors"]["psnr_db"]));
      for (std::size_t A = 0; A < TimeAxes; ++A) {
        const Json &Value = (*M)["times"][std::string(TimeAxisNames[A])];
        if (Value.is_null())
          C.Times[A].reset();
        else if (C.Times[A])
          *C.Times[A] += Value.get<double>();
      }
    }
    All.push_back(std::move(C));
  }
  return All;
}

} // namespace vorion::splat
