// splat-check-gradients: judges what `splat gradients` wrote for a fixture.

#include "Gradients.h"
#include "Tool.h"
#include "io/Metrics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::test {
namespace {

struct Arguments {
  std::string Expected, Actual, Json;
  double Most = 1e-5;
};

double numberOf(const splat::Npz &Arrays, const std::string &Name) {
  return Arrays.at(Name).toDoubles().at(0);
}

Expected<Success> run(const Arguments &A) {
  const auto Want = splat::readNpz(A.Expected);
  if (!Want)
    return Want.error();
  const auto Have = splat::readNpz(A.Actual);
  if (!Have)
    return Have.error();
  nlohmann::ordered_json Rows;
  std::string Beyond;
  for (const auto &[Name, Array] : *Want) {
    if (!Name.starts_with("f64_"))
      continue;
    const auto Found = Have->find("f32_" + Name.substr(4));
    const auto Exact = Array.toDoubles();
    if (Found == Have->end() || Found->second.elements() != Exact.size())
      return Error{A.Actual, fmt::format("no array f32_{} with {} elements",
                                         Name.substr(4), Exact.size())};
    const auto Actual = Found->second.toDoubles();
    const double Norm = numberOf(*Want, "norm_" + Name);
    const double Limit = std::max(A.Most, numberOf(*Want, "limit_" + Name));
    const double Error = splat::relativeL2(Actual, Exact, Norm);
    const bool Bad =
        !(Error <= Limit) ||
        std::ranges::any_of(Actual, [](double V) { return std::isnan(V); });
    fmt::print("{:<18}{:>10.1e}   at most {:.1e}{}\n", Name, Error, Limit,
               Bad ? "   BEYOND" : "");
    Rows[Name] = {{"error", Error}, {"limit", Limit}};
    if (Bad)
      Beyond += (Beyond.empty() ? "" : ", ") + Name;
  }
  if (!A.Json.empty())
    if (auto W = writeFileAtomically(A.Json, jsonText(Rows, 2) + "\n"); !W)
      return W;
  if (!Beyond.empty())
    return Error{A.Actual, "errors beyond their limits: " + Beyond,
                 ExitCode::GuestFailed};
  return Success{};
}

} // namespace
} // namespace vorion::test

int main(int Count, char **Values) {
  using namespace vorion::test;
  CLI::App App("Compares gradients with those of splat-fixture by the relative "
               "difference in the L2 norm.",
               "splat-check-gradients");
  Arguments A;
  App.add_option("expected", A.Expected,
                 "Expected gradients: gradients.npz of splat-fixture")
      ->required();
  App.add_option("actual", A.Actual, "Result of splat gradients")->required();
  App.add_option("--max", A.Most,
                 "Error bound, raised to twice the error of the fixture's own "
                 "fp32 result where that is larger")
      ->capture_default_str();
  App.add_option("--json", A.Json, "Write the table as JSON");
  return runTool(App, Count, Values, [&A] { return run(A); });
}
