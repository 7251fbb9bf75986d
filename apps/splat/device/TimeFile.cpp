#include "device/TimeFile.h"

#include "device/ClockedMachine.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string_view>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char *Wanted =
    "the output of `splat render --time --json` or `vorion-sim --time --stats`";

/// Adds up figures of one name. Their number is small.
class Figures {
public:
  void add(const std::string &Group, const std::string &Name, double Value) {
    const auto Known = std::ranges::find_if(All, [&](const TimeFigure &F) {
      return F.Group == Group && F.Name == Name;
    });
    if (Known != All.end()) {
      Known->Value += Value;
      return;
    }
    // Behind the others of its group.
    const auto Last =
        std::find_if(All.rbegin(), All.rend(),
                     [&](const TimeFigure &F) { return F.Group == Group; });
    All.insert(Last == All.rend() ? All.end() : Last.base(),
               {Group, Name, Value});
  }
  /// The numbers of an object, or of a list of objects.
  void addMembers(const std::string &Group, const Json &Of) {
    for (const auto &[Key, Value] : Of.items())
      if (Value.is_object())
        addMembers(Group, Value);
      else if (Value.is_number())
        add(Group, Key, Value.get<double>());
  }
  std::vector<TimeFigure> take() { return std::move(All); }

private:
  std::vector<TimeFigure> All;
};

/// What describes the machine in a time report and is no count.
constexpr std::string_view Descriptions[] = {
    "cycles",          "clock_mhz", "clock_version", "machine",
    "machine_changes", "host",      "lane_areas",    "dram_table"};

/// A time report, but for its cycles.
void addUnits(Figures &To, const Json &Report) {
  for (const auto &[Key, Value] : Report.items()) {
    if (std::ranges::find(Descriptions, Key) != std::end(Descriptions))
      continue;
    if (Key == "activities") {
      // Not under the unit alone: "dram" is a part of the report, too.
      for (const Json &A : Value)
        To.add(A.at("unit").get<std::string>() + ", events", A.at("event"),
               A.at("count"));
    } else if (Value.is_structured()) {
      To.addMembers(Key, Value);
    } else if (Value.is_number()) {
      To.add("other", Key, Value.get<double>());
    }
  }
}

/// Of a report: what else than its numbers says which machine it is.
void describe(TimeFile &To, const Json &Report) {
  To.ClockVersion = Report.value("clock_version", 1U);
  To.On = clockedMachine(Report);
  for (const char *Key : {"clock_mhz", "host", "lane_areas"})
    if (Report.contains(Key))
      To.Machine[Key] = Report.at(Key);
  // By what is in it: a file may lie elsewhere.
  if (Report.contains("dram_table"))
    To.Machine["dram_table"] = Report.at("dram_table").at("fnv1a64");
}

/// The members of \p From that \p Keys name.
nlohmann::json chosen(const Json &From,
                      std::initializer_list<const char *> Keys) {
  nlohmann::json To;
  for (const char *Key : Keys)
    if (From.contains(Key))
      To[Key] = From.at(Key);
  return To;
}

/// What a picture is made of.
nlohmann::json workOf(const Json &Picture) {
  nlohmann::json Work =
      chosen(Picture, {"view", "resolution", "rules", "support", "path",
                       "options", "programs"});
  // By contents: a file may lie elsewhere.
  for (const char *Key : {"scene", "cameras"})
    Work[Key] = Picture.at(Key).at("fnv1a64");
  return Work;
}

/// `splat render --json`, of one picture or several.
TimeFile ofFrames(const Json &Whole) {
  TimeFile F;
  const bool IsSequence = Whole.contains("pictures");
  const Json &First = IsSequence ? Whole.at("pictures").at(0) : Whole;
  F.Machine = chosen(First.at("device"), {"name", "compute_units"});
  if (IsSequence) {
    F.Work["overlap"] = Whole.at("overlap");
    for (const Json &Picture : Whole.at("pictures"))
      F.Work["pictures"].push_back(workOf(Picture));
  } else {
    F.Work = workOf(Whole);
  }
  const Json &Time = Whole.at("time");
  const Json &Sum = Time.at("sum");
  // However somebody wrote its configuration.
  const auto Name = Sum.value("machine", std::string());
  F.Machine["machine"] = Name.substr(0, Name.find(" with changes"));
  F.Machine["machine_changes"] = Sum.value("machine_changes", Json::array());
  describe(F, Sum);
  F.Milliseconds = Time.at(IsSequence ? "total_ms" : "frame_ms");
  Figures All;
  All.add("", "cycles", Sum.at("cycles"));
  for (const Json &Stage : Time.at("stages"))
    if (Stage.contains("time"))
      All.add("stages, cycles", Stage.at("name"),
              Stage.at("time").at("cycles"));
  for (const Json &Stage : Time.at("stages"))
    for (const Json &K : Stage.value("kernels", Json::array()))
      All.add("kernels, cycles", K.at("name"), K.at("cycles"));
  addUnits(All, Sum);
  F.Figures = All.take();
  return F;
}

