#include "Table.h"

#include "HardCase.h"
#include "TrainingCase.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace vorion::test {
namespace {

/// What the rows say about a case.
struct Found {
  std::map<std::string, double> Errors; ///< by path, or by name(Way)
  double Single = 0, Bound = 0;
  /// Of fp64, with the case's dilation and without.
  std::string Digits[2] = {"-", "-"};
  unsigned Checks = 0, Kept = 0, Broken = 0, Detected = 0;
};

Found foundOf(const Rows &R, const std::string &Name) {
  Found F;
  for (const auto &[Key, Row] : R.all()) {
    if (Row["case"] != Name)
      continue;
    const bool Good = Row["broken"].get<std::string>().empty();
    if (Row.contains("digits")) {
      F.Digits[Row["oracle"].get<unsigned>()] =
          fmt::format("{:.0f}", std::floor(Row["digits"].get<double>()));
      continue;
    }
    if (Row.contains("kernel")) {
      ++F.Broken;
      F.Detected += Good;
      continue;
    }
    ++F.Checks;
    F.Kept += Good;
    if (Row["settings"] != 0)
      continue;
    F.Bound = Row["bound"];
    double &Error = F.Errors[Row["path"].get<std::string>()];
    Error = Row["error"];
    if (!Row.contains("doubtful")) // training's
      continue;
    // Where every pixel is doubtful, what they are off fp64 is the figure.
    Error = std::max(Error, Row["doubtful_error"].get<double>());
    F.Single = Row["single"];
  }
  return F;
}

std::string contractOf(const HardCase &C, const Found &F) {
  std::string Text = fmt::format("{:.1e}", F.Bound);
  if (C.MostDoubtful == 1)
    Text += ", as fp32 or fp64 stops";
  for (std::size_t K = 0; K < C.ExpectedCulls.size(); ++K)
    if (C.ExpectedCulls[K] != 0)
      Text += fmt::format(", {} {}", C.ExpectedCulls[K], splat::CullReasons[K]);
  return Text;
}

} // namespace

std::string tableOf(const Rows &R) {
  std::string Text =
      "| case | why | contract | raster | simt | fp32 reference | digits of "
      "fp64 | settings kept | broken kernels noticed |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const HardCase &C : catalogue()) {
    Found F = foundOf(R, C.Name);
    if (F.Checks == 0)
      continue;
    Text += fmt::format("| {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {}, {} "
                        "| {} of {} | {} of {} |\n",
                        C.Name, C.Why, contractOf(C, F), F.Errors["raster"],
                        F.Errors["simt"], F.Single, F.Digits[0], F.Digits[1],
                        F.Kept, F.Checks, F.Detected, F.Broken);
  }
  Text += "\n| case of training, of the order along rays, or of a mesh | why | "
          "contract | "
          "raster | simt | atomics | warp | broken kernels noticed "
          "|\n|---|---|---|---|---|---|---|---|\n";
  for (const TrainingCase &C : trainingCases()) {
    Found F = foundOf(R, C.Name);
    if (F.Checks == 0)
      continue;
    Text += fmt::format("| {} | {} | {} |", C.Name, C.Why, C.Contract);
    for (const char *Way : {"raster", "simt", "atomics", "warp"})
      Text += F.Errors.contains(Way) ? fmt::format(" {:.1e} |", F.Errors[Way])
              : C.Blends             ? " - |"
                                     : " the same |";
    Text += fmt::format(" {} of {} |\n", F.Detected, F.Broken);
  }
  Text += "\n| case | contract | test |\n|---|---|---|\n";
  for (const CaseElsewhere &C : casesElsewhere())
    Text += fmt::format("| {} | {} | `{}` |\n", C.Name, C.Contract, C.Test);
  return Text;
}

} // namespace vorion::test
