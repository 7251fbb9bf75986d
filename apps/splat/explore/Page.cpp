#include "explore/Page.h"

#include "device/ClockedMachine.h"
#include "page/Page.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// What the figures of a kind of work are called.
struct Keys {
  const char *Rate, *Joules;             ///< of a machine
  const char *RateFactor, *EnergyFactor; ///< against the base's
  const char *RateOrder, *EnergyOrder;   ///< of small views beside whole ones
  const char *RateTitle;                 ///< on the terminal
};

const Keys &keysOf(Work W) {
  static constexpr Keys OfFrames{
      "frames_per_second", "chip_joules", "rate_factor",
      "energy_factor",     "rate",        "chip_joules",
      "frames/s"};
  static constexpr Keys OfIterations{"iterations_per_second",
                                     "iteration_joules",
                                     "iteration_rate_factor",
                                     "iteration_energy_factor",
                                     "iteration_rate",
                                     "iteration_joules",
                                     "iter/s"};
  return W == Work::Frames ? OfFrames : OfIterations;
}

void addSpeed(Json &To, Work W, const Speed &Is) {
  To[keysOf(W).Rate] = Is.Rate;
  To[keysOf(W).Joules] = Is.Joules;
}

void addFactors(Json &To, Work W, const Speed &Is, const Speed &Base) {
  To[keysOf(W).RateFactor] = Is.Rate / Base.Rate;
  To[keysOf(W).EnergyFactor] = Is.Joules / Base.Joules;
}

Json figuresOf(const ExplorePlan &P, const Measured &M) {
  if (!M.Refused.empty())
    return {{"refused", M.Refused}};
  Json Is;
  for (const Work W : AllWork)
    if (const auto &Of = M.Is.of(W))
      addSpeed(Is, W, *Of);
  Is["chip_mm2"] = M.Is.Area;
  if (!P.Does.isNamed())
    return Is;
  Json &Parts = Is["parts"] = Json::array();
  for (std::size_t I = 0; I < M.Parts.size(); ++I) {
    const Part &Of = P.Does.Parts[I];
    Json One{{"part", Of.Name}};
    addSpeed(One, Of.Does, M.Parts[I].Is);
    One["time_share"] = M.Parts[I].TimeShare;
    One["energy_share"] = M.Parts[I].EnergyShare;
    Parts.push_back(std::move(One));
  }
  return Is;
}

/// Of what a task waits for most: its stages.
Json tasksOf(const Measured &M) {
  Json All = Json::array();
  for (const Json &Task : M.Tasks) {
    if (Task.contains("refused"))
      continue;
    Json One;
    for (const char *Key : {"part", "view", "iterations", ClockedMachineKey,
                            timeKey(Work::Frames), timeKey(Work::Iterations),
                            "chip_joules", "joules", "picture", "stages"})
      if (Task.contains(Key))
        One[Key] = Task[Key];
    All.push_back(std::move(One));
  }
  return All;
}

/// What each alternative alone does to the base.
Json worthsOf(const ExplorePlan &P, const Findings &F) {
  Json All = Json::array();
  const Measured &Base = F.Whole.front();
  for (const Measured &M : F.Alone) {
    Json One{{"machine", nameOf(P.Parameters, M.Machine)}};
    if (!M.Refused.empty()) {
      One["refused"] = M.Refused;
      All.push_back(std::move(One));
      continue;
    }
    for (const Work W : AllWork)
      if (const auto &Is = M.Is.of(W))
        addFactors(One, W, *Is, *Base.Is.of(W));
    One["area_factor"] = M.Is.Area / Base.Is.Area;
    if (P.Does.isNamed())
      for (std::size_t I = 0; I < M.Parts.size(); ++I) {
        const Part &Of = P.Does.Parts[I];
        Json In{{"part", Of.Name}};
        addFactors(In, Of.Does, M.Parts[I].Is, Base.Parts[I].Is);
        One["parts"].push_back(std::move(In));
      }
    All.push_back(std::move(One));
  }
  return All;
}