/// That no run of \p Runs, in the file \p Path, was cut off or failed: what a
/// part took says nothing of the whole.
Expected<Success> checkOutcomes(const std::string &Path, const Json &Runs) {
  for (std::size_t N = 0; N != Runs.size(); ++N)
    if (const std::string Outcome = Runs[N].value("outcome", "done");
        Outcome != "done")
      return Error{
          Path, fmt::format("run {}, {}: outcome '{}', expected 'done'", N + 1,
                            printable(Runs[N].at("name").get<std::string>()),
                            Outcome)};
  return Success{};
}

/// `vorion-sim --stats`, and VORION_STATS: of the runs that were timed.
TimeFile ofRuns(const Json &Whole) {
  TimeFile F;
  F.Machine = Whole.at("config");
  F.Machine.erase("host_threads"); // changes no time
  std::vector<Json> Runs;
  std::ranges::copy_if(Whole.at("runs"), std::back_inserter(Runs),
                       [](const Json &Run) { return Run.contains("time"); });
  Figures All;
  for (const Json &Run : Runs) {
    F.Work["runs"].push_back(Run.at("name").get<std::string>());
    F.Work["launches"].push_back(
        nlohmann::json(Run.value("launch", Json::object())));
    const Json &Time = Run.at("time");
    describe(F, Time);
    const double Cycles = Time.at("cycles");
    F.Milliseconds += Cycles / (1e3 * Time.at("clock_mhz").get<double>());
    All.add("", "cycles", Cycles);
  }
  for (const Json &Run : Runs)
    All.add("runs, cycles", Run.at("name"), Run.at("time").at("cycles"));
  for (const Json &Run : Runs)
    addUnits(All, Run.at("time"));
  F.Figures = All.take();
  return F;
}

std::string joined(const std::string &Path) {
  std::string Text = Path.empty() ? Path : Path.substr(1);
  std::ranges::replace(Text, '/', '.');
  return Text;
}

/// Takes out of the objects in \p A and \p B what only one of them says: older
/// reports, and those of OpenCL, know less of their launches.
void keepCommon(nlohmann::json &A, nlohmann::json &B) {
  if (A.is_object() && B.is_object()) {
    std::erase_if(A.get_ref<nlohmann::json::object_t &>(),
                  [&](const auto &Each) { return !B.contains(Each.first); });
    std::erase_if(B.get_ref<nlohmann::json::object_t &>(),
                  [&](const auto &Each) { return !A.contains(Each.first); });
    for (auto &[Key, Value] : A.items())
      keepCommon(Value, B[Key]);
  } else if (A.is_array() && B.is_array()) {
    for (std::size_t N = 0; N < std::min(A.size(), B.size()); ++N)
      keepCommon(A[N], B[N]);
  }
}

/// That \p A and \p B are the same; \p What they are.
Expected<Success> checkSame(const TimeFile &FileOfA, const nlohmann::json &A,
                            const TimeFile &FileOfB, const nlohmann::json &B,
                            std::string_view What) {
  if (A == B)
    return Success{};
  const nlohmann::json First = nlohmann::json::diff(A, B).at(0);
  std::string Path = First.at("path");
  nlohmann::json::json_pointer Place(Path);
  // The place behind a list's last entry: the first that only B has.
  if (Place.back() == "-") {
    Place.pop_back();
    Place /= A.at(Place).size();
    Path = Place.to_string();
  }
  const auto Text = [&](const nlohmann::json &Of) {
    return Of.contains(Place) ? jsonText(Of.at(Place)) : "nothing";
  };
  return Error{FileOfB.Path,
               fmt::format("different {}: {} is {}, expected {} as in {} "
                           "(--across permits the comparison)",
                           What, joined(Path), Text(B), Text(A), FileOfA.Path)};
}

