#include "accuracy/Verdict.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace vorion::splat {

namespace {

/// Less than this is hardly a cost.
constexpr double Hardly = 0.01;

std::string decibels(double Db) {
  return std::isinf(Db) ? "no error" : fmt::format("{:.1f} dB", Db);
}

/// "as many", "3.1 % fewer".
std::string compared(double Change, std::string_view More,
                     std::string_view Less, std::string_view Same) {
  const std::string Percent = fmt::format("{:.1f}", 100 * std::abs(Change));
  return Percent == "0.0"
             ? std::string(Same)
             : fmt::format("{} % {}", Percent, Change > 0 ? More : Less);
}

std::optional<double> change(const Candidate &C, const Candidate &Base,
                             TimeAxis A) {
  if (!C.time(A) || !Base.time(A))
    return std::nullopt;
  return *C.time(A) / *Base.time(A) - 1;
}

std::string ofTheFastest(const std::vector<Candidate> &All, double FloorDb) {
  const auto Best = recommend(All, TimeAxis::Cycles, FloorDb);
  if (!Best)
    return fmt::format("no setting reaches {:g} dB", FloorDb);
  const Candidate &C = All[*Best];
  if (C.Chosen.size() == 0)
    return fmt::format("no other setting with at least {:g} dB is faster "
                       "than the default",
                       FloorDb);
  return fmt::format(
      "the fastest setting with at least {:g} dB is {}: {} cycles than the "
      "default, {}",
      FloorDb, C.Chosen.name(),
      compared(*change(C, All.front(), TimeAxis::Cycles), "more", "fewer",
               "no fewer"),
      decibels(C.db()));
}

std::string ofTheExponential(const std::vector<const Candidate *> &Units,
                             const Candidate &Base, double FloorDb) {
  // The smallest that is good enough, or else the smallest.
  const Candidate &C =
      **std::ranges::min_element(Units, {}, [FloorDb](const Candidate *One) {
        return std::pair(One->db() < FloorDb, One->LaneArea);
      });
  // Of all units the one that changes most.
  double Cycles = 0;
  for (const Candidate *One : Units)
    if (const double By = *change(*One, Base, TimeAxis::Cycles);
        std::abs(By) > std::abs(Cycles))
      Cycles = By;
  const auto Energy = change(C, Base, TimeAxis::Energy);
  std::vector<std::string> Costs, Hardlies;
  const auto Sort = [&](const char *What, double By) {
    (std::abs(By) >= Hardly ? Costs : Hardlies).emplace_back(What);
  };
  Sort("cycles", Cycles);
  Sort("area", C.LaneArea - 1);
  if (Energy)
    Sort("energy", *Energy);
  const std::string Said =
      (Costs.empty() ? "costs almost no "
                     : fmt::format("costs {}", fmt::join(Costs, " and "))) +
      (Hardlies.empty() || Costs.empty()
           ? fmt::format("{}", fmt::join(Hardlies, " or "))
           : fmt::format(", and almost no {}", fmt::join(Hardlies, " or ")));
  return fmt::format(
      "the exponential unit {}: no unit changes the cycles by more than "
      "{:.1f} %; with {} instead of exact, a lane's area is {}{}, at {} "
      "instead of {}",
      Said, 100 * std::abs(Cycles), C.Chosen.value(KnobId::Exp),
      compared(C.LaneArea - 1, "more", "less", "the same"),
      Energy ? fmt::format(" and the chip's energy {}",
                           compared(*Energy, "more", "less", "the same"))
             : "",
      decibels(C.db()), decibels(Base.db()));
}

} // namespace

std::string verdictOf(const std::vector<Candidate> &All, double FloorDb,
                      const std::string &On) {
  std::vector<const Candidate *> Units;
  for (const Candidate &C : All)
    if (C.Chosen.size() == 1 && C.Chosen.place(KnobId::Exp) != 0)
      Units.push_back(&C);
  return fmt::format("{} ({})",
                     Units.empty()
                         ? ofTheFastest(All, FloorDb)
                         : ofTheExponential(Units, All.front(), FloorDb),
                     On);
}

} // namespace vorion::splat
