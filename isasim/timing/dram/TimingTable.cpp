#include "timing/dram/TimingTable.h"

#include "timing/dram/Standards.h"
#include "vorion/support/File.h"
#include "vorion/support/Hash.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>

namespace vorion::isasim::dram {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, Commands> CommandNames = {
    "ACT", "PRE", "PREA", "RD", "WR", "REF", "REFPB", "ACT2"};
constexpr std::array<std::string_view, size_t(Scope::Count)> ScopeNames = {
    "bank", "bank_group", "rank", "channel", "other_ranks"};

/// The longest time that a table may name: a second of the fastest clock is
/// no constraint of any device.
constexpr uint32_t MostTicks = 1U << 24;
/// A request is for a line, which lies in one row.
constexpr uint32_t LineBytes = 64;
/// Banks of a channel: a controller keeps them in the bits of a word.
constexpr uint32_t MostBanks = 64;

template <typename Kind, size_t N>
Expected<Kind> parseName(std::string_view Text,
                         const std::array<std::string_view, N> &Names,
                         const std::string &Key) {
  const auto Found = std::ranges::find(Names, Text);
  if (Found == Names.end())
    return Error{"", fmt::format("key {} is \"{}\", expected one of {}{}", Key,
                                 Text, fmt::join(Names, ", "),
                                 didYouMean(Text, Names))};
  return static_cast<Kind>(Found - Names.begin());
}

/// Whether the command concerns a rank as a whole.
bool isOfRank(Command C) {
  return C == Command::PrechargeAll || C == Command::Refresh;
}

JsonShape tableShape() {
  const JsonShape Ticks = JsonShape::text();
  const JsonShape Power = JsonShape::whole(1, 1U << 30);
  return JsonShape::object(
             {
                 {"standard", JsonShape::text()},
                 {"source", JsonShape::text()},
                 {"tick_ps", JsonShape::whole(1, 1000000)},
                 {"ranks", Power},
                 {"bank_groups", Power},
                 {"banks_per_group", Power},
                 {"rows", Power},
                 {"row_bytes", Power},
                 {"burst_bytes", Power},
                 {"values", JsonShape::anything()},
                 {"read_latency", Ticks},
                 {"write_latency", Ticks},
                 {"burst", Ticks},
                 {"refresh_interval", Ticks},
                 {"bank_refresh_interval", Ticks, false},
                 {"command_ticks", JsonShape::anything(), false},
                 {"second_activate", Ticks, false},
                 {"column_bus", JsonShape::boolean(), false},
                 {"constraints",
                  JsonShape::list(
                      JsonShape::object(
                          {{"from", JsonShape::text()},
                           {"to", JsonShape::text()},
                           {"scope", JsonShape::text()},
                           {"ticks", Ticks},
                           {"window", JsonShape::whole(2, 8), false}})
                          .closed())},
             })
      .closed();
}

/// Reads one table. The members return false once Problem is set.
class Reader {
public:
  Reader(const Json &Document, TimingTable &Table)
      : Document(Document), Table(Table) {}
  std::string Problem;

  bool read() {
    return readValues() && readDevice() && readCommandTicks() &&
           readConstraints() && checkPresent() && checkPossible() &&
           checkActivate();
  }

private:
  using C = Command;

  bool fail(std::string Text) {
    Problem = std::move(Text);
    return false;
  }

  bool readValues() {
    if (!Document["values"].is_object())
      return fail(
          "key values is not an object, expected one of [ticks, source]");
    for (const auto &[Name, Value] : Document["values"].items()) {
      if (!Value.is_array() || Value.size() != 2 ||
          !Value[0].is_number_unsigned() || Value[0] > MostTicks ||
          !Value[1].is_string())
        return fail(fmt::format("key values.{} is {}, expected [ticks, source]",
                                Name, jsonText(Value)));
      Values[Name] = Value[0];
    }
    return true;
  }

  /// A sum of values and whole numbers: "nCWL + nBL + 1".
  bool sum(const std::string &Text, const std::string &Key, uint32_t &Result) {
    int64_t Sum = 0;
    int Sign = 1;
    bool WantsTerm = true;
    for (size_t At = 0; At != Text.size();) {
      const size_t End = std::min(Text.find(' ', At), Text.size());
      const std::string_view Word(Text.data() + At, End - At);
      At = std::min(End + 1, Text.size());
      if (Word.empty())
        continue;
      if (!WantsTerm) {
        if (Word != "+" && Word != "-")
          return fail(fmt::format("key {} is \"{}\", expected + or - between "
                                  "its terms",
                                  Key, Text));
        Sign = Word == "+" ? 1 : -1;
        WantsTerm = true;
        continue;
      }
      uint32_t Number = 0;
      const auto [Rest, Bad] =
          std::from_chars(Word.data(), Word.data() + Word.size(), Number);
      if (Bad != std::errc() || Rest != Word.data() + Word.size()) {
        const auto Found = Values.find(Word);
        if (Found == Values.end())
          return fail(
              fmt::format("key {} uses {}, which is not in values", Key, Word));
        Number = Found->second;
      }
      Sum += Sign * int64_t{Number};
      WantsTerm = false;
    }
    if (WantsTerm)
      return fail(
          fmt::format("key {} is \"{}\", expected a sum of values", Key, Text));
    if (Sum < 1 || Sum > MostTicks)
      return fail(fmt::format("key {} is {} ticks, expected 1 to {}", Key, Sum,
                              MostTicks));
    Result = static_cast<uint32_t>(Sum);
    return true;
  }

