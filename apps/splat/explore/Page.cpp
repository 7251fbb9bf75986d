#include "explore/Page.h"

#include "page/Page.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

Json figuresOf(const Measured &M) {
  if (!M.Refused.empty())
    return {{"refused", M.Refused}};
  return {{"frames_per_second", M.Is.Rate},
          {"chip_joules", M.Is.Joules},
          {"chip_mm2", M.Is.Area}};
}

/// Of what a frame waits for most: by view, its stages.
Json viewsOf(const Measured &M) {
  Json All = Json::array();
  for (const Json &View : M.Views)
    if (!View.contains("refused"))
      All.push_back({{"view", View["view"]},
                     {"frame_ms", View["frame_ms"]},
                     {"chip_joules", View["chip_joules"]},
                     {"joules", View["joules"]},
                     {"picture", View["picture"]},
                     {"stages", View["stages"]}});
  return All;
}

/// What each alternative alone does to the base.
Json worthsOf(const StudyPlan &P, const Findings &F) {
  Json All = Json::array();
  const Figures &Base = F.Whole.front().Is;
  for (const Measured &M : F.Alone) {
    Json One{{"machine", nameOf(P.Parameters, M.Machine)}};
    if (M.Refused.empty())
      One.update({{"rate_factor", M.Is.Rate / Base.Rate},
                  {"energy_factor", M.Is.Joules / Base.Joules},
                  {"area_factor", M.Is.Area / Base.Area}});
    else
      One["refused"] = M.Refused;
    All.push_back(std::move(One));
  }
  return All;
}

Json pairsOf(const Space &S, const std::vector<Interaction> &Pairs) {
  Json All = Json::array();
  const auto Value = [&S](std::size_t Parameter, std::size_t Choice) {
    return fmt::format("{}={}", S[Parameter].Name,
                       S[Parameter].Others[Choice - 1].Name);
  };
  for (const Interaction &I : Pairs)
    All.push_back({{"first", Value(I.First, I.FirstValue)},
                   {"second", Value(I.Second, I.SecondValue)},
                   {"rate_factor", I.Factor},
                   {"log_error", I.Error}});
  return All;
}

/// How well small views order machines as whole ones do.
Json agreementOf(const Findings &F) {
  std::map<Choices, const Measured *> Small;
  for (const Measured &M : F.Small)
    if (M.Refused.empty())
      Small[M.Machine] = &M;
  std::vector<double> SmallRates, WholeRates, SmallJoules, WholeJoules;
  for (const std::size_t I : F.Checked) {
    const Measured &M = F.Whole[I];
    const auto At = Small.find(M.Machine);
    if (At == Small.end() || !M.Refused.empty())
      continue;
    SmallRates.push_back(At->second->Is.Rate);
    WholeRates.push_back(M.Is.Rate);
    SmallJoules.push_back(At->second->Is.Joules);
    WholeJoules.push_back(M.Is.Joules);
  }
  // Of fewer the figure says nothing.
  if (SmallRates.size() < 10)
    return {};
  return {{"machines", SmallRates.size()},
          {"rate", rankCorrelation(SmallRates, WholeRates)},
          {"chip_joules", rankCorrelation(SmallJoules, WholeJoules)}};
}

/// Places in \p Whole of machines that can be and are on the Pareto front.
std::vector<std::size_t> frontOf(const std::vector<Measured> &Whole) {
  std::vector<std::size_t> Places;
  std::vector<Figures> All;
  for (std::size_t I = 0; I < Whole.size(); ++I)
    if (Whole[I].Refused.empty()) {
      Places.push_back(I);
      All.push_back(Whole[I].Is);
    }
  std::vector<std::size_t> Front = paretoFront(All);
  for (std::size_t &I : Front)
    I = Places[I];
  return Front;
}

} // namespace

