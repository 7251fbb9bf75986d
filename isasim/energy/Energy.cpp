#include "vorion/isasim/Energy.h"
#include "energy/Costs.h"
#include "energy/Stable.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <numeric>

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

using Numbers = std::vector<uint64_t>;

/// What a row and, if \p Shared names it, a factor of many rows are multiplied
/// by in some samples.
std::vector<double> factors(const Numbers &Of, const std::string &Name,
                            double Sigma, std::string_view Shared = {},
                            double SharedSigma = 0) {
  std::vector<double> F(Of.size());
  for (size_t N = 0; N != F.size(); ++N)
    F[N] = stable::exp(Sigma * stable::normal(Name, Of[N]) +
                       SharedSigma * stable::normal(Shared, Of[N]));
  return F;
}

using RowFactors = std::vector<std::vector<double>>;

RowFactors energyFactors(const Technology &T, const Numbers &Of) {
  RowFactors All;
  for (const TechnologyRow &R : T.Energies)
    All.push_back(factors(Of, R.Name, R.Sigma, "all energies", T.Sigma));
  return All;
}
RowFactors areaFactors(const Technology &T, const Numbers &Of) {
  RowFactors All;
  for (const TechnologyRow &R : T.Areas)
    All.push_back(factors(Of, "area " + R.Name, R.Sigma, "all areas", T.Sigma));
  return All;
}

/// Of the factors of each row; 1 where nothing moved them.
std::vector<double> medians(const RowFactors &Rows, const Samples &By) {
  std::vector<double> Of(Rows.size(), 1);
  if (!By.isPrior())
    for (size_t N = 0; N != Of.size(); ++N) {
      std::vector<double> Sorted = Rows[N];
      std::ranges::sort(Sorted);
      Of[N] = Sorted[Sorted.size() / 2];
    }
  return Of;
}

/// A sum with its draws.
struct Drawn {
  double Value = 0;
  std::vector<double> Draws;

  explicit Drawn(size_t Count) : Draws(Count) {}
  void add(double Amount, const std::vector<double> &Factors,
           double Median = 1) {
    Value += Amount * Median;
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

Samples Samples::prior() {
  Samples All;
  All.Numbers.resize(Count);
  std::iota(All.Numbers.begin(), All.Numbers.end(), uint64_t(0));
  return All;
}

EnergyWork PublishedChip::work() const {
  EnergyWork Work{Cycles, ClockMhz, {}};
  for (const Event &E : Events)
    Work.Events.push_back({E.Unit, E.Name, E.Count});
  return Work;
}

EnergyModel::EnergyModel(Technology FromIn, double VoltsIn, Samples ByIn)
    : From(std::move(FromIn)), Volts(VoltsIn), By(std::move(ByIn)),
      EnergyFactors(energyFactors(From, By.Numbers)),
      AreaFactors(areaFactors(From, By.Numbers)),
      EnergyMedians(medians(EnergyFactors, By)),
      AreaMedians(medians(AreaFactors, By)) {}

std::vector<RowFactor> EnergyModel::rowFactors() const {
  std::vector<RowFactor> All;
  for (size_t N = 0; N != EnergyFactors.size(); ++N)
    All.push_back({From.Energies[N].Name, false,
                   estimate(EnergyMedians[N], EnergyFactors[N])});
  for (size_t N = 0; N != AreaFactors.size(); ++N)
    All.push_back(
        {From.Areas[N].Name, true, estimate(AreaMedians[N], AreaFactors[N])});
  return All;
}

/// By which factor a voltage may be beyond the technology's law: what the rows
/// say of energies and leakage means less and less there.
static constexpr double BeyondLaw = 1.2;

Expected<EnergyModel> EnergyModel::create(Technology From, unsigned ClockMhz,
                                          std::optional<double> Volts,
                                          Samples By) {
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
  return EnergyModel(std::move(From), *Volts, std::move(By));
}

/// The area of the machine of \p Work, by the samples of the rows' factors.
static Area areaBy(const Technology &From, const EnergyWork &Work,
                   const RowFactors &Factors,
                   const std::vector<double> &Medians) {
  const size_t Count = Factors.front().size();
  std::vector<std::pair<std::string_view, Drawn>> Parts;
  Drawn Chip(Count);
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
      Part = Parts.insert(Parts.end(), {C.Part, Drawn(Count)});
    const size_t Row = rowOf(From.Areas, C.Row);
    const double Um2 = Number * C.Count * From.Areas[Row].Value;
    Part->second.add(Um2, Factors[Row], Medians[Row]);
    if (isOnChip(C.LeaksAs, HasLink))
      Chip.add(Um2, Factors[Row], Medians[Row]);
  }
  Area A;
  for (const auto &[Name, Um2] : Parts)
    A.Parts.push_back({Name, Um2.estimated()});
  A.Chip = Chip.estimated();
  A.ChipDraws = std::move(Chip.Draws);
  return A;
}

Area EnergyModel::areaOf(const EnergyWork &Work) const {
  return areaBy(From, Work, AreaFactors, AreaMedians);
}

Expected<Energy> EnergyModel::energyOf(const EnergyWork &Work) const {
  std::vector<Drawn> Units(size_t(EnergyUnit::Count), Drawn(By.Numbers.size()));
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
                                EnergyFactors[Row], EnergyMedians[Row]);
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
            Factors, EnergyMedians[Leaks] * AreaMedians[Row]);
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
        factors(By.Numbers, "dram " + Found->Standard, Found->Sigma);
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
  Drawn Total(By.Numbers.size()), Chip = Total;
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

