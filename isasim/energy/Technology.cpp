#include "energy/Costs.h"
#include "energy/TechnologyTexts.h"
#include "vorion/isasim/Energy.h"
#include "vorion/support/ClockText.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Printable.h"

#include <cassert>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tuple>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

/// No energy, area or power of an event is larger.
constexpr double MostValue = 1e9;
/// Of a logarithm: a factor of 20 either way.
constexpr double MostSigma = 3;
/// Of a published figure: with less hardly any sample would agree with it.
constexpr double LeastTolerance = 0.01;

constexpr std::string_view LeakageRow = "leakage of a mm2";

/// What the value of a row is called in its file.
std::string_view energyKey(std::string_view Row) {
  return Row == LeakageRow ? "mw" : "pj";
}

JsonShape rowShape(std::string_view Key) {
  return JsonShape::object({{std::string(Key), JsonShape::number()},
                            {"sigma", JsonShape::number()},
                            {"source", JsonShape::text()}})
      .closed();
}

JsonShape dramShape() {
  std::vector<JsonField> Rail;
  for (const char *Key :
       {"volts", "idd0", "idd2n", "idd3n", "idd4r", "idd4w", "idd5"})
    Rail.push_back({Key, JsonShape::number()});
  std::vector<JsonField> Fields;
  for (const char *Key :
       {"devices", "rc_ns", "ras_ns", "rfc_ns", "burst_ns", "sigma"})
    Fields.push_back({Key, JsonShape::number()});
  Fields.push_back({"source", JsonShape::text()});
  Fields.push_back(
      {"rails", JsonShape::list(JsonShape::object(Rail).closed(), 1, 8)});
  return JsonShape::object(Fields).closed();
}

/// What "activities" holds is as in a time report.
JsonShape chipShape() {
  std::vector<JsonField> Fields;
  for (const char *Key : {"mm2", "mm2_sigma", "watts", "watts_sigma", "volts"})
    Fields.push_back({Key, JsonShape::number()});
  for (const char *Key : {"source", "work"})
    Fields.push_back({Key, JsonShape::text()});
  Fields.push_back({"cycles", JsonShape::whole(1)});
  Fields.push_back({"clock_mhz", JsonShape::whole(1, MostClockMhz)});
  Fields.push_back({"activities", JsonShape::list(JsonShape::object(
                                      {{"unit", JsonShape::text()},
                                       {"event", JsonShape::text()},
                                       {"count", JsonShape::whole()}}))});
  return JsonShape::object(Fields).closed();
}

JsonShape technologyShape(const Json &Document) {
  std::vector<JsonField> Energies, Areas, Dram, Speed;
  for (const std::string_view Row : energyRows())
    Energies.push_back({std::string(Row), rowShape(energyKey(Row))});
  for (const std::string_view Row : areaRows())
    Areas.push_back({std::string(Row), rowShape("um2")});
  // A standard may have any name.
  if (const auto Found = Document.find("dram");
      Found != Document.end() && Found->is_object())
    for (const auto &[Standard, Of] : Found->items())
      Dram.push_back({Standard, dramShape()});
  for (const char *Key : {"alpha", "low_volts", "low_mhz", "high_volts",
                          "high_mhz", "leakage_volts"})
    Speed.push_back({Key, JsonShape::number()});
  Speed.push_back({"source", JsonShape::text()});
  return JsonShape::object({{"technology", JsonShape::text()},
                            {"sigma", JsonShape::number()},
                            {"volts", JsonShape::number()},
                            {"speed", JsonShape::object(Speed).closed()},
                            {"energies", JsonShape::object(Energies).closed()},
                            {"areas", JsonShape::object(Areas).closed()},
                            {"dram", JsonShape::object(Dram)},
                            {"chip", chipShape(), false}})
      .closed();
}

