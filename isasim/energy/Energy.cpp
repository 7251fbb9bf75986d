#include "vorion/isasim/Energy.h"
#include "energy/Costs.h"
#include "energy/Stable.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

constexpr std::string_view LeakageRow = "leakage of a mm2";
/// Channels times cycles, by standard.
constexpr std::string_view DramTime = "dram channels";
constexpr double Picojoule = 1e-12, Milliwatt = 1e-3;
constexpr double Mm2PerUm2 = 1e-6;

size_t rowOf(const std::vector<TechnologyRow> &Rows, std::string_view Name) {
  const auto Found = std::ranges::find(Rows, Name, &TechnologyRow::Name);
  assert(Found != Rows.end() && "parseTechnology() asks for all");
  return static_cast<size_t>(Found - Rows.begin());
}

/// What 5 and 95 % of the draws stay below.
Estimate estimate(double Value, std::vector<double> Draws) {
  std::ranges::sort(Draws);
  const size_t Outside = Draws.size() / 20;
  return {Value, Draws[Outside], Draws[Draws.size() - 1 - Outside]};
}

/// What a row and, if \p Shared names it, a factor of many rows are multiplied
/// by.
std::vector<double> factors(const std::string &Name, double Sigma,
                            std::string_view Shared = {},
                            double SharedSigma = 0) {
  std::vector<double> F(EnergyModel::Draws);
  for (size_t N = 0; N != F.size(); ++N)
    F[N] = stable::exp(Sigma * stable::normal(Name, N) +
                       SharedSigma * stable::normal(Shared, N));
  return F;
}

/// A sum with its draws.
struct Drawn {
  double Value = 0;
  std::vector<double> Draws = std::vector<double>(EnergyModel::Draws);

  void add(double Amount, const std::vector<double> &Factors) {
    Value += Amount;
    for (size_t N = 0; N != Draws.size(); ++N)
      Draws[N] += Amount * Factors[N];
  }
  void add(const Drawn &Other) {
    Value += Other.Value;
    for (size_t N = 0; N != Draws.size(); ++N)
      Draws[N] += Other.Draws[N];
  }
  Estimate estimated() const { return estimate(Value, Draws); }
};

Estimate scaled(const Estimate &E, double By) {
  return {E.Value * By, E.Low * By, E.High * By};
}

bool hasLink(const EnergyWork &Work) {
  return std::ranges::any_of(Work.Events, [](const EventCount &E) {
    return E.Unit == "time" && E.Event == "links" && E.Count != 0;
  });
}

/// What a channel draws; Micron, TN-41-01, "Calculating memory system power
/// for DDR3", for each supply. In pJ, and in mW for \c Standing: the
/// controller leaves rows open.
struct DramCosts {
  double Activation = 0, Read = 0, Write = 0, Refresh = 0, Standing = 0;
};
DramCosts costsOf(const DramCurrents &D) {
  DramCosts C;
  for (const DramRail &R : D.Rails) {
    // mA times V times ns are pJ.
    const double Power = D.Devices * R.Volts;
    // Below 0 by rounding alone: no technology has less (Technology.cpp).
    C.Activation += Power * std::max(0.0, R.Idd0 * D.RcNs - R.Idd3n * D.RasNs -
                                              R.Idd2n * (D.RcNs - D.RasNs));
    C.Read += Power * (R.Idd4r - R.Idd3n) * D.BurstNs;
    C.Write += Power * (R.Idd4w - R.Idd3n) * D.BurstNs;
    C.Refresh += Power * (R.Idd5 - R.Idd3n) * D.RfcNs;
    C.Standing += Power * R.Idd3n;
  }
  return C;
}

} // namespace

bool knowsEvent(const EventCount &E) {
  const auto Is = [&E](const auto &C) {
    return C.Unit == E.Unit && C.Event == E.Event;
  };
  return E.Unit == "dram" || E.Unit == DramTime ||
         std::ranges::any_of(eventCosts(), Is) ||
         std::ranges::any_of(freeEvents(), Is);
}