namespace {

/// The samples kept by a published figure: each with the probability of its
/// likelihood, a log-normal one that is 1 where \p Ours is \p Published.
Numbers keptBy(std::string_view Name, const Numbers &Of,
               const std::vector<double> &Ours, double Published,
               double Sigma) {
  Numbers Kept;
  for (size_t N = 0; N != Of.size(); ++N) {
    const double Off = stable::log(Ours[N] / Published) / Sigma;
    if (stable::uniform(Name, Of[N]) < stable::exp(-Off * Off / 2))
      Kept.push_back(Of[N]);
  }
  return Kept;
}

/// Adds what \p To still needs of a block of numbers that was tried.
void addKept(Samples &To, const Numbers &Kept, uint64_t Tried) {
  if (To.Numbers.size() == Samples::Count)
    return;
  for (const uint64_t N : Kept)
    if (To.Numbers.size() != Samples::Count)
      To.Numbers.push_back(N);
  To.Tried = Tried;
}

} // namespace

Expected<ChipSamples> samplesGivenChip(const Technology &T) {
  if (!T.Chip)
    return Error{"",
                 fmt::format("technology {} has no chip, expected a "
                             "--technology with the area and power of one",
                             T.Name),
                 ExitCode::Usage};
  const PublishedChip &C = *T.Chip;
  const EnergyWork Work = C.work();
  // With fewer than one in 1,000 the technology contradicts its chip.
  constexpr uint64_t Most = 1000 * uint64_t(Samples::Count);
  constexpr unsigned Block = Samples::Count;
  const std::vector<double> Unmoved(T.Areas.size(), 1);
  const auto KeptByPower = [&](const Numbers &Of) -> Expected<Numbers> {
    if (Of.empty())
      return Of;
    auto Model = EnergyModel::create(T, C.ClockMhz, C.Volts, {Of, Block});
    if (!Model)
      return Model.error();
    auto Spent = Model->energyOf(Work);
    if (!Spent)
      return Spent.error();
    return keptBy("power of the chip", Of, Spent->ChipDraws,
                  C.Watts * Spent->Seconds, C.PowerSigma);
  };
  const auto IsFull = [](const Samples &S) {
    return S.Numbers.size() == Samples::Count;
  };
  ChipSamples Given;
  for (uint64_t First = 0; First != Most; First += Block) {
    Numbers All(Block);
    std::iota(All.begin(), All.end(), First);
    const Numbers Fits =
        keptBy("area of the chip", All,
               areaBy(T, Work, areaFactors(T, All), Unmoved).ChipDraws,
               C.Mm2 / Mm2PerUm2, C.AreaSigma);
    addKept(Given.Area, Fits, First + Block);
    const auto Both = KeptByPower(Fits);
    if (!Both)
      return Both.error();
    addKept(Given.Both, *Both, First + Block);
    if (!IsFull(Given.Power)) {
      const auto Power = KeptByPower(All);
      if (!Power)
        return Power.error();
      addKept(Given.Power, *Power, First + Block);
    }
    if (IsFull(Given.Area) && IsFull(Given.Power) && IsFull(Given.Both))
      return Given;
  }
  return Error{
      "",
      fmt::format("technology {} contradicts its chip: of {} samples {} agree "
                  "with its area and {} with its power, too, expected {}",
                  T.Name, Most, Given.Area.Numbers.size(),
                  Given.Both.Numbers.size(), unsigned(Samples::Count)),
      ExitCode::Usage};
}

} // namespace vorion::isasim
