#include "accuracy/Sweep.h"

#include "accuracy/Reference.h"
#include "accuracy/Thumbnail.h"
#include "device/ClockedMachine.h"
#include "io/Inside.h"
#include "io/Metrics.h"
#include "study/Process.h"
#include "vorion/support/JsonShape.h"

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
  PointMeasurement(const SweepPlan &Plan, const Point &Target)
      : Plan(Plan), Target(Target),
        Base(fmt::format("{}/work/{}", Plan.Folder,
                         asFileName(Target.name()))) {}

  Expected<Json> measure();

private:
  Expected<Run> run(const std::vector<std::string> &Arguments);
  Expected<Json> errors(const ExactImage &Picture, const ExactImage &Right);

  const SweepPlan &Plan;
  const Point &Target;
  const std::string Base;
};

Expected<Run> PointMeasurement::run(const std::vector<std::string> &Arguments) {
  const std::string PictureFile = Base + ".npz";
  std::vector<std::string> Words =
      renderWords(Plan, Target.View->Name, PictureFile);
  Words.insert(Words.end(), Arguments.begin(), Arguments.end());
  auto Done = runForReport(std::move(Words), Plan.Machine, Base);
  if (!Done)
    return Done.error();
  auto Picture = readImage(PictureFile);
  if (!Picture)
    return Picture.error();
  std::filesystem::remove(PictureFile);
  return Run{std::move(Done->Report), std::move(*Picture)};
}

Expected<Json> PointMeasurement::errors(const ExactImage &Picture,
                                        const ExactImage &Right) {
  if (Picture.Width != Right.Width || Picture.Height != Right.Height)
    return Error{Base, "picture and reference differ in size, expected a "
                       "folder of this scene and these cameras"};
  const Difference D = compare(Right.Render, Picture.Render, 3);
  if (D.NotFinite != 0)
    return Error{
        Target.name(),
        fmt::format("{} pixels have values that are not finite, expected "
                    "finite values; exclude this choice with --knobs",
                    D.NotFinite),
        ExitCode::GuestFailed};
  Json J{{"ssim", ssim(Right.Render, Picture.Render,
                       static_cast<std::size_t>(Right.Width), 3)},
         {"largest", D.MaxAbs},
         {"off_share", D.OffShare}};
  // JSON has no infinity: nothing stands for equal pictures.
  J["psnr_db"] = std::isfinite(D.PsnrDb) ? Json(D.PsnrDb) : Json();
  return J;
}

double laneArea(const Json &Areas, const Setting &S) {
  const auto AreaOf = [&Areas](const char *Units, auto Unit) {
    return Areas[Units]
        .at(static_cast<std::size_t>(Unit))
        .template get<double>();
  };
  return Areas["other"].get<double>() + AreaOf("exp", S.exponential()) +
         AreaOf("blend", S.arithmetic());
}

/// Cycles in which the busiest rasterizer gives pixels to lanes.
double laneCycles(const Json &Time) {
  double Most = 0;
  for (const Json &R : Time["rasterizers"])
    Most = std::max(Most, R["blend"].get<double>());
  return Most;
}