  bool sum(const char *Key, uint32_t &Result) {
    return sum(Document[Key].get<std::string>(), Key, Result);
  }

  bool readDevice() {
    Table.Standard = Document["standard"];
    Table.TickPs = Document["tick_ps"];
    struct Size {
      const char *Key;
      uint32_t &Value;
    };
    for (const Size &S :
         {Size{"ranks", Table.Ranks}, Size{"bank_groups", Table.BankGroups},
          Size{"banks_per_group", Table.BanksPerGroup},
          Size{"rows", Table.Rows}, Size{"row_bytes", Table.RowBytes},
          Size{"burst_bytes", Table.BurstBytes}}) {
      S.Value = Document[S.Key];
      if (!std::has_single_bit(S.Value))
        return fail(fmt::format("key {} is {}, expected a power of two", S.Key,
                                S.Value));
    }
    if (uint64_t{Table.Ranks} * Table.BankGroups * Table.BanksPerGroup >
        MostBanks)
      return fail(fmt::format("key banks_per_group makes {} banks of a "
                              "channel, expected at most {}",
                              uint64_t{Table.Ranks} * Table.BankGroups *
                                  Table.BanksPerGroup,
                              MostBanks));
    if (Table.RowBytes < LineBytes)
      return fail(fmt::format("key row_bytes is {}, expected at least a line's "
                              "{}",
                              Table.RowBytes, LineBytes));
    if (Table.BurstBytes > Table.RowBytes)
      return fail(fmt::format("key burst_bytes is {}, expected at most a row's "
                              "{}",
                              Table.BurstBytes, Table.RowBytes));
    Table.HasColumnBus = Document.value("column_bus", false);
    return sum("read_latency", Table.ReadLatency) &&
           sum("write_latency", Table.WriteLatency) &&
           sum("burst", Table.BurstTicks) &&
           sum("refresh_interval", Table.RefreshInterval) &&
           (!Document.contains("bank_refresh_interval") ||
            sum("bank_refresh_interval", Table.BankRefreshInterval)) &&
           (!Document.contains("second_activate") ||
            sum("second_activate", Table.SecondActivateWithin));
  }

  bool readCommandTicks() {
    Table.CommandTicks.fill(1);
    if (!Document.contains("command_ticks"))
      return true;
    if (!Document["command_ticks"].is_object())
      return fail(
          "key command_ticks is not an object, expected ticks by command");
    for (const auto &[Name, Value] : Document["command_ticks"].items()) {
      const std::string Key = "command_ticks." + Name;
      const auto Which = parseName<Command>(Name, CommandNames, Key);
      if (!Which)
        return fail(Which.error().What);
      if (!Value.is_number_unsigned() || Value < 1U || Value > 64U)
        return fail(fmt::format("key {} is {}, expected 1 to 64", Key,
                                jsonText(Value)));
      Table.CommandTicks[size_t(*Which)] = Value;
    }
    return true;
  }

  bool readConstraints() {
    size_t Index = 0;
    for (const Json &Row : Document["constraints"]) {
      const std::string Key = fmt::format("constraints[{}]", Index++);
      const auto From = parseName<Command>(Row["from"].get<std::string>(),
                                           CommandNames, Key + ".from");
      const auto To = parseName<Command>(Row["to"].get<std::string>(),
                                         CommandNames, Key + ".to");
      const auto Within = parseName<Scope>(Row["scope"].get<std::string>(),
                                           ScopeNames, Key + ".scope");
      if (!From || !To || !Within)
        return fail((!From ? From.error()
                     : !To ? To.error()
                           : Within.error())
                        .What);
      Constraint New{*From, *To, *Within, 0, Row.value("window", 1U)};
      if (!sum(Row["ticks"], Key + ".ticks", New.Ticks))
        return false;
      const bool IsOfBank =
          New.Within == Scope::Bank || New.Within == Scope::BankGroup;
      if (IsOfBank && (isOfRank(New.From) || isOfRank(New.To)))
        return fail(fmt::format("key {}.scope is {}, expected rank: {} and {} "
                                "do not both name a bank",
                                Key, name(New.Within), name(New.From),
                                name(New.To)));
      if (New.Window != 1 &&
          (New.From != C::Activate || New.To != C::Activate ||
           New.Within != Scope::Rank))
        return fail(fmt::format("key {}.window is of {} to {}, expected ACT to "
                                "ACT of a rank",
                                Key, name(New.From), name(New.To)));
      for (const Constraint &Old : Table.Constraints)
        if (Old.From == New.From && Old.To == New.To &&
            Old.Within == New.Within && Old.Window == New.Window)
          return fail(fmt::format("duplicate key {}: {} to {} of the same {}",
                                  Key, name(New.From), name(New.To),
                                  name(New.Within)));
      Table.Constraints.push_back(New);
    }
    return true;
  }