std::string number(const std::optional<double> &Value) {
  if (!Value)
    return "-";
  return fmt::format("{:.{}f}", *Value, std::trunc(*Value) == *Value ? 0 : 3);
}

} // namespace

Expected<TimeFile> readTimeFile(const std::string &Path) {
  const auto Whole = readJson<Json>(Path, Wanted);
  if (!Whole)
    return Whole.error();
  // The file may be anything: a member that is missing or of another kind is
  // an exception of the library, and no figure of it is used then.
  try {
    if (Whole->contains("runs"))
      if (auto Ended = checkOutcomes(Path, Whole->at("runs")); !Ended)
        return Ended.error();
    if (Whole->contains("time") || Whole->contains("runs")) {
      TimeFile F = Whole->contains("time") ? ofFrames(*Whole) : ofRuns(*Whole);
      F.Path = Path;
      if (!F.Figures.empty())
        return F;
    }
  } catch (const nlohmann::json::exception &) {
    return Error{Path, fmt::format("no time report, expected {}", Wanted)};
  }
  return Error{Path, fmt::format("no times, expected {}", Wanted)};
}

Expected<Success> checkComparable(const TimeFile &A, const TimeFile &B,
                                  bool Across) {
  if (A.ClockVersion != B.ClockVersion)
    return Error{B.Path,
                 fmt::format("version {} of the clock, expected version "
                             "{} as in {}: times of different versions are not "
                             "comparable",
                             B.ClockVersion, A.ClockVersion, A.Path)};
  if (Across)
    return Success{};
  if (auto Same = checkSame(A, A.Machine, B, B.Machine, "machine"); !Same)
    return Same;
  nlohmann::json WorkOfA = A.Work, WorkOfB = B.Work;
  if (WorkOfA.contains("launches") && WorkOfB.contains("launches"))
    keepCommon(WorkOfA["launches"], WorkOfB["launches"]);
  // Of other runs, their names say more.
  if (WorkOfA.value("runs", nlohmann::json()) !=
      WorkOfB.value("runs", nlohmann::json()))
    for (nlohmann::json *Work : {&WorkOfA, &WorkOfB})
      Work->erase("launches");
  return checkSame(A, WorkOfA, B, WorkOfB, "work");
}

std::optional<double> TimeChange::percent() const {
  if (!A || !B || *A == 0)
    return std::nullopt;
  return 100 * (*B / *A - 1);
}

std::vector<TimeChange> changesOf(const TimeFile &A, const TimeFile &B) {
  std::vector<TimeChange> All{{"", "ms", A.Milliseconds, B.Milliseconds}};
  for (const TimeFigure &F : A.Figures)
    All.push_back({F.Group, F.Name, F.Value, std::nullopt});
  for (const TimeFigure &F : B.Figures) {
    const auto Known = std::ranges::find_if(All, [&](const TimeChange &C) {
      return C.Group == F.Group && C.Name == F.Name;
    });
    if (Known != All.end()) {
      Known->B = F.Value;
      continue;
    }
    // Behind the others of its group.
    const auto Last =
        std::find_if(All.rbegin(), All.rend(),
                     [&](const TimeChange &C) { return C.Group == F.Group; });
    All.insert(Last == All.rend() ? All.end() : Last.base(),
               {F.Group, F.Name, std::nullopt, F.Value});
  }
  return All;
}

std::string machinesText(const TimeFile &A, const TimeFile &B) {
  if (A.On == B.On)
    return fmt::format("machine      {}\n", printable(A.On));
  return fmt::format("machine of a {}\nmachine of b {}\n", printable(A.On),
                     printable(B.On));
}

std::string toText(const std::vector<TimeChange> &Changes) {
  std::string Text =
      fmt::format("{:<28}{:>16}{:>16}{:>12}\n", "", "a", "b", "change");
  std::string Group;
  for (const TimeChange &C : Changes) {
    if (!C.Group.empty() && C.A == C.B)
      continue;
    if (C.Group != Group)
      Text += C.Group + "\n";
    Group = C.Group;
    const auto Percent = C.percent();
    Text += fmt::format("{:<28}{:>16}{:>16}{:>12}\n",
                        (Group.empty() ? "" : "  ") + C.Name, number(C.A),
                        number(C.B),
                        Percent ? fmt::format("{:+.2f} %", *Percent) : "-");
  }
  return Text;
}

} // namespace vorion::splat
