#include "commands/Compare.h"
#include "commands/OutputFile.h"

#include "device/TimeFile.h"
#include "io/ReportHead.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Outputs.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Expected<Success> writeJson(const CompareArguments &A,
                            const std::vector<TimeChange> &Changes) {
  nlohmann::ordered_json Report = reportHead("splat-compare-times");
  Report.update({{"a", A.Reference},
                 {"b", A.Picture},
                 {"figures", nlohmann::ordered_json::array()}});
  const auto OrNull = [](const std::optional<double> &Value) {
    return Value ? nlohmann::ordered_json(*Value) : nullptr;
  };
  for (const TimeChange &C : Changes)
    Report["figures"].push_back({{"group", C.Group},
                                 {"name", C.Name},
                                 {"a", OrNull(C.A)},
                                 {"b", OrNull(C.B)},
                                 {"percent", OrNull(C.percent())}});
  return writeFileAtomically(A.Json, jsonText(Report, 2) + "\n");
}

} // namespace

Expected<Success> compareTimes(const CompareArguments &A) {
  if (auto Checked = checkJsonName(A.Json); !Checked)
    return Checked;
  if (auto Claimed =
          claimOutputs({{"--json", A.Json}}, {{"a time report", A.Reference},
                                              {"a time report", A.Picture}});
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
  printOut("{}", toText(Changes));
  if (!A.Json.empty())
    if (auto Written = writeJson(A, Changes); !Written)
      return Written;
  if (!A.AtMost ||
      Second->Milliseconds <= First->Milliseconds * (1 + *A.AtMost / 100))
    return Success{};
  return Error{A.Picture,
               fmt::format("{:.3f} ms, expected at most {} % more than {:.3f}",
                           Second->Milliseconds, *A.AtMost,
                           First->Milliseconds),
               ExitCode::GuestFailed};
}

} // namespace vorion::splat