Json resultsOf(const StudyPlan &P, const Findings &F) {
  const std::vector<std::size_t> Front = frontOf(F.Whole);
  std::map<Choices, Json> Machines;
  std::vector<Choices> Order;
  const auto Entry = [&](const Measured &M) -> Json & {
    const auto [At, IsNew] = Machines.try_emplace(M.Machine);
    if (IsNew) {
      Order.push_back(M.Machine);
      At->second = {{"machine", nameOf(P.Parameters, M.Machine)},
                    {"settings", settingsOf(P.Parameters, M.Machine)},
                    {"arguments", argumentsOf(P.Parameters, M.Machine)},
                    {"on_front", false}};
    }
    return At->second;
  };
  std::set<std::string> Pictures;
  for (std::size_t I = 0; I < F.Whole.size(); ++I) {
    Json &One = Entry(F.Whole[I]);
    One["whole"] = figuresOf(F.Whole[I]);
    One["views"] = viewsOf(F.Whole[I]);
    One["on_front"] = std::ranges::find(Front, I) != Front.end();
    if (!F.Whole[I].Views.empty() && F.Whole[I].Refused.empty())
      Pictures.insert(F.Whole[I].Views.front()["picture"].get<std::string>());
  }
  for (const Measured &M : F.Small)
    Entry(M)["small"] = figuresOf(M);
  Json All = Json::array();
  for (const Choices &C : Order)
    All.push_back(std::move(Machines[C]));
  Json Views = Json::array(), FrontNames = Json::array();
  for (const Camera &View : P.Whole.Views)
    Views.push_back(View.Name);
  for (const std::size_t I : Front)
    FrontNames.push_back(nameOf(P.Parameters, F.Whole[I].Machine));
  return {{"views", std::move(Views)},
          {"machines", std::move(All)},
          {"front", std::move(FrontNames)},
          {"worth", worthsOf(P, F)},
          {"pairs", pairsOf(P.Parameters, F.Pairs)},
          {"small_beside_whole", agreementOf(F)},
          {"different_pictures", Pictures.size()}};
}

std::string explorePageOf(const Json &Results,
                          const std::vector<std::string> &Made) {
  Json Data = Results;
  Data["made"] = Made;
  return filledPage(explorePage(), Data);
}

std::string textOf(const Json &Results) {
  std::map<std::string, const Json *> Machines;
  std::size_t Whole = 0, Refused = 0;
  for (const Json &M : Results["machines"]) {
    Machines[M["machine"].get<std::string>()] = &M;
    const bool IsWhole = M.contains("whole");
    const bool IsRefused = M[IsWhole ? "whole" : "small"].contains("refused");
    Whole += IsWhole && !IsRefused ? 1 : 0;
    Refused += IsRefused ? 1 : 0;
  }
  std::string Text =
      fmt::format("{} machines, {} of them on whole views, {} cannot be\n"
                  "{:>10}{:>10}{:>9}  {}\n",
                  Results["machines"].size(), Whole, Refused, "frames/s",
                  "chip mJ", "mm2", "machine on the front");
  const auto Row = [](const Json &M) {
    const Json &Is = M["whole"];
    return fmt::format("{:>10.1f}{:>10.3g}{:>9.2f}  {}\n",
                       Is["frames_per_second"].get<double>(),
                       1e3 * Is["chip_joules"].get<double>(),
                       Is["chip_mm2"].get<double>(),
                       M["machine"].get<std::string>());
  };
  for (const Json &Name : Results["front"])
    Text += Row(*Machines[Name.get<std::string>()]);
  const Json &Base = *Machines["base"];
  if (!Base["on_front"].get<bool>())
    Text += "not on the front:\n" + Row(Base);
  if (const Json &Both = Results["small_beside_whole"]; !Both.is_null())
    Text += fmt::format(
        "rank correlation of small and whole views, {} machines "
        "drawn at random: {:.3f} by rate, {:.3f} by energy\n",
        Both["machines"].get<unsigned>(), Both["rate"].get<double>(),
        Both["chip_joules"].get<double>());
  return Text;
}

} // namespace vorion::splat