Estimate ratioOf(const std::vector<double> &Of, double OfValue,
                 const std::vector<double> &By, double ByValue) {
  std::vector<double> Draws(Of.size());
  for (size_t N = 0; N != Draws.size(); ++N)
    Draws[N] = By[N] > 0 ? Of[N] / By[N] : 0;
  return estimate(ByValue > 0 ? OfValue / ByValue : 0, std::move(Draws));
}

EnergyModel::EnergyModel(Technology FromIn, double VoltsIn)
    : From(std::move(FromIn)), Volts(VoltsIn) {
  for (const TechnologyRow &R : From.Energies)
    EnergyFactors.push_back(
        factors(R.Name, R.Sigma, "all energies", From.Sigma));
  for (const TechnologyRow &R : From.Areas)
    AreaFactors.push_back(
        factors("area " + R.Name, R.Sigma, "all areas", From.Sigma));
}

/// By which factor a voltage may be beyond the technology's law: what the rows
/// say of energies and leakage means less and less there.
static constexpr double BeyondLaw = 1.2;

Expected<EnergyModel> EnergyModel::create(Technology From, unsigned ClockMhz,
                                          std::optional<double> Volts) {
  if (!Volts) {
    Volts = voltsFor(From, ClockMhz);
    if (!Volts)
      return Error{
          "",
          fmt::format(
              "a clock of {} MHz exceeds the frequency law of technology {}, "
              "which ends at {:g} MHz, expected --voltage",
              ClockMhz, From.Name, From.HighMhz),
          ExitCode::Usage};
  }
  const double Low = From.LowVolts / BeyondLaw,
               High = From.HighVolts * BeyondLaw;
  if (!(*Volts >= Low && *Volts <= High))
    return Error{
        "",
        fmt::format(
            "--voltage: {:g}, expected a number from {:.3g} to {:.3g}, because "
            "the frequency law of technology {} covers {:g} to {:g} V",
            *Volts, Low, High, From.Name, From.LowVolts, From.HighVolts),
        ExitCode::Usage};
  return EnergyModel(std::move(From), *Volts);
}

Area EnergyModel::areaOf(const EnergyWork &Work) const {
  std::vector<std::pair<std::string_view, Drawn>> Parts;
  Drawn Chip;
  const bool HasLink = hasLink(Work);
  const double Cycles = static_cast<double>(std::max<uint64_t>(Work.Cycles, 1));
  for (const AreaCost &C : areaCosts()) {
    double Number = 0;
    for (const EventCount &E : Work.Events)
      if (E.Unit == "time" && E.Event == C.Event)
        Number += static_cast<double>(E.Count) / Cycles;
    if (Number == 0)
      continue;
    auto Part = std::ranges::find(Parts, C.Part,
                                  &std::pair<std::string_view, Drawn>::first);
    if (Part == Parts.end())
      Part = Parts.insert(Parts.end(), {C.Part, Drawn()});
    const size_t Row = rowOf(From.Areas, C.Row);
    const double Um2 = Number * C.Count * From.Areas[Row].Value;
    Part->second.add(Um2, AreaFactors[Row]);
    if (isOnChip(C.LeaksAs, HasLink))
      Chip.add(Um2, AreaFactors[Row]);
  }
  Area A;
  for (const auto &[Name, Um2] : Parts)
    A.Parts.push_back({Name, Um2.estimated()});
  A.Chip = Chip.estimated();
  return A;
}

