#include "observe/CycleProfile.h"

#include "observe/CodeText.h"
#include "observe/ProfileJson.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/ClockText.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace vorion::isasim {

namespace {
/// Instructions are listed that took at least this share of all cycles.
constexpr double LeastShare = 0.002;
} // namespace

uint64_t CycleProfile::Cost::sum() const {
  return std::accumulate(Cycles.begin(), Cycles.end(), uint64_t{0});
}

CycleProfile::Cost &CycleProfile::Cost::operator+=(const Cost &Other) {
  for (size_t N = 0; N != Cycles.size(); ++N)
    Cycles[N] += Other.Cycles[N];
  Executed += Other.Executed;
  return *this;
}

void CycleProfile::timeBegins(uint64_t) { Places.select(Device.image()); }

void CycleProfile::coreSpent(const CoreSpent &S) {
  Cost &To = S.Instruction == CoreSpent::NoInstruction
                 ? Nowhere
                 : Places.of(S.Instruction);
  To.Cycles[size_t(S.What)] += S.When.Until - S.When.From;
}

void CycleProfile::coreIssued(const CoreIssued &I) {
  ++Places.of(I.Instruction).Executed;
}

struct CycleProfile::Columns {
  Columns(const Cost &AllIn, uint64_t TotalIn) : Total(TotalIn) {
    for (size_t N = 0; N != AllIn.Cycles.size(); ++N)
      if (AllIn.Cycles[N])
        Reasons.push_back(static_cast<CoreCycle>(N));
  }
  static size_t width(CoreCycle Reason) {
    return std::max<size_t>(name(Reason).size(), 5) + 2;
  }
  std::string heading() const {
    std::string Text = fmt::format("{:>12}{:>7}", "cycles", "%");
    for (const CoreCycle R : Reasons)
      Text += fmt::format("{:>{}}", name(R), width(R));
    return Text + "\n";
  }
  std::string share(uint64_t Cycles) const {
    return Cycles ? fmt::format("{:.2f}", 100 * static_cast<double>(Cycles) /
                                              static_cast<double>(Total))
                  : "-";
  }
  std::string row(const Cost &C) const {
    const uint64_t Sum = C.sum();
    if (Sum == 0)
      return std::string(heading().size() + 1, ' ');
    std::string Text = fmt::format("{:>12}{:>7}", Sum, share(Sum));
    for (const CoreCycle R : Reasons)
      Text += fmt::format("{:>{}}", share(C.Cycles[size_t(R)]), width(R));
    return Text + "  ";
  }

  const uint64_t Total;
  std::vector<CoreCycle> Reasons;
};

std::string CycleProfile::report() const {
  Cost All = Places.total();
  All += Nowhere;
  const uint64_t Total = All.sum();
  const Columns Shown(All, Total);
  const Config &C = Device.config();
  std::string Text = fmt::format(
      "# vorion-profile 1\n"
      "# machine: {}\n"
      "# cycles: sum over all cores; then percent of all cycles, in total and "
      "by reason\n"
      "# a stall cycle of a core is attributed to the stalled instruction\n\n",
      clockedMachine(nameOf(C).Name, C.Timing.ClockMhz, ClockVersion));
  Text += fmt::format("{}{}total\n", Shown.heading(), Shown.row(All));
  Text += fmt::format("{}no instruction: start and end\n", Shown.row(Nowhere));
  Text += Places.listing(Shown.heading(),
                         [&](const Cost &C) { return Shown.row(C); });
  Text += fmt::format("\n{}instructions of {} % of all cycles and more\n",
                      Shown.heading(), 100 * LeastShare);
  Places.forEach([&](const SourceCosts<Cost>::Program &P, uint32_t Pc,
                     const Cost &C) {
    if (static_cast<double>(C.sum()) < LeastShare * static_cast<double>(Total))
      return;
    Text += fmt::format("{}{:08x}  {:<32}{}\n", Shown.row(C), Pc,
                        instructionText(*P.Code, Pc), P.Source->describe(Pc));
  });
  return Text;
}

std::string CycleProfile::json() const {
  using Json = nlohmann::ordered_json;
  const auto ByReason = [](const Cost &C) {
    Json Reasons = Json::object();
    for (size_t N = 0; N != C.Cycles.size(); ++N)
      if (C.Cycles[N])
        Reasons[std::string(name(static_cast<CoreCycle>(N)))] = C.Cycles[N];
    return Reasons;
  };
  Cost All = Places.total();
  All += Nowhere;
  const MachineName Name = nameOf(Device.config());
  return profileJson({{"format", "vorion-profile 1"},
                      {"machine", Name.Name},
                      {"machine_changes", Name.Changes},
                      {"clock_mhz", Device.config().Timing.ClockMhz},
                      {"clock_version", ClockVersion},
                      {"cycles", All.sum()},
                      {"no_instruction", ByReason(Nowhere)}},
                     Places, [&](const Cost &C) {
                       return Json{{"executed", C.Executed},
                                   {"cycles", C.sum()},
                                   {"by_reason", ByReason(C)}};
                     });
}

} // namespace vorion::isasim
