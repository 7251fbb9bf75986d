/// What the events of a time report are worth in joules and um^2, and how far
/// off that may be (docs/energy.md). A pure function of the report's activities
/// and a technology file: the same bits on every host.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// A row of a technology file. Its value is the median of a log-normal, and
/// \c Sigma the standard deviation of its logarithm.
struct TechnologyRow {
  std::string Name;
  double Value = 0; ///< pJ, um^2 or mW/mm^2, by what the row is of
  double Sigma = 0;
  std::string Source;
};

/// Currents of a supply of a DRAM device in mA, named as in its data sheet.
struct DramRail {
  double Volts = 0;
  double Idd0 = 0, Idd2n = 0, Idd3n = 0, Idd4r = 0, Idd4w = 0, Idd5 = 0;
};

/// Of a standard (docs/dram.md): a channel, and the times in which its commands
/// draw the currents.
struct DramCurrents {
  std::string Standard;
  double Devices = 0; ///< a channel; less than 1 if channels share one
  double RcNs = 0, RasNs = 0, RfcNs = 0, BurstNs = 0;
  double Sigma = 0;
  std::vector<DramRail> Rails;
  std::string Source;
};

/// What a technology file says.
struct Technology {
  std::string Name;
  /// Of the factor that all energies of the chip share, and of that of areas.
  double Sigma = 0;
  double Volts = 0; ///< at which the rows of the chip hold
  /// Alpha-power law: a clock is proportional to (V - threshold)^Alpha / V, and
  /// goes through the two points.
  double Alpha = 1;
  double LowVolts = 0, LowMhz = 0, HighVolts = 0, HighMhz = 0;
  /// Leakage current grows by e in so many volts.
  double LeakageVolts = 0;
  std::vector<TechnologyRow> Energies, Areas;
  std::vector<DramCurrents> Dram;
};

/// Reads a technology file. A row that is missing, a key that is not known and
/// a number that cannot be are errors that name the key.
Expected<Technology> parseTechnology(std::string_view Text,
                                     const std::string &Where);
Expected<Technology> readTechnology(const std::string &Path);
/// technologies/16nm.json.
const Technology &defaultTechnology();
/// Its text, to start a file of one's own from.
std::string_view defaultTechnologyText();

/// A figure with the interval that holds it in 90 % of the draws.
struct Estimate {
  double Value = 0, Low = 0, High = 0;
};

/// As an activity of a time report.
struct EventCount {
  std::string_view Unit, Event;
  uint64_t Count = 0;
};
/// Whether the model knows what the event is worth, be it nothing.
bool knowsEvent(const EventCount &E);

/// What a run did.
struct EnergyWork {
  uint64_t Cycles = 0;
  unsigned ClockMhz = 1;
  std::vector<EventCount> Events;
};

/// Of a part of the machine.
struct UnitEnergy {
  std::string_view Name;
  bool OnChip =
      false; ///< DRAM and the link never are; L2 and llc without a link
  Estimate Joules;
  Estimate Share; ///< of all joules
};

struct Energy {
  double Volts = 0, Seconds = 0;
  unsigned ClockMhz = 0;
  std::vector<UnitEnergy> Units;
  Estimate Total, Chip; ///< joules
  Estimate Watts, ChipWatts;
  /// Joules of each draw. Draws of one technology are of one world, so that
  /// ratios may share them.
  std::vector<double> TotalDraws, ChipDraws;
};

/// \p Of by \p By, whose draws are shared.
Estimate ratioOf(const std::vector<double> &Of, double OfValue,
                 const std::vector<double> &By, double ByValue);

struct PartArea {
  std::string_view Name;
  Estimate Um2;
};
struct Area {
  std::vector<PartArea> Parts;
  Estimate Chip; ///< um^2
};

/// A technology at a voltage.
class EnergyModel {
public:
  static constexpr unsigned Draws = 1000;

  /// \p Volts: by the technology's law for \p ClockMhz, if it is not given; an
  /// error where the law has none, and for a voltage far beyond the law.
  static Expected<EnergyModel> create(Technology From, unsigned ClockMhz,
                                      std::optional<double> Volts);

  /// An error where the technology does not know the machine's DRAM.
  Expected<Energy> energyOf(const EnergyWork &Work) const;
  /// Of the machine that did the work.
  Area areaOf(const EnergyWork &Work) const;

  double volts() const { return Volts; }
  const Technology &technology() const { return From; }

private:
  EnergyModel(Technology FromIn, double VoltsIn);

  Technology From;
  double Volts;
  /// By row and draw: what the row's value is multiplied by.
  std::vector<std::vector<double>> EnergyFactors, AreaFactors;
};

/// The clock that the law allows at a voltage, and the lowest voltage for a
/// clock; nothing above the law's last point.
double clockAt(const Technology &T, double Volts);
std::optional<double> voltsFor(const Technology &T, double Mhz);

nlohmann::ordered_json toJson(const Estimate &E);
nlohmann::ordered_json toJson(const Energy &E, const Technology &T);
nlohmann::ordered_json toJson(const Area &A);
/// A table, and a line of sums.
std::string toText(const Energy &E, const Technology &T);
/// The rows and what each event is worth, as Markdown tables (docs/energy.md).
std::string energyMarkdown(const Technology &T);

} // namespace vorion::isasim