  /// What a device without the constraint would not survive.
  bool checkPresent() {
    struct Need {
      Command From, To;
    };
    static constexpr Need Always[] = {{C::Activate, C::Read},
                                      {C::Activate, C::Write},
                                      {C::Activate, C::Precharge},
                                      {C::Activate, C::Activate},
                                      {C::Activate, C::PrechargeAll},
                                      {C::Read, C::Read},
                                      {C::Read, C::Write},
                                      {C::Read, C::Precharge},
                                      {C::Read, C::PrechargeAll},
                                      {C::Write, C::Write},
                                      {C::Write, C::Read},
                                      {C::Write, C::Precharge},
                                      {C::Write, C::PrechargeAll},
                                      {C::Precharge, C::Activate},
                                      {C::Precharge, C::Refresh},
                                      {C::PrechargeAll, C::Activate},
                                      {C::PrechargeAll, C::Refresh},
                                      {C::Refresh, C::Activate},
                                      {C::Refresh, C::Refresh}};
    static constexpr Need ByBank[] = {
        {C::Precharge, C::RefreshBank}, {C::PrechargeAll, C::RefreshBank},
        {C::RefreshBank, C::Activate},  {C::RefreshBank, C::RefreshBank},
        {C::RefreshBank, C::Refresh},   {C::Refresh, C::RefreshBank}};
    const auto IsMet = [this](const Need &N) {
      return Table.sameBank(N.From, N.To) != 0 ||
             fail(fmt::format("key constraints has no {} to {}", name(N.From),
                              name(N.To)));
    };
    const auto Has = [this](Command From, Command To, Scope Within,
                            bool IsWindow) {
      return std::ranges::any_of(Table.Constraints, [&](const Constraint &K) {
        return K.From == From && K.To == To && K.Within == Within &&
               (K.Window != 1) == IsWindow;
      });
    };
    if (!std::ranges::all_of(Always, IsMet) ||
        (Table.BankRefreshInterval && !std::ranges::all_of(ByBank, IsMet)))
      return false;
    if (!Has(C::Activate, C::Activate, Scope::Bank, false))
      return fail("key constraints has no ACT to ACT of a bank (tRC)");
    if (!Has(C::Activate, C::Activate, Scope::Rank, false))
      return fail("key constraints has no ACT to ACT of a rank (tRRD)");
    if (!Has(C::Activate, C::Activate, Scope::Rank, true))
      return fail("key constraints has no ACT to ACT with a window (tFAW)");
    if (Table.Ranks > 1 && !Has(C::Read, C::Read, Scope::OtherRanks, false))
      return fail("key constraints has no RD to RD of other_ranks");
    return true;
  }

  bool atLeast(Command From, Command To, uint32_t Least, const char *Why) {
    const uint32_t Is = Table.sameBank(From, To);
    return Is >= Least ||
           fail(fmt::format("key constraints says {} to {} is {} ticks, "
                            "expected at least {}: {}",
                            name(From), name(To), Is, Least, Why));
  }

