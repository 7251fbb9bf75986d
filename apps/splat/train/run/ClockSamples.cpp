#include "train/run/ClockSamples.h"

#include "train/data/Philox.h"

#include "device/ClockedMachine.h"
#include "io/Mean.h"
#include "render/FrameTime.h"
#include "render/Report.h"
#include "render/WhatIf.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Of a sample; 0 for one value.
double deviationOf(const std::vector<double> &Values) {
  const double Mean = meanOf(Values);
  double Squares = 0;
  for (const double V : Values)
    Squares += (V - Mean) * (V - Mean);
  return Values.size() < 2
             ? 0
             : std::sqrt(Squares / static_cast<double>(Values.size() - 1));
}

} // namespace

bool isTimed(uint64_t Seed, unsigned Every, unsigned Iteration) {
  const unsigned Block = (Iteration - 1) / Every;
  const philox_words W =
      philox(static_cast<uint>(Seed), static_cast<uint>(Seed >> 32), Block,
             Every, 0, STREAM_CLOCK);
  return (Iteration - 1) % Every ==
         static_cast<unsigned>(ulong{W.word[0]} * Every >> 32);
}

bool ClockSamples::add(TimedIteration T) {
  const auto Time = frameMilliseconds(T.Stages);
  if (!Time)
    return false;
  Milliseconds.push_back(Time->all());
  All.push_back(std::move(T));
  return true;
}

std::vector<std::pair<unsigned, double>> ClockSamples::milliseconds() const {
  std::vector<std::pair<unsigned, double>> Times;
  for (std::size_t I = 0; I != All.size(); ++I)
    Times.emplace_back(All[I].Number, Milliseconds[I]);
  return Times;
}

double ClockSamples::rate() const { return 1e3 / meanOf(Milliseconds); }

std::string ClockSamples::text() const {
  const auto [Least, Most] = std::ranges::minmax(Milliseconds);
  return fmt::format("{:.3f} it/s; {:.3f} ms per iteration, standard deviation "
                     "{:.3f}, range {:.3f} to {:.3f}, {} timed",
                     rate(), meanOf(Milliseconds), deviationOf(Milliseconds),
                     Least, Most, Milliseconds.size());
}

std::string ClockSamples::machine() const {
  return clockedMachine(*frameTime(All.back().Stages));
}

std::string ClockSamples::lastByStage() const {
  const std::vector<StageReport> &Stages = All.back().Stages;
  return boundsText(frameJson(Stages), {}, "") + frameText(Stages, "iteration");
}

Expected<Json>
ClockSamples::json(const std::optional<EnergyRequest> &Energy) const {
  Json J = Json::array();
  for (const TimedIteration &T : All) {
    J.push_back({{"iteration", T.Number},
                 {"gaussians", T.Gaussians},
                 {"list_lengths", T.ListLengths},
                 {"stages", stagesJson(T.Stages)},
                 {"time", frameJson(T.Stages)}});
    if (!Energy)
      continue;
    auto Spent = frameEnergyJson(T.Stages, *Energy);
    if (!Spent)
      return Spent.error();
    J.back()["energy"] = std::move(*Spent);
  }
  return J;
}

} // namespace vorion::splat
