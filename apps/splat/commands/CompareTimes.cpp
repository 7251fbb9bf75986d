#include "commands/Compare.h"
#include "commands/OutputFile.h"

#include "device/ClockedMachine.h"
#include "device/TimeFile.h"
#include "io/ReportHead.h"
#include "page/TimePage.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Outputs.h"
#include "vorion/support/Printable.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

nlohmann::ordered_json figuresOf(const std::vector<TimeChange> &Changes) {
  nlohmann::ordered_json All = nlohmann::ordered_json::array();
  const auto OrNull = [](const std::optional<double> &Value) {
    return Value ? nlohmann::ordered_json(*Value) : nullptr;
  };
  for (const TimeChange &C : Changes)
    All.push_back({{"group", C.Group},
                   {"name", C.Name},
                   {"a", OrNull(C.A)},
                   {"b", OrNull(C.B)},
                   {"percent", OrNull(C.percent())}});
  return All;
}

Expected<Success> writeJson(const CompareArguments &A, const TimeFile &First,
                            const TimeFile &Second,
                            const std::vector<TimeChange> &Changes) {
  nlohmann::ordered_json Report = reportHead("splat-compare-times");
  Report.update({{"a", A.Reference},
                 {"b", A.Picture},
                 {fmt::format("{}_of_a", ClockedMachineKey), First.On},
                 {fmt::format("{}_of_b", ClockedMachineKey), Second.On},
                 {"figures", figuresOf(Changes)}});
  return writeFileAtomically(A.Json, jsonText(Report, 2) + "\n");
}

Expected<Success> writeTimes(const CompareArguments &A,
                             const std::vector<TimeChange> &Changes) {
  std::vector<TimeRun> Runs;
  for (const std::string &File : {A.Reference, A.Picture}) {
    auto Report = readJson<nlohmann::ordered_json>(File, "a time report");
    if (!Report)
      return Report.error();
    Runs.push_back({File, std::move(*Report), ""});
  }
  const auto Page = timePageOf(Runs, figuresOf(Changes));
  return Page ? writePage(A.Page, *Page) : Expected<Success>(Page.error());
}

} // namespace

Expected<Success> compareTimes(const CompareArguments &A) {
  for (const auto &Checked : {checkJsonName(A.Json), checkPage(A.Page)})
    if (!Checked)
      return Checked;
  if (auto Claimed = claimOutputs(
          {{"--json", A.Json}, {"--html", A.Page.Html}},
          {{"a time report", A.Reference}, {"a time report", A.Picture}});
      !Claimed)
    return Claimed;
  const auto First = readTimeFile(A.Reference);
  if (!First)
    return First.error();
  const auto Second = readTimeFile(A.Picture);
  if (!Second)
    return Second.error();
  if (auto Fit = checkComparable(*First, *Second, A.Across); !Fit)
    return Fit;
  const std::vector<TimeChange> Changes = changesOf(*First, *Second);
  printOut("{}{}", machinesText(*First, *Second), toText(Changes));
  if (!A.Json.empty())
    if (auto Written = writeJson(A, *First, *Second, Changes); !Written)
      return Written;
  if (A.Page.any())
    if (auto Written = writeTimes(A, Changes); !Written)
      return Written;
  if (!A.AtMost ||
      Second->Milliseconds <= First->Milliseconds * (1 + *A.AtMost / 100))
    return Success{};
  return Error{
      A.Picture,
      fmt::format("{:.3f} ms of {}, expected at most {} % above {:.3f}",
                  Second->Milliseconds, printable(Second->On), *A.AtMost,
                  First->Milliseconds),
      ExitCode::GuestFailed};
}

} // namespace vorion::splat
