#include "commands/Compare.h"
#include "commands/OutputFile.h"

#include "io/Npz.h"
#include "io/ReportHead.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Outputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace vorion::splat {
namespace {

using Json = nlohmann::ordered_json;

/// Where two lists of pairs part.
struct FirstDifference {
  std::string Array;
  std::size_t Place; ///< the shorter list's length where it is a beginning
};

constexpr const char *Names[] = {"tile", "depth_bits", "index"};

/// The arrays of \p Path by which pairs are sorted.
Expected<Npz> readPairs(const std::string &Path) {
  auto File = NpzFile::open(Path);
  if (!File)
    return File.error();
  Npz Pairs;
  for (const char *Name : Names) {
    const NpyShape *Found = File->find(Name);
    if (!Found || Found->Type != "i4")
      return Error{
          Path,
          fmt::format("no int32 array {}, expected a file of --pairs", Name)};
    auto Array = File->read(Name);
    if (!Array)
      return Array.error();
    Pairs[Name] = std::move(*Array);
  }
  return Pairs;
}

std::optional<FirstDifference> firstDifference(const Npz &First,
                                               const Npz &Second) {
  for (const char *Name : Names) {
    const auto X = First.at(Name).toDoubles();
    const auto Y = Second.at(Name).toDoubles();
    const auto At = std::mismatch(X.begin(), X.end(), Y.begin(), Y.end());
    if (At.first != X.end() || At.second != Y.end())
      return FirstDifference{Name,
                             static_cast<std::size_t>(At.first - X.begin())};
  }
  return std::nullopt;
}

Expected<Success> writeReport(const CompareArguments &A, std::size_t First,
                              std::size_t Second,
                              const std::optional<FirstDifference> &Found) {
  Json Report = reportHead("splat-compare-pairs");
  for (const auto &[Name, File] :
       {std::pair("a", &A.Reference), std::pair("b", &A.Picture)}) {
    auto Input = comparedFile(*File);
    if (!Input)
      return Input.error();
    Report[Name] = std::move(*Input);
  }
  Report.update({{"pairs_a", First},
                 {"pairs_b", Second},
                 {"equal", !Found},
                 {"first_difference",
                  Found ? Json{{"array", Found->Array}, {"place", Found->Place}}
                        : Json()}});
  return writeFileAtomically(A.Json, jsonText(Report, 2) + "\n");
}

} // namespace

Expected<Success> comparePairs(const CompareArguments &A) {
  if (auto Checked = checkJsonName(A.Json); !Checked)
    return Checked;
  if (auto Claimed = claimOutputs(
          {{"--json", A.Json}}, {{"pairs", A.Reference}, {"pairs", A.Picture}});
      !Claimed)
    return Claimed;
  const auto First = readPairs(A.Reference);
  if (!First)
    return First.error();
  const auto Second = readPairs(A.Picture);
  if (!Second)
    return Second.error();
  const std::size_t Pairs = First->at("tile").elements();
  const std::size_t Others = Second->at("tile").elements();
  const auto Found = firstDifference(*First, *Second);
  if (!A.Json.empty())
    if (auto Written = writeReport(A, Pairs, Others, Found); !Written)
      return Written;
  if (Found)
    return Error{
        A.Picture,
        fmt::format("{}, {} differs from index {} on, expected the {} of {}",
                    counted(Others, "pair"), Found->Array, Found->Place,
                    counted(Pairs, "pair"), A.Reference),
        ExitCode::GuestFailed};
  printOut("equal: {}\n", counted(Pairs, "pair"));
  return Success{};
}

} // namespace vorion::splat
