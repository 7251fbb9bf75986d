#include "timing/dram/Replay.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace vorion::isasim::dram {

namespace {

class Checker {
public:
  Checker(const TimingTable &Table, const std::vector<Issued> &All)
      : Table(Table), All(All), OpenRow(Table.banks()) {
    for (const Constraint &C : Table.Constraints)
      Horizon = std::max<uint64_t>(Horizon, C.Ticks);
  }

  std::string check(size_t Index) {
    const Issued &I = All[Index];
    if (Index != 0 && I.At < All[Index - 1].At)
      return "goes back in time";
    if (std::string Bad = halves(I); !Bad.empty())
      return Bad;
    if (std::string Bad = state(I); !Bad.empty())
      return Bad;
    if (std::string Bad = buses(Index); !Bad.empty())
      return Bad;
    for (const Constraint &C : Table.Constraints)
      if (C.To == I.What && count(C, Index) >= C.Window)
        return fmt::format("is within {} ticks of {} (same {})", C.Ticks,
                           name(C.From), name(C.Within));
    return {};
  }

private:
  uint32_t rank(const Issued &I) const {
    return I.Where.Bank / Table.banksPerRank();
  }
  bool isIn(Scope S, const Issued &A, const Issued &B) const {
    switch (S) {
    case Scope::Bank:
      return A.Where.Bank == B.Where.Bank;
    case Scope::BankGroup:
      return A.Where.Bank / Table.BanksPerGroup ==
             B.Where.Bank / Table.BanksPerGroup;
    case Scope::Rank:
      return rank(A) == rank(B);
    case Scope::OtherRanks:
      return rank(A) != rank(B);
    case Scope::Channel:
    case Scope::Count:
      break;
    }
    return true;
  }

  /// Commands that the constraint's time does not yet let be past.
  unsigned count(const Constraint &C, size_t Index) const {
    unsigned Near = 0;
    for (size_t J = Index; J != 0; --J) {
      const Issued &Past = All[J - 1];
      if (Past.At + Horizon <= All[Index].At)
        break;
      Near += Past.What == C.From && isIn(C.Within, Past, All[Index]) &&
              Past.At + C.Ticks > All[Index].At;
    }
    return Near;
  }

  /// Of an activation of two commands.
  std::string halves(const Issued &I) {
    const bool IsSecond = I.What == Command::Activate2;
    if (!Half)
      return IsSecond ? "is the second half of no activation" : "";
    if (IsSecond ? I.Where.Bank != Half->Where.Bank
                 : I.What == Command::Activate)
      return "is between the halves of an activation";
    if (I.At > Half->At + Table.SecondActivateWithin)
      return "is too late for the second half of an activation";
    if (IsSecond)
      Half.reset();
    else if (I.Where.Bank == Half->Where.Bank)
      return "reaches for a row that is half open";
    return "";
  }

  std::string state(const Issued &I) {
    std::optional<uint32_t> &Row = OpenRow[I.Where.Bank];
    const auto First = OpenRow.begin() + rank(I) * Table.banksPerRank();
    const auto End = First + Table.banksPerRank();
    switch (I.What) {
    case Command::Activate:
      if (Row)
        return "opens a row of a bank that has one open";
      Row = I.Where.Row;
      if (Table.SecondActivateWithin)
        Half = I;
      break;
    case Command::Activate2:
      break;
    case Command::Precharge:
      if (!Row)
        return "closes a closed bank";
      Row.reset();
      break;
    case Command::Read:
    case Command::Write:
      if (Row != I.Where.Row)
        return "reaches for a row that is not open";
      break;
    case Command::PrechargeAll:
      std::fill(First, End, std::nullopt);
      break;
    case Command::Refresh:
      if (std::any_of(First, End, [](const auto &R) { return R.has_value(); }))
        return "refreshes a rank with an open row";
      break;
    case Command::RefreshBank:
      if (Row)
        return "refreshes an open bank";
      break;
    case Command::Count:
      return "is no command";
    }
    return {};
  }

  std::string buses(size_t Index) {
    const Issued &I = All[Index];
    const bool IsColumn = I.What == Command::Read || I.What == Command::Write;
    uint64_t &Taken = CommandBus[Table.HasColumnBus && IsColumn];
    if (I.At < Taken + Table.CommandTicks[size_t(I.What)])
      return "overlaps a command on the bus";
    Taken = I.At;
    if (!IsColumn)
      return {};
    const uint64_t Begin =
        I.At +
        (I.What == Command::Read ? Table.ReadLatency : Table.WriteLatency);
    if (Begin < DataBus)
      return "overlaps a burst on the data bus";
    DataBus = Begin + Table.BurstTicks;
    return {};
  }

  const TimingTable &Table;
  const std::vector<Issued> &All;
  std::vector<std::optional<uint32_t>> OpenRow;
  std::optional<Issued> Half; ///< an activation without its second half
  uint64_t Horizon = 0;
  std::array<uint64_t, 2> CommandBus{};
  uint64_t DataBus = 0;
};

} // namespace

std::string firstViolation(const TimingTable &Table,
                           const std::vector<Issued> &All) {
  Checker C(Table, All);
  for (size_t I = 0; I != All.size(); ++I)
    if (const std::string Bad = C.check(I); !Bad.empty())
      return fmt::format("command {}, {} at {} to bank {}, {}", I,
                         name(All[I].What), All[I].At, All[I].Where.Bank, Bad);
  return {};
}

} // namespace vorion::isasim::dram
