#include "accuracy/Page.h"

#include "device/ClockedMachine.h"
#include "io/ReportHead.h"
#include "page/Page.h"
#include "study/Provenance.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: null stands for equal pictures' PSNR.
static Json numberOrNull(double Value) {
  return std::isfinite(Value) ? Json(Value) : Json();
}

static Json json(const Errors &Worst) {
  Json J;
  for (std::size_t K = 0; K < ErrorKinds; ++K)
    J[std::string(ErrorNames[K])] = numberOrNull(Worst[K]);
  return J;
}

static Json json(const Candidate &C) {
  Json Times;
  for (std::size_t A = 0; A < TimeAxes; ++A)
    Times[std::string(TimeAxisNames[A])] =
        C.Times[A] ? Json(*C.Times[A]) : Json();
  return {{"setting", C.Chosen.name()},
          {"errors", json(C.Worst)},
          {"cores_errors", C.CoresWorst ? json(*C.CoresWorst) : Json()},
          {"times", Times},
          {"area", C.LaneArea},
          {"has_cost", C.Chosen.hasCost()}};
}

/// What the settings come to over some views: the worst errors and the sums of
/// times, and by places in these, for every choice that the page offers, the
/// front, the recommended one, and those that cost no time.
static Json summaryOf(const std::vector<Candidate> &All) {
  Json Settings = Json::array(), Fronts, Recommended;
  for (const Candidate &C : All)
    Settings.push_back(json(C));
  for (std::size_t N = 0; N < TimeAxes; ++N) {
    const auto Axis = static_cast<TimeAxis>(N);
    const std::string Name(TimeAxisNames[N]);
    for (std::size_t K = 0; K < ErrorKinds; ++K)
      Fronts[std::string(ErrorNames[K])][Name] =
          paretoFront(judged(All, static_cast<ErrorKind>(K), Axis));
    Recommended[Name] = Json::array();
    for (const FloorStep &S :
         recommendations(judged(All, ErrorKind::Psnr, Axis)))
      Recommended[Name].push_back(
          {{"most_db", numberOrNull(S.Most)}, {"best", S.Best}});
  }
  return {{"settings", std::move(Settings)},
          {"fronts", std::move(Fronts)},
          {"recommended", std::move(Recommended)},
          {"free", sameTimeAs(All.front(), All, TimeAxis::Cycles)}};
}

Expected<std::string> pageOf(const SweepPlan &P, PointStore &Kept,
                             const PageHead &Head,
                             const std::vector<Setting> &Settings) {
  Json Views = Json::array(), Points = Json::array(), On;
  for (const Camera &View : P.Views)
    Views.push_back(View.Name);
  for (const Point &Of : pointsOf(P, Settings)) {
    const auto Measured = readPoint(P, Kept, Of);
    if (!Measured)
      return Measured.error();
    // No setting changes the machine.
    On = (*Measured)[ClockedMachineKey];
    Json Pictures;
    for (const char *Key : {"setting", "view", "picture", "difference"})
      Pictures[Key] = (*Measured)[Key];
    Points.push_back(std::move(Pictures));
  }
  const auto Summary =
      [&](const std::vector<const Camera *> &Of) -> Expected<Json> {
    const auto All = candidates(P, Kept, Settings, Of);
    if (!All)
      return All.error();
    return summaryOf(*All);
  };
  std::vector<const Camera *> All;
  All.reserve(P.Views.size());
  for (const Camera &View : P.Views)
    All.push_back(&View);
  std::vector<std::vector<const Camera *>> Choices{All};
  for (const Camera *View : All)
    Choices.push_back({View});
  Json Summaries = Json::array();
  for (const auto &Of : Choices) {
    auto One = Summary(Of);
    if (!One)
      return One.error();
    Summaries.push_back(std::move(*One));
  }
  auto Chosen = Summary(Head.ChosenOn);
  if (!Chosen)
    return Chosen.error();
  Json ChosenOn = Json::array();
  for (const Camera *View : Head.ChosenOn)
    ChosenOn.push_back(View->Name);
  const Json Data{
      {"verdict", Head.Verdict},
      {"host", hostTimeJson(Head.Host)},
      {"made", Json::array({Head.Made, madeBy(), hashLine(P.From)})},
      {ClockedMachineKey, std::move(On)},
      {"floor_db", Head.FloorDb},
      {"views", std::move(Views)},
      {"chosen_on", std::move(ChosenOn)},
      {"summaries", std::move(Summaries)},
      {"chosen", std::move(*Chosen)},
      {"points", std::move(Points)}};
  return filledPage(pageTemplate(), Data);
}

std::string trainPageOf(const Json &Results,
                        const std::vector<std::string> &Made) {
  Json Curves = Json::array();
  for (const Json &Point : Results["points"])
    if (Point.contains("curve"))
      Curves.push_back({{"setting", Point["setting"]},
                        {"seed", Point["seed"]},
                        {"curve", Point["curve"]}});
  return filledPage(trainPageTemplate(),
                    {{"made", Made},
                     {ClockedMachineKey, Results[ClockedMachineKey]},
                     {"iterations", Results["iterations"]},
                     {"reached_db", Results["reached_db"]},
                     {"settings", Results["settings"]},
                     {"curves", std::move(Curves)}});
}

} // namespace vorion::splat
