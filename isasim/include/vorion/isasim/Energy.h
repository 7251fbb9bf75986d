/// The energy of the events of a time report and the area of the units, with
/// their uncertainty (docs/energy.md). A pure function of the report's
/// activities and a technology file: results are bit-identical on every host.
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

/// Currents of a channel of a DRAM standard (docs/dram.md), and the times in
/// which its commands draw them.
struct DramCurrents {
  std::string Standard;
  double Devices = 0; ///< a channel; less than 1 if channels share one
  double RcNs = 0, RasNs = 0, RfcNs = 0, BurstNs = 0;
  double Sigma = 0;
  std::vector<DramRail> Rails;
  std::string Source;
};

/// An event, named as in the activities of a time report.
struct EventCount {
  std::string_view Unit, Event;
  uint64_t Count = 0;
};

/// Activities of a run.
struct EnergyWork {
  uint64_t Cycles = 0;
  unsigned ClockMhz = 1;
  std::vector<EventCount> Events;
};

/// A chip of a technology whose area and power were published. Tolerances are
/// standard deviations of the logarithm of the published figure.
struct PublishedChip {
  double Mm2 = 0, AreaSigma = 0;
  double Watts = 0, PowerSigma = 0;
  double Volts = 0; ///< the supply at which it has that power
  std::string Source;
  /// The machine, and the work during which it has that power.
  uint64_t Cycles = 0;
  unsigned ClockMhz = 1;
  struct Event {
    std::string Unit, Name;
    uint64_t Count = 0;
  };
  std::vector<Event> Events;

  /// Valid as long as the chip.
  EnergyWork work() const;
};

/// The contents of a technology file.
struct Technology {
  std::string Name;
  /// Sigma of the factor common to all energies of the chip, and of that of
  /// areas.
  double Sigma = 0;
  double Volts = 0; ///< at which the rows of the chip hold
  /// Alpha-power law: the clock frequency is proportional to (V -
  /// threshold)^Alpha / V, fitted to the two points.
  double Alpha = 1;
  double LowVolts = 0, LowMhz = 0, HighVolts = 0, HighMhz = 0;
  /// Increase of the voltage, in V, for which the leakage current grows by a
  /// factor of e.
  double LeakageVolts = 0;
  std::vector<TechnologyRow> Energies, Areas;
  std::vector<DramCurrents> Dram;
  std::optional<PublishedChip> Chip;
};

/// Reads a technology file. A missing row, an unknown key and an invalid number
/// are errors that name the key.
Expected<Technology> parseTechnology(std::string_view Text,
                                     const std::string &Where);
Expected<Technology> readTechnology(const std::string &Path);
/// technologies/16nm.json.
const Technology &defaultTechnology();
/// Its text, as a template.
std::string_view defaultTechnologyText();

/// A value with its 90 % interval over the Monte Carlo samples.
struct Estimate {
  double Value = 0, Low = 0, High = 0;
};

/// Whether the model has a cost for the event, which may be 0.
bool knowsEvent(const EventCount &E);

/// Energy of a part of the machine.
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
  /// Joules of each Monte Carlo sample. Samples with the same index use the
  /// same parameters, so that ratios are computed per sample.
  std::vector<double> TotalDraws, ChipDraws;
};

/// The ratio \p Of / \p By, computed per sample.
Estimate ratioOf(const std::vector<double> &Of, double OfValue,
                 const std::vector<double> &By, double ByValue);

struct PartArea {
  std::string_view Name;
  Estimate Um2;
};
struct Area {
  std::vector<PartArea> Parts;
  Estimate Chip; ///< um^2
  std::vector<double> ChipDraws;
};

/// Samples of a technology's parameters. A parameter's sample depends on its
/// name and the number alone.
struct Samples {
  static constexpr unsigned Count = 1000;

  std::vector<uint64_t> Numbers; ///< as many as \c Count
  uint64_t Tried = Count;        ///< of which these were kept

  /// By the technology alone: all numbers from 0.
  static Samples prior();
  bool isPrior() const { return Tried == Numbers.size(); }
};

/// Samples given what was published of a technology's chip. A sample is kept
/// with its likelihood as probability, so that all that are kept have the same
/// weight.
struct ChipSamples {
  Samples Area, Power, Both; ///< given one figure alone, or both
};
/// Errors: the technology has no chip, or hardly any sample agrees with it.
Expected<ChipSamples> samplesGivenChip(const Technology &T);

/// The factor of a row's value over the samples: how far a condition moves it.
struct RowFactor {
  std::string_view Row;
  bool IsArea = false;
  Estimate Factor; ///< the value is the median
};

/// A technology at a voltage.
class EnergyModel {
public:
  /// \p Volts: default is the voltage for \p ClockMhz by the technology's
  /// frequency law. Errors: no such voltage, or a voltage far outside the law.
  static Expected<EnergyModel> create(Technology From, unsigned ClockMhz,
                                      std::optional<double> Volts,
                                      Samples By = Samples::prior());

  /// Error: the technology has no currents for the machine's DRAM.
  Expected<Energy> energyOf(const EnergyWork &Work) const;
  /// Configuration of the machine.
  Area areaOf(const EnergyWork &Work) const;

  /// Of all rows, over the technology's values.
  std::vector<RowFactor> rowFactors() const;

  double volts() const { return Volts; }
  const Technology &technology() const { return From; }
  const Samples &samples() const { return By; }

private:
  EnergyModel(Technology FromIn, double VoltsIn, Samples ByIn);

  Technology From;
  double Volts;
  Samples By;
  /// Factor of the row's value, by row and sample.
  std::vector<std::vector<double>> EnergyFactors, AreaFactors;
  /// The value of a figure: with all rows at the median of their factors.
  std::vector<double> EnergyMedians, AreaMedians;
};

/// The maximum clock frequency at a voltage by the frequency law, and the
/// minimum voltage for a frequency; empty above the law's last point.
double clockAt(const Technology &T, double Volts);
std::optional<double> voltsFor(const Technology &T, double Mhz);

nlohmann::ordered_json toJson(const Estimate &E);
nlohmann::ordered_json toJson(const Energy &E, const Technology &T);
nlohmann::ordered_json toJson(const Area &A);
nlohmann::ordered_json toJson(const std::vector<RowFactor> &Rows);
/// A table with a line of sums.
std::string toText(const Energy &E, const Technology &T);
/// The \p Count rows that are moved farthest from 1, as a line each.
std::string movedRowsText(std::vector<RowFactor> Rows, size_t Count);
/// The rows and the cost of each event, as Markdown tables (docs/energy.md).
std::string energyMarkdown(const Technology &T);

} // namespace vorion::isasim