Json pairsOf(const Space &S, const Findings &F) {
  Json All = Json::array();
  const auto Value = [&S](std::size_t Parameter, std::size_t Choice) {
    return fmt::format("{}={}", S[Parameter].Name,
                       S[Parameter].Others[Choice - 1].Name);
  };
  for (const Work W : AllWork)
    for (const Interaction &I : F.Pairs[static_cast<std::size_t>(W)])
      All.push_back({{"of", name(W)},
                     {"first", Value(I.First, I.FirstValue)},
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
  std::vector<std::pair<const Figures *, const Figures *>> Both;
  for (const std::size_t I : F.Checked) {
    const Measured &M = F.Whole[I];
    const auto At = Small.find(M.Machine);
    if (At != Small.end() && M.Refused.empty())
      Both.emplace_back(&At->second->Is, &M.Is);
  }
  // Of fewer the figure says nothing.
  if (Both.size() < 10)
    return {};
  Json Agreement{{"machines", Both.size()}};
  const auto Order = [&Both](auto Of) {
    std::vector<double> InSmall, InWhole;
    for (const auto &[OfSmall, OfWhole] : Both) {
      InSmall.push_back(Of(*OfSmall));
      InWhole.push_back(Of(*OfWhole));
    }
    return rankCorrelation(InSmall, InWhole);
  };
  for (const Work W : AllWork)
    if (F.Whole.front().Is.of(W)) {
      Agreement[keysOf(W).RateOrder] =
          Order([W](const Figures &Is) { return Is.of(W)->Rate; });
      Agreement[keysOf(W).EnergyOrder] =
          Order([W](const Figures &Is) { return Is.of(W)->Joules; });
    }
  return Agreement;
}

/// Places in \p Whole of machines that can be and are on the Pareto front by
/// what \p FiguresOf gives of each.
template <typename Function>
std::vector<std::size_t> frontBy(const std::vector<Measured> &Whole,
                                 Function FiguresOf, bool KeepsEqual) {
  std::vector<std::size_t> Places;
  std::vector<Figures> All;
  for (std::size_t I = 0; I < Whole.size(); ++I)
    if (Whole[I].Refused.empty()) {
      Places.push_back(I);
      All.push_back(FiguresOf(Whole[I]));
    }
  std::vector<std::size_t> Front = paretoFront(All, KeepsEqual);
  for (std::size_t &I : Front)
    I = Places[I];
  return Front;
}

std::vector<std::size_t> frontOf(const std::vector<Measured> &Whole) {
  return frontBy(Whole, [](const Measured &M) { return M.Is; }, false);
}

/// The same at the part \p Of alone. Equal ones all are on it: they may differ
/// at other parts.
std::vector<std::size_t> frontAt(const std::vector<Measured> &Whole,
                                 std::size_t Of) {
  return frontBy(
      Whole,
      [Of](const Measured &M) {
        Figures Is;
        // Any kind of work: there is one alone.
        Is.of(Work::Frames) = M.Parts[Of].Is;
        Is.Area = M.Is.Area;
        return Is;
      },
      true);
}

Json namesOf(const ExplorePlan &P, const std::vector<Measured> &Whole,
             const std::vector<std::size_t> &Places) {
  Json Names = Json::array();
  for (const std::size_t I : Places)
    Names.push_back(nameOf(P.Parameters, Whole[I].Machine));
  return Names;
}

/// The parts of a workload, and the front that each would have alone.
Json partsOf(const ExplorePlan &P, const Findings &F) {
  Json All = Json::array();
  for (std::size_t I = 0; I < P.Does.Parts.size(); ++I) {
    const Part &Of = P.Does.Parts[I];
    const auto Tasks = std::ranges::count(P.Does.Whole, I, &Task::Of);
    All.push_back({{"part", Of.Name},
                   {"work", name(Of.Does)},
                   {"weight", Of.Weight},
                   {"tasks", Tasks},
                   {"front", namesOf(P, F.Whole, frontAt(F.Whole, I))}});
  }
  return All;
}

/// How many pictures of the first view machines draw.
std::size_t picturesIn(const std::vector<Measured> &Whole) {
  std::set<std::string> Pictures;
  for (const Measured &M : Whole)
    if (!M.Tasks.empty() && M.Refused.empty() &&
        M.Tasks.front().contains("picture"))
      Pictures.insert(M.Tasks.front()["picture"].get<std::string>());
  return Pictures.size();
}

} // namespace

Json resultsOf(const ExplorePlan &P, const Findings &F) {
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
  for (std::size_t I = 0; I < F.Whole.size(); ++I) {
    Json &One = Entry(F.Whole[I]);
    One["whole"] = figuresOf(P, F.Whole[I]);
    One["views"] = tasksOf(F.Whole[I]);
    One["on_front"] = std::ranges::find(Front, I) != Front.end();
  }
  for (const Measured &M : F.Small)
    Entry(M)["small"] = figuresOf(P, M);
  Json All = Json::array();
  for (const Choices &C : Order)
    All.push_back(std::move(Machines[C]));
  Json Views = Json::array();
  for (const Task &What : P.Does.Whole)
    Views.push_back(What.Name);
  Json Results{{"views", std::move(Views)}};
  if (P.Does.isNamed())
    Results["parts"] = partsOf(P, F);
  Results.update({{"machines", std::move(All)},
                  {"front", namesOf(P, F.Whole, Front)},
                  {"worth", worthsOf(P, F)},
                  {"pairs", pairsOf(P.Parameters, F)},
                  {"small_beside_whole", agreementOf(F)},
                  {"different_pictures", picturesIn(F.Whole)}});
  return Results;
}

std::string explorePageOf(const Json &Results,
                          const std::vector<std::string> &Made) {
  Json Data = Results;
  Data["made"] = Made;
  return filledPage(explorePage(), Data);
}

namespace {

/// What the machines of \p Results do.
std::vector<Work> workIn(const Json &Base) {
  std::vector<Work> All;
  for (const Work W : AllWork)
    if (Base["whole"].contains(keysOf(W).Rate))
      All.push_back(W);
  return All;
}

std::string rowOf(const Json &M, const std::vector<Work> &Does) {
  const Json &Is = M["whole"];
  std::string Row;
  for (const Work W : Does)
    Row += fmt::format("{:>10.1f}{:>10.3g}", Is[keysOf(W).Rate].get<double>(),
                       1e3 * Is[keysOf(W).Joules].get<double>());
  return Row + fmt::format("{:>9.2f}  {}\n", Is["chip_mm2"].get<double>(),
                           M["machine"].get<std::string>());
}

/// What the parts of a workload are of the base, and how many machines of the
/// front that a part has alone are on the workload's.
std::string partsText(const Json &Results, const Json &Base) {
  std::set<std::string> Front;
  for (const Json &Name : Results["front"])
    Front.insert(Name.get<std::string>());
  std::string Text =
      fmt::format("{:>10}{:>10}{:>10}{:>10}{:>10}  {}\n", "% time", "% energy",
                  "weight", "own front", "on both", "part, on base");
  for (std::size_t I = 0; I < Results["parts"].size(); ++I) {
    const Json &Of = Results["parts"][I], &Is = Base["whole"]["parts"][I];
    const auto Both = std::ranges::count_if(Of["front"], [&](const Json &Name) {
      return Front.contains(Name.get<std::string>());
    });
    Text += fmt::format("{:>10.1f}{:>10.1f}{:>10.6g}{:>10}{:>10}  {}, {}\n",
                        1e2 * Is["time_share"].get<double>(),
                        1e2 * Is["energy_share"].get<double>(),
                        Of["weight"].get<double>(), Of["front"].size(), Both,
                        Of["part"].get<std::string>(),
                        Of["work"].get<std::string>());
  }
  return Text;
}

} // namespace

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
  const Json &Base = *Machines["base"];
  const std::vector<Work> Does = workIn(Base);
  std::string Text = fmt::format(
      "{} machines, {} at full size, {} impossible\n"
      "base: {}\n",
      Results["machines"].size(), Whole, Refused,
      printable(Base["views"][0][ClockedMachineKey].get<std::string>()));
  for (const Work W : Does)
    Text += fmt::format("{:>10}{:>10}", keysOf(W).RateTitle, "chip mJ");
  Text += fmt::format("{:>9}  {}\n", "mm2", "machine on the front");
  for (const Json &Name : Results["front"])
    Text += rowOf(*Machines[Name.get<std::string>()], Does);
  if (!Base["on_front"].get<bool>())
    Text += "not on the front:\n" + rowOf(Base, Does);
  if (Results.contains("parts"))
    Text += partsText(Results, Base);
  if (const Json &Both = Results["small_beside_whole"]; !Both.is_null()) {
    Text +=
        fmt::format("rank correlation of small and full-size views, {} random "
                    "machines:",
                    Both["machines"].get<unsigned>());
    for (const Work W : Does)
      Text += fmt::format(
          "{} {:.3f} for {}rate, {:.3f} for {}energy",
          W == Does.front() ? "" : ",", Both[keysOf(W).RateOrder].get<double>(),
          Does.size() > 1 ? (W == Work::Frames ? "frame " : "iteration ") : "",
          Both[keysOf(W).EnergyOrder].get<double>(),
          Does.size() > 1 ? (W == Work::Frames ? "frame " : "iteration ") : "");
    Text += "\n";
  }
  return Text;
}

} // namespace vorion::splat