Expected<Json> PointMeasurement::measure() {
  const auto Right = referenceOf(Plan, Target);
  if (!Right)
    return Right.error();
  std::vector<std::string> Timed = Target.Chosen.arguments();
  Timed.emplace_back("--energy");
  auto Clocked = run(Timed);
  // A machine whose clock or DRAM the technology does not know.
  if (!Clocked && !Plan.Energy && Clocked.error().Code == ExitCode::Usage) {
    Timed.back() = "--time";
    Clocked = run(Timed);
  }
  if (!Clocked)
    return Clocked.error();
  auto Errors = errors(Clocked->Picture, *Right);
  if (!Errors)
    return Errors.error();

  const Json &Time = Clocked->Report["time"]["sum"];
  const double Cycles = Time["cycles"].get<double>();
  const double Area = laneArea(Time["lane_areas"], Target.Chosen);
  const double Relative = Area / laneArea(Time["lane_areas"], Setting());
  const double LaneCycles = laneCycles(Time);
  Json Times{{"cycles", Cycles},
             {"equal_area_cycles", Cycles + LaneCycles * (Relative - 1)},
             {"cores_cycles", nullptr},
             {"chip_joules", nullptr}};
  Json Spent;
  if (const Json Energy = Clocked->Report.value("energy", Json());
      Energy.is_object()) {
    Times["chip_joules"] = Energy["chip_joules"]["value"];
    for (const char *Key : {"technology", "volts", "joules", "chip_joules"})
      Spent[Key] = Energy[Key];
  }
  Json Kernels;
  if (auto Cores = Target.Chosen.coresArguments(); Cores && Plan.Cores) {
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
  auto Small = thumbnail(Clocked->Picture, Plan.ThumbWidth);
  auto Apart = differenceThumbnail(Clocked->Picture, *Right, Plan.ThumbWidth);
  if (!Small || !Apart)
    return Small ? Apart.error() : Small.error();
  // Seconds of the host, of one run, are no figure.
  Json Made = Clocked->Report;
  for (const char *Key : {"stages", "time", "energy"})
    Made.erase(Key);
  Made["total"].erase("seconds");
  return Json{{"setting", Target.Chosen.name()},
              {"view", Target.View->Name},
              {ClockedMachineKey, clockedMachine(Time)},
              {"errors", std::move(*Errors)},
              {"cores_errors", std::move(Kernels)},
              {"times", std::move(Times)},
              {"energy", std::move(Spent)},
              {"lane_cycles", LaneCycles},
              {"lane_area_um2", Area},
              {"lane_area_relative", Relative},
              {"has_cost", Target.Chosen.hasCost()},
              {"made_by", std::move(Made)},
              {"picture", std::move(*Small)},
              {"difference", std::move(*Apart)}};
}

/// Whether \p J has what candidates() and the page take.
bool isMeasurement(const Json &J) {
  const JsonShape Number = JsonShape::number(), Text = JsonShape::text();
  // JSON has no infinity: null stands for equal pictures.
  const JsonShape Errors = JsonShape::object({{"psnr_db", Number.orNull()},
                                              {"ssim", Number},
                                              {"largest", Number},
                                              {"off_share", Number}});
  const JsonShape Times = JsonShape::object({{"cycles", Number},
                                             {"equal_area_cycles", Number},
                                             {"cores_cycles", Number.orNull()},
                                             {"chip_joules", Number.orNull()}});
  const JsonShape Shape = JsonShape::object({{"setting", Text},
                                             {"view", Text},
                                             {ClockedMachineKey, Text},
                                             {"errors", Errors},
                                             {"cores_errors", Errors.orNull()},
                                             {"times", Times},
                                             {"lane_area_relative", Number},
                                             {"made_by", JsonShape::object({})},
                                             {"picture", Text},
                                             {"difference", Text}});
  return Shape.check(J, "") && J["point"] == J["setting"].get<std::string>() +
                                                 "@" +
                                                 J["view"].get<std::string>();
}

/// An error's value; of equal pictures, for orders, beyond any PSNR of unequal
/// ones.
double valueOf(const Json &Value) {
  return Value.is_null() ? std::numeric_limits<double>::infinity()
                         : Value.get<double>();
}

Errors errorsOf(const Json &J) {
  Errors E{};
  for (std::size_t K = 0; K < ErrorKinds; ++K)
    E[K] = valueOf(J[std::string(ErrorNames[K])]);
  return E;
}

Errors maxOf(const Errors &A, const Errors &B) {
  Errors Worse{};
  for (std::size_t K = 0; K < ErrorKinds; ++K)
    Worse[K] = moreIsBetter(static_cast<ErrorKind>(K)) ? std::min(A[K], B[K])
                                                       : std::max(A[K], B[K]);
  return Worse;
}

std::string lineOf(const Json &Measured) {
  return fmt::format("{:.1f} dB, {:.0f} cycles; {}",
                     valueOf(Measured["errors"]["psnr_db"]),
                     Measured["times"]["cycles"].get<double>(),
                     Measured[ClockedMachineKey].get<std::string>());
}

/// Adds the measurement \p M of a view to \p C; \p IsFirst: of the first.
void addView(Candidate &C, const Json &M, bool IsFirst) {
  const Errors Own = errorsOf(M["errors"]);
  C.Worst = IsFirst ? Own : maxOf(C.Worst, Own);
  const Json &Cores = M["cores_errors"];
  if (Cores.is_null())
    C.CoresWorst.reset();
  else if (IsFirst)
    C.CoresWorst = errorsOf(Cores);
  else if (C.CoresWorst)
    C.CoresWorst = maxOf(*C.CoresWorst, errorsOf(Cores));
  for (std::size_t A = 0; A < TimeAxes; ++A) {
    const Json &Value = M["times"][std::string(TimeAxisNames[A])];
    if (Value.is_null())
      C.Times[A].reset();
    else if (IsFirst)
      C.Times[A] = Value.get<double>();
    else if (C.Times[A])
      *C.Times[A] += Value.get<double>();
  }
  if (IsFirst)
    C.LaneArea = M["lane_area_relative"].get<double>();
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
               fmt::format("point '{}': unknown view, expected SETTING@VIEW "
                           "as printed by --list",
                           Name),
               ExitCode::Usage};
}

Provenance provenanceOf(const SweepPlan &P, const Point &Of) {
  Provenance From = P.From;
  From["view"] = hashView(*Of.View);
  return From;
}

std::vector<StudyPoint>
studyPoints(const SweepPlan &P, const std::vector<Point> &Points,
            const std::function<void(std::string_view)> &Log) {
  const auto MakeReference = referenceMaker(P, Log);
  std::vector<StudyPoint> All;
  All.reserve(Points.size());
  for (const Point &Of : Points)
    All.push_back({Of.name(), provenanceOf(P, Of),
                   [MakeReference, Of] { return MakeReference(Of); },
                   [&P, Of] { return PointMeasurement(P, Of).measure(); },
                   lineOf});
  return All;
}

PointStore storeOf(const SweepPlan &P,
                   std::function<void(std::string_view)> Log) {
  return {P.Folder, isMeasurement, std::move(Log)};
}

std::vector<std::string> renderWords(const SweepPlan &P,
                                     const std::string &View,
                                     const std::string &Output) {
  std::vector<std::string> Words{"render",     P.ScenePath, "--cameras",
                                 P.CameraFile, "--view",    View,
                                 "-o",         Output};
  Words.insert(Words.end(), P.CommonArguments.begin(), P.CommonArguments.end());
  return Words;
}

Expected<Json> readPoint(const SweepPlan &P, PointStore &Kept,
                         const Point &Of) {
  return Kept.get(Of.name(), provenanceOf(P, Of));
}

Expected<std::vector<Candidate>>
candidates(const SweepPlan &P, PointStore &Kept,
           const std::vector<Setting> &Settings,
           const std::vector<const Camera *> &Views) {
  std::vector<Candidate> All;
  for (const Setting &S : Settings) {
    Candidate C{.Chosen = S};
    for (const Camera *View : Views) {
      const auto M = readPoint(P, Kept, {S, View});
      if (!M)
        return M.error();
      addView(C, *M, View == Views.front());
    }
    if (!P.Energy)
      C.Times[static_cast<std::size_t>(TimeAxis::Energy)].reset();
    All.push_back(std::move(C));
  }
  return All;
}

} // namespace vorion::splat