Expected<Energy> EnergyModel::energyOf(const EnergyWork &Work) const {
  std::array<Drawn, size_t(EnergyUnit::Count)> Units;
  const double Seconds =
      static_cast<double>(Work.Cycles) / (1e6 * Work.ClockMhz);
  const double Square = (Volts / From.Volts) * (Volts / From.Volts);

  for (const EventCount &E : Work.Events) {
    if (E.Count == 0)
      continue;
    for (const EventCost &C : eventCosts())
      if (C.Unit == E.Unit && C.Event == E.Event) {
        const size_t Row = rowOf(From.Energies, C.Row);
        // Pads have a supply of their own.
        const double ByVolts = C.Row == "pad byte" ? 1 : Square;
        Units[size_t(C.Of)].add(static_cast<double>(E.Count) * C.Count *
                                    From.Energies[Row].Value * ByVolts *
                                    Picojoule,
                                EnergyFactors[Row]);
      }
  }

  // Leakage: a power of each area for as long as the run takes.
  const size_t Leaks = rowOf(From.Energies, LeakageRow);
  const double Growth = Volts / From.Volts *
                        stable::exp((Volts - From.Volts) / From.LeakageVolts);
  for (const AreaCost &C : areaCosts())
    for (const EventCount &E : Work.Events)
      if (E.Unit == "time" && E.Event == C.Event && E.Count != 0) {
        const size_t Row = rowOf(From.Areas, C.Row);
        std::vector<double> Factors = EnergyFactors[Leaks];
        for (size_t N = 0; N != Factors.size(); ++N)
          Factors[N] *= AreaFactors[Row][N];
        Units[size_t(C.LeaksAs)].add(
            static_cast<double>(E.Count) / (1e6 * Work.ClockMhz) * C.Count *
                From.Areas[Row].Value * Mm2PerUm2 * From.Energies[Leaks].Value *
                Growth * Milliwatt,
            Factors);
      }

  for (const EventCount &Time : Work.Events) {
    if (Time.Unit != DramTime || Time.Count == 0)
      continue;
    const auto Found =
        std::ranges::find(From.Dram, Time.Event, &DramCurrents::Standard);
    if (Found == From.Dram.end())
      return Error{
          "",
          fmt::format("technology {} has no currents for the machine's DRAM, "
                      "'{}', expected a --technology with them",
                      From.Name, Time.Event),
          ExitCode::Usage};
    const DramCosts C = costsOf(*Found);
    const std::vector<double> Factors =
        factors("dram " + Found->Standard, Found->Sigma);
    Drawn &Dram = Units[size_t(EnergyUnit::Dram)];
    Dram.add(static_cast<double>(Time.Count) / (1e6 * Work.ClockMhz) *
                 C.Standing * Milliwatt,
             Factors);
    for (const auto &[Event, Cost] :
         {std::pair<std::string_view, double>{"read bursts", C.Read},
          {"write bursts", C.Write},
          {"activations", C.Activation},
          {"refreshes", C.Refresh}})
      for (const EventCount &E : Work.Events)
        if (E.Unit == "dram" && E.Event == Event)
          Dram.add(static_cast<double>(E.Count) * Cost * Picojoule, Factors);
  }

  Energy Sum;
  Drawn Total, Chip;
  const bool HasLink = hasLink(Work);
  for (size_t N = 0; N != Units.size(); ++N) {
    Total.add(Units[N]);
    if (isOnChip(static_cast<EnergyUnit>(N), HasLink))
      Chip.add(Units[N]);
  }
  for (size_t N = 0; N != Units.size(); ++N) {
    const auto Which = static_cast<EnergyUnit>(N);
    if (Units[N].Value > 0)
      Sum.Units.push_back(
          {name(Which), isOnChip(Which, HasLink), Units[N].estimated(),
           ratioOf(Units[N].Draws, Units[N].Value, Total.Draws, Total.Value)});
  }
  Sum.Volts = Volts;
  Sum.Seconds = Seconds;
  Sum.ClockMhz = Work.ClockMhz;
  Sum.Total = Total.estimated();
  Sum.Chip = Chip.estimated();
  const double PerSecond = Seconds > 0 ? 1 / Seconds : 0;
  Sum.Watts = scaled(Sum.Total, PerSecond);
  Sum.ChipWatts = scaled(Sum.Chip, PerSecond);
  Sum.TotalDraws = std::move(Total.Draws);
  Sum.ChipDraws = std::move(Chip.Draws);
  return Sum;
}

} // namespace vorion::isasim