/// Takes numbers of a document of the right shape, and remembers the first that
/// cannot be.
class Reader {
public:
  double number(const Json &Of, const std::string &Path, std::string_view Key,
                double Least, double Most) {
    const Json &Number = Of.at(std::string(Key));
    const double Value = Number.get<double>();
    if (Problem.empty() && !(Value >= Least && Value <= Most))
      Problem = fmt::format("key {}{} is {}, expected a number from {} to {}",
                            Path, Key, jsonText(Number), Least, Most);
    return Value;
  }
  /// What \p Text, which reports print, may not do: look like a line of theirs.
  std::string printed(const std::string &Text, const std::string &Path) {
    if (Problem.empty() && escaped(Text) != Text)
      Problem = fmt::format(
          "key {} has '{}', expected printable characters on one line", Path,
          escaped(Text));
    return Text;
  }
  std::vector<TechnologyRow> rows(const Json &Of, const std::string &Path,
                                  std::span<const std::string_view> Names,
                                  std::string_view (*KeyOf)(std::string_view)) {
    std::vector<TechnologyRow> Rows;
    for (const std::string_view Name : Names) {
      const Json &Row = Of.at(std::string(Name));
      const std::string Inside = fmt::format("{}{}.", Path, Name);
      Rows.push_back(
          {std::string(Name), number(Row, Inside, KeyOf(Name), 0, MostValue),
           number(Row, Inside, "sigma", 0, MostSigma),
           printed(Row.at("source").get<std::string>(), Inside + "source")});
    }
    return Rows;
  }
  DramCurrents currents(const std::string &Standard, const Json &Of) {
    const std::string Path = fmt::format("dram.{}.", Standard);
    DramCurrents D;
    D.Standard = printed(Standard, "dram");
    D.Source = printed(Of.at("source").get<std::string>(), Path + "source");
    D.Devices = number(Of, Path, "devices", 0.01, 1024);
    D.RcNs = number(Of, Path, "rc_ns", 0, 1e6);
    D.RasNs = number(Of, Path, "ras_ns", 0, D.RcNs);
    D.RfcNs = number(Of, Path, "rfc_ns", 0, 1e6);
    D.BurstNs = number(Of, Path, "burst_ns", 0, 1e6);
    D.Sigma = number(Of, Path, "sigma", 0, MostSigma);
    for (const Json &R : Of.at("rails")) {
      DramRail Rail;
      Rail.Volts = number(R, Path + "rails.", "volts", 0, 10);
      for (const auto &[Key, To] : {std::pair{"idd0", &Rail.Idd0},
                                    {"idd2n", &Rail.Idd2n},
                                    {"idd3n", &Rail.Idd3n},
                                    {"idd4r", &Rail.Idd4r},
                                    {"idd4w", &Rail.Idd4w},
                                    {"idd5", &Rail.Idd5}})
        *To = number(R, Path + "rails.", Key, 0, 1e5);
      check(Rail, D, Path);
      D.Rails.push_back(Rail);
    }
    return D;
  }
  PublishedChip chip(const Json &Of) {
    PublishedChip C;
    C.Mm2 = number(Of, "chip.", "mm2", 1e-6, MostValue);
    C.AreaSigma = number(Of, "chip.", "mm2_sigma", LeastTolerance, MostSigma);
    C.Watts = number(Of, "chip.", "watts", 1e-6, MostValue);
    C.PowerSigma =
        number(Of, "chip.", "watts_sigma", LeastTolerance, MostSigma);
    C.Volts = number(Of, "chip.", "volts", 0.1, 10);
    C.Source = printed(Of.at("source").get<std::string>(), "chip.source");
    C.Cycles = Of.at("cycles").get<uint64_t>();
    C.ClockMhz = Of.at("clock_mhz").get<unsigned>();
    for (const Json &A : Of.at("activities")) {
      C.Events.push_back({A["unit"].get<std::string>(),
                          A["event"].get<std::string>(),
                          A["count"].get<uint64_t>()});
      const auto &[Unit, Event, Count] = C.Events.back();
      if (Problem.empty() && !knowsEvent({Unit, Event, Count}))
        Problem = fmt::format("key chip.activities has the event '{}: {}', "
                              "expected one of a time report",
                              escaped(Unit), escaped(Event));
    }
    return C;
  }
  std::string Problem;

private:
  /// That no command takes less than a device that stands: what it takes
  /// beyond that is its energy.
  void check(const DramRail &R, const DramCurrents &D,
             const std::string &Path) {
    // A cycle of rc_ns is open for ras_ns.
    const double Cycle =
        R.Idd2n + (R.Idd3n - R.Idd2n) * (D.RcNs > 0 ? D.RasNs / D.RcNs : 0);
    constexpr double Rounding = 1e-9;
    for (const auto &[Key, Value, Standing] :
         {std::tuple{"idd0", R.Idd0, Cycle * (1 - Rounding)},
          {"idd4r", R.Idd4r, R.Idd3n},
          {"idd4w", R.Idd4w, R.Idd3n},
          {"idd5", R.Idd5, R.Idd3n}})
      if (Problem.empty() && Value < Standing)
        Problem =
            fmt::format("key {}rails.{} is {:g}, expected at least {:g}, the "
                        "standby current of the device (idd2n, idd3n)",
                        Path, Key, Value, Standing);
  }
};

} // namespace