  /// What no device can do.
  bool checkPossible() {
    // Any two banks share the data bus.
    const auto OfAnyBanks = [this](Command Column) {
      uint32_t Ticks = 0;
      for (const Constraint &K : Table.Constraints)
        if (K.From == Column && K.To == Column &&
            (K.Within == Scope::Channel || K.Within == Scope::Rank))
          Ticks = std::max(Ticks, K.Ticks);
      return Ticks;
    };
    for (const Command Column : {C::Read, C::Write})
      if (OfAnyBanks(Column) < Table.BurstTicks)
        return fail(fmt::format("key constraints says {0} to {0} of any banks "
                                "is {1} ticks, expected at least {2}: the data "
                                "bus is taken",
                                name(Column), OfAnyBanks(Column),
                                Table.BurstTicks));
    const uint32_t ReadEnd = Table.ReadLatency + Table.BurstTicks;
    const uint32_t WriteEnd = Table.WriteLatency + Table.BurstTicks;
    const auto Rest = [](uint32_t End, uint32_t Latency) {
      return End > Latency ? End - Latency : 1;
    };
    if (!atLeast(C::Read, C::Write, Rest(ReadEnd, Table.WriteLatency),
                 "the data bus is taken") ||
        !atLeast(C::Write, C::Read, Rest(WriteEnd, Table.ReadLatency),
                 "the data bus is taken") ||
        !atLeast(C::Write, C::Precharge, WriteEnd,
                 "the data are not written") ||
        !atLeast(C::Activate, C::Precharge,
                 Table.sameBank(C::Activate, C::Read), "the row is not open"))
      return false;
    // A shorter one is implied, so that whoever wrote it meant another.
    if (!atLeast(C::Activate, C::Activate,
                 Table.sameBank(C::Activate, C::Precharge) +
                     Table.sameBank(C::Precharge, C::Activate),
                 "ACT to PRE and PRE to ACT"))
      return false;
    if (Table.RefreshInterval <= Table.sameBank(C::Refresh, C::Activate))
      return fail(fmt::format("key refresh_interval is {} ticks, expected more "
                              "than the {} of a refresh",
                              Table.RefreshInterval,
                              Table.sameBank(C::Refresh, C::Activate)));
    if (Table.BankRefreshInterval &&
        Table.BankRefreshInterval <=
            Table.sameBank(C::RefreshBank, C::RefreshBank))
      return fail(fmt::format("key bank_refresh_interval is {} ticks, expected "
                              "more than the {} of a refresh",
                              Table.BankRefreshInterval,
                              Table.sameBank(C::RefreshBank, C::RefreshBank)));
    return true;
  }

  /// Both halves of an activation are there before its row is used.
  bool checkActivate() {
    const uint32_t Within = Table.SecondActivateWithin;
    if (Within == 0) {
      for (const Constraint &K : Table.Constraints)
        if (K.From == C::Activate2 || K.To == C::Activate2)
          return fail("key constraints names ACT2, expected second_activate, "
                      "the ticks in which it follows");
      return true;
    }
    for (const Command Column : {C::Read, C::Write})
      if (const uint32_t Opened = Table.sameBank(C::Activate, Column);
          Within >= Opened)
        return fail(fmt::format("key second_activate is {} ticks, expected "
                                "fewer than the {} of ACT to {}",
                                Within, Opened, name(Column)));
      else if (Table.CommandTicks[size_t(Column)] != 1)
        return fail(fmt::format("key command_ticks.{} is {}, expected 1 with "
                                "second_activate: the second half has its tick",
                                name(Column),
                                Table.CommandTicks[size_t(Column)]));
    return true;
  }

  const Json &Document;
  TimingTable &Table;
  std::map<std::string, uint32_t, std::less<>> Values;
};

} // namespace

std::string_view name(Command C) { return CommandNames[size_t(C)]; }
std::string_view name(Scope S) { return ScopeNames[size_t(S)]; }

double TimingTable::peakBandwidth() const {
  return BurstBytes / (static_cast<double>(BurstTicks) * TickPs / 1000);
}

uint32_t TimingTable::sameBank(Command From, Command To) const {
  uint32_t Ticks = 0;
  for (const Constraint &K : Constraints)
    if (K.From == From && K.To == To && K.Window == 1 &&
        K.Within != Scope::OtherRanks)
      Ticks = std::max(Ticks, K.Ticks);
  return Ticks;
}

Expected<TimingTable> parseTimingTable(std::string_view Text,
                                       const std::string &Where) {
  const Expected<Json> J = parseJson<Json>(Text, Where, "a DRAM timing table");
  if (!J)
    return J.error();
  if (const auto Shaped = tableShape().check(*J, Where); !Shaped)
    return Shaped.error();
  TimingTable T;
  Reader R(*J, T);
  if (!R.read())
    return Error{Where, R.Problem};
  T.Hash = fnv1a64(Text);
  return T;
}

Expected<TimingTable> readTimingTable(const std::string &Path) {
  const auto Bytes = readRegularFile(Path);
  if (!Bytes)
    return Bytes.error();
  return parseTimingTable(
      {reinterpret_cast<const char *>(Bytes->data()), Bytes->size()}, Path);
}

std::string_view reportName(std::string_view Standard) {
  const auto Known = std::ranges::find(standards(), Standard);
  return Known == standards().end() ? "of a file" : *Known;
}

Expected<TimingTable> standardTable(std::string_view Name) {
  const std::string_view Text = standardText(Name);
  if (Text.empty()) {
    const std::vector<std::string> Known(standards().begin(),
                                         standards().end());
    return Error{
        "",
        fmt::format("\"{}\" is not a DRAM standard, expected one of {}{}", Name,
                    fmt::join(Known, ", "), didYouMean(Name, Known)),
        ExitCode::Usage};
  }
  return parseTimingTable(Text, std::string(Name));
}

} // namespace vorion::isasim::dram
