#include "render/FrameEnergy.h"

#include "render/FrameTime.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;
using isasim::Energy;
using isasim::EnergyModel;

namespace {

isasim::EnergyWork workOf(const TimeReport &T) {
  isasim::EnergyWork W{T.Cycles, T.ClockMhz, {}};
  for (const Activity &A : T.Activities)
    W.Events.push_back({A.Unit, A.Event, A.Count});
  return W;
}

struct KernelEnergy {
  std::string Name;
  Energy Spent;
};
struct StageEnergy {
  Stage Kind;
  Energy Spent;
  std::vector<KernelEnergy> Kernels;
};
struct FrameEnergy {
  EnergyModel Model;
  Energy Spent;
  isasim::Area Machine;
  std::vector<StageEnergy> Stages;
};

/// The frame's stages, those of the same kind in one, and so their kernels: a
/// sequence has each once a picture.
std::vector<StageReport> byKind(const std::vector<StageReport> &Stages) {
  std::vector<StageReport> Kinds;
  for (const StageReport &S : Stages) {
    if (!isFrameStage(S.Kind))
      continue;
    auto Same = std::ranges::find(Kinds, S.Kind, &StageReport::Kind);
    if (Same == Kinds.end()) {
      Same = Kinds.insert(Kinds.end(), StageReport());
      Same->Kind = S.Kind;
    }
    for (const KernelReport &K : S.Kernels) {
      const auto Known =
          std::ranges::find(Same->Kernels, K.Name, &KernelReport::Name);
      if (Known == Same->Kernels.end())
        Same->Kernels.push_back(K);
      else
        add(Known->Time, K.Time);
    }
  }
  return Kinds;
}

/// Of one stage; nothing to add where its kernels have no time.
Expected<Success> addStage(FrameEnergy &To, const StageReport &S) {
  const auto Time = stageTime(S);
  if (!Time)
    return Success{};
  auto Spent = To.Model.energyOf(workOf(*Time));
  if (!Spent)
    return Spent.error();
  StageEnergy Stage{S.Kind, std::move(*Spent), {}};
  for (const KernelReport &K : S.Kernels) {
    auto OfKernel = To.Model.energyOf(workOf(*K.Time));
    if (!OfKernel)
      return OfKernel.error();
    Stage.Kernels.push_back({K.Name, std::move(*OfKernel)});
  }
  To.Stages.push_back(std::move(Stage));
  return Success{};
}

/// Nothing without the clock.
Expected<std::optional<FrameEnergy>>
energyOf(const std::vector<StageReport> &Stages, const EnergyRequest &R,
         const isasim::Samples &By = isasim::Samples::prior()) {
  const auto Whole = frameTime(Stages);
  if (!Whole)
    return std::optional<FrameEnergy>();
  const auto Model = EnergyModel::create(R.From, Whole->ClockMhz, R.Volts, By);
  if (!Model)
    return Model.error();
  const isasim::EnergyWork Work = workOf(*Whole);
  auto Spent = Model->energyOf(Work);
  if (!Spent)
    return Spent.error();
  FrameEnergy F{*Model, std::move(*Spent), Model->areaOf(Work), {}};
  for (const StageReport &S : byKind(Stages))
    if (const auto Added = addStage(F, S); !Added)
      return Added.error();
  return std::optional(std::move(F));
}

/// What a frame is estimated by besides the technology.
struct Condition {
  const char *Key, *Name;
  isasim::Samples isasim::ChipSamples::*By;
};
constexpr Condition Conditions[] = {
    {"area", "area", &isasim::ChipSamples::Area},
    {"power", "power", &isasim::ChipSamples::Power},
    {"area_and_power", "area and power", &isasim::ChipSamples::Both}};

/// A row of a table or of a report.
Json shortJson(std::string_view Name, const Energy &E) {
  return {{"name", Name},
          {"joules", isasim::toJson(E.Total)},
          {"chip_joules", isasim::toJson(E.Chip)},
          {"chip_watts", isasim::toJson(E.ChipWatts)}};
}

std::string row(std::string_view Name, const Energy &E) {
  constexpr double Milli = 1e3;
  return fmt::format("{:<20}{:>12.4g}{:>12.4g} |{:>10.3g}{:>10.3g}{:>10.3g}\n",
                     Name, Milli * E.Total.Value, Milli * E.Chip.Value,
                     E.ChipWatts.Value, E.ChipWatts.Low, E.ChipWatts.High);
}

Json frameJson(const FrameEnergy &F) {
  Json J = isasim::toJson(F.Spent, F.Model.technology());
  J["area"] = isasim::toJson(F.Machine);
  Json Rows = Json::array();
  for (const StageEnergy &S : F.Stages) {
    Json Row = shortJson(name(S.Kind), S.Spent);
    Row["kernels"] = Json::array();
    for (const KernelEnergy &K : S.Kernels)
      Row["kernels"].push_back(shortJson(K.Name, K.Spent));
    Rows.push_back(std::move(Row));
  }
  J["stages"] = std::move(Rows);
  return J;
}

std::string givenRow(std::string_view Name, const FrameEnergy &F) {
  constexpr double Mm2 = 1e-6;
  const isasim::Estimate &W = F.Spent.ChipWatts, &A = F.Machine.Chip;
  return fmt::format(
      "{:<20}{:>10.3g}{:>10.3g}{:>10.3g} |{:>10.3g}{:>10.3g}{:>10.3g}{:>12}\n",
      Name, W.Value, W.Low, W.High, Mm2 * A.Value, Mm2 * A.Low, Mm2 * A.High,
      F.Model.samples().Tried);
}

/// What \p Prior becomes given the chip, and which rows give way.
Expected<std::string> givenChipText(const std::vector<StageReport> &Stages,
                                    const EnergyRequest &R,
                                    const FrameEnergy &Prior) {
  std::string Text =
      fmt::format("\n{:<20}{:>10}{:>10}{:>10} |{:>10}{:>10}{:>10}{:>12}\n",
                  "given the chip's", "chip W", "5 %", "95 %", "mm2", "5 %",
                  "95 %", "tried");
  Text += givenRow("nothing", Prior);
  std::string Moved;
  for (const Condition &C : Conditions) {
    const auto F = energyOf(Stages, R, (*R.Chip).*C.By);
    if (!F)
      return F.error();
    Text += givenRow(C.Name, **F);
    if (C.By == &isasim::ChipSamples::Both)
      Moved = isasim::movedRowsText((*F)->Model.rowFactors(), 8);
  }
  return Text +
         fmt::format("{:<7}{:<20}{:>10}{:>10}{:>10}\n", "\nrows", "", "times",
                     "5 %", "95 %") +
         Moved;
}

} // namespace