Expected<Technology> parseTechnology(std::string_view Text,
                                     const std::string &Where) {
  const auto Document = parseJson<Json>(Text, Where, "a technology");
  if (!Document)
    return Document.error();
  if (const auto Fits = technologyShape(*Document).check(*Document, Where);
      !Fits)
    return Fits.error();
  const Json &J = *Document;
  Reader In;
  Technology T;
  T.Name = In.printed(J["technology"].get<std::string>(), "technology");
  T.Sigma = In.number(J, "", "sigma", 0, MostSigma);
  T.Volts = In.number(J, "", "volts", 0.1, 10);
  const Json &Speed = J["speed"];
  T.Alpha = In.number(Speed, "speed.", "alpha", 1, 2);
  T.LowVolts = In.number(Speed, "speed.", "low_volts", 0.1, 10);
  T.LowMhz = In.number(Speed, "speed.", "low_mhz", 1e-3, 1e6);
  T.HighVolts = In.number(Speed, "speed.", "high_volts", T.LowVolts + 0.01, 10);
  // So that the threshold of the law lies above 0.
  T.HighMhz = In.number(Speed, "speed.", "high_mhz", T.LowMhz, 1e6);
  T.LeakageVolts = In.number(Speed, "speed.", "leakage_volts", 0.01, 10);
  T.Energies = In.rows(J["energies"], "energies.", energyRows(), energyKey);
  T.Areas = In.rows(J["areas"], "areas.", areaRows(),
                    [](std::string_view) { return std::string_view("um2"); });
  for (const auto &[Standard, Of] : J["dram"].items())
    T.Dram.push_back(In.currents(Standard, Of));
  if (const auto Chip = J.find("chip"); Chip != J.end())
    T.Chip = In.chip(*Chip);
  if (!In.Problem.empty())
    return Error{Where, In.Problem};
  return T;
}

Expected<Technology> readTechnology(const std::string &Path) {
  const auto Bytes = readFile(Path);
  if (!Bytes)
    return Bytes.error();
  return parseTechnology(
      {reinterpret_cast<const char *>(Bytes->data()), Bytes->size()}, Path);
}

std::string_view defaultTechnologyText() {
  return technologyText(technologyNames().front());
}

const Technology &defaultTechnology() {
  static const Technology Default = [] {
    auto Parsed =
        parseTechnology(defaultTechnologyText(), "the default technology");
    assert(Parsed && "a test holds it good");
    return std::move(*Parsed);
  }();
  return Default;
}

} // namespace vorion::isasim
