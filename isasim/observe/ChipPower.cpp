#include "observe/ChipPower.h"

#include "energy/Costs.h"

namespace vorion::isasim {

static double &shareOf(ChipEnergy &To, EnergyUnit U) {
  switch (U) {
  case EnergyUnit::FrontEnd:
  case EnergyUnit::Registers:
  case EnergyUnit::Arithmetic:
  case EnergyUnit::LoadStore:
  case EnergyUnit::LocalMemory:
    return To.Cores;
  case EnergyUnit::RasterLanes:
  case EnergyUnit::RasterBuffers:
  case EnergyUnit::RasterClock:
    return To.Rasterizers;
  case EnergyUnit::PixelUnit:
    return To.PixelUnits;
  default:
    return To.Always;
  }
}

static EnergyModel defaultModel(unsigned ClockMhz) {
  const Technology &T = defaultTechnology();
  return *EnergyModel::create(T, ClockMhz,
                              voltsFor(T, ClockMhz).value_or(T.Volts));
}

ChipEnergy chipEnergyOf(const TimeReport &R, const EnergyModel *Model) {
  if (!Model) {
    const EnergyModel Own = defaultModel(R.ClockMhz);
    return chipEnergyOf(R, &Own);
  }
  EnergyWork Work{R.Cycles, R.ClockMhz, {}};
  // Of the chip alone, whose technology may not know the DRAM.
  for (const Activity &A : R.Activities)
    if (A.Unit != "dram channels")
      Work.Events.push_back({A.Unit, A.Event, A.Count});
  ChipEnergy Sum;
  const auto Spent = Model->energyOf(Work);
  for (const UnitEnergy &Part : Spent->Units)
    for (unsigned N = 0; N != unsigned(EnergyUnit::Count); ++N)
      if (const auto U = static_cast<EnergyUnit>(N);
          Part.OnChip && name(U) == Part.Name)
        shareOf(Sum, U) += Part.Joules.Value;
  return Sum;
}

} // namespace vorion::isasim