Expected<Success> checkEnergy(const TimeReport &T,
                              const EnergyRequest &Request) {
  const auto Model =
      EnergyModel::create(Request.From, T.ClockMhz, Request.Volts);
  if (!Model)
    return Model.error();
  if (const auto Spent = Model->energyOf(workOf(T)); !Spent)
    return Spent.error();
  return Success{};
}

Expected<Json> frameEnergyJson(const std::vector<StageReport> &Stages,
                               const EnergyRequest &Request) {
  const auto F = energyOf(Stages, Request);
  if (!F)
    return F.error();
  if (!*F)
    return Json();
  Json J = frameJson(**F);
  if (Request.Chip)
    for (const Condition &C : Conditions) {
      const auto Given = energyOf(Stages, Request, (*Request.Chip).*C.By);
      if (!Given)
        return Given.error();
      Json &Of = J["given_chip"][C.Key] = frameJson(**Given);
      const isasim::EnergyModel &Model = (*Given)->Model;
      Of["samples"] = {{"kept", Model.samples().Numbers.size()},
                       {"tried", Model.samples().Tried}};
      Of["rows"] = isasim::toJson(Model.rowFactors());
    }
  return J;
}

Expected<std::string> frameEnergyText(const std::vector<StageReport> &Stages,
                                      const EnergyRequest &Request,
                                      const std::string &What) {
  const auto F = energyOf(Stages, Request);
  if (!F)
    return F.error();
  if (!*F)
    return std::string();
  std::string Text =
      fmt::format("\n{:<20}{:>12}{:>12} |{:>10}{:>10}{:>10}\n", "energy", "mJ",
                  "chip mJ", "chip W", "5 %", "95 %");
  for (const StageEnergy &S : (*F)->Stages)
    Text += row(name(S.Kind), S.Spent);
  Text +=
      row(What, (*F)->Spent) + "\n" + isasim::toText((*F)->Spent, Request.From);
  if (!Request.Chip)
    return Text;
  const auto Given = givenChipText(Stages, Request, **F);
  if (!Given)
    return Given.error();
  return Text + *Given;
}

} // namespace vorion::splat
