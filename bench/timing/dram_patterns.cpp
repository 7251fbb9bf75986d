/// Request patterns through one DRAM channel, as JSON; --help has the options.
/// bench/timing/dram.py and dram_ramulator.py compare with what other models
/// say.
///
/// Closed patterns: operations are issued in order; a read waits for one of the
/// pattern's read slots, a write for room in the write queue, and later ones
/// wait behind it. A read slot is free again when the line's last byte is
/// there. Open ones: a request comes at a given rate, whatever waits.
#include "timing/dram/AddressMap.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"
#include "vorion/support/Tool.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <deque>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <queue>

using namespace vorion;
using namespace vorion::isasim::dram;

namespace {

constexpr uint64_t LineBytes = 64;
constexpr uint64_t WriteSlots = 32;
constexpr uint64_t LinesOfRow = 32;
/// A row that is far away in the same bank, and one in another.
constexpr uint64_t SameBank = 61440 * LinesOfRow;
constexpr uint64_t OtherBank = SameBank + 4 * LinesOfRow;

struct Operation {
  uint64_t Line;
  bool IsWrite;
};
/// Operations 0, 1, 2, ... in turn.
using Sequence = std::function<Operation(uint64_t)>;

struct Pattern {
  std::string Name;
  uint32_t ReadSlots;
  Sequence At;
};

/// Marsaglia's xorshift of 64 bits.
class Random {
public:
  uint64_t operator()() {
    X ^= X << 13;
    X ^= X >> 7;
    X ^= X << 17;
    return X >> 20;
  }

private:
  uint64_t X = 0x9E3779B97F4A7C15;
};

/// Lines of 256 MiB; one in \p Every is written, none if that is 0.
Sequence randomLines(uint64_t Every) {
  return [Every, Draw = Random()](uint64_t I) mutable {
    return Operation{Draw() % (uint64_t{1} << 22),
                     Every != 0 && I % Every == Every - 1};
  };
}

/// Two streams in turn, the second \p Apart lines on.
Sequence twoStreams(uint64_t Apart, bool SecondWrites) {
  return [=](uint64_t I) {
    const bool IsSecond = I % 2 == 1;
    return Operation{I / 2 + (IsSecond ? Apart : 0), IsSecond && SecondWrites};
  };
}

/// \p Length consecutive lines from a random one on, again and again; one
/// burst in \p Every is written, none if that is 0.
Sequence shortBursts(uint64_t Length, uint64_t Every) {
  return [=, Draw = Random(), First = uint64_t{0}](uint64_t I) mutable {
    if (I % Length == 0)
      First = Draw() % (uint64_t{1} << 22);
    return Operation{First + I % Length,
                     Every != 0 && I / Length % Every == Every - 1};
  };
}

/// Nine lines in ten are of 16 rows, the others of 256 MiB; one in \p Every is
/// written, none if that is 0. Written lines go round the rows and columns, so
/// that no line is written twice while a controller may still hold it.
Sequence hotRows(uint64_t Every) {
  return [Every, Draw = Random()](uint64_t I) mutable {
    uint64_t Line = Draw() % (uint64_t{1} << 22);
    uint64_t Hot = Draw() % 160;
    if (Every != 0 && I % Every == Every - 1) {
      const uint64_t Written = I / Every;
      Line = Written;
      Hot = (Written + Written / LinesOfRow) % 16;
    }
    const uint64_t Row = Hot < 144 ? Hot % 16 * 37 : Line / LinesOfRow;
    return Operation{Row * LinesOfRow + Line % LinesOfRow,
                     Every != 0 && I % Every == Every - 1};
  };
}

/// A random row of bank 0 of eight: the digits of its number add up to it.
Operation rowOfBank0(uint64_t Number) {
  uint64_t Sum = 0;
  for (uint64_t Digits = Number; Digits; Digits /= 8)
    Sum += Digits % 8;
  return {LinesOfRow * (8 * Number + (8 - Sum % 8) % 8), false};
}

std::vector<Pattern> patterns() {
  std::vector<Pattern> All;
  for (const uint32_t Slots : {1U, 8U, 32U})
    All.push_back(
        {fmt::format("random_read_{}", Slots), Slots, randomLines(0)});
  All.push_back({"random_4_to_1", 32, randomLines(5)});
  All.push_back({"random_1_to_1", 32, randomLines(2)});
  All.push_back(
      {"stream_read", 32, [](uint64_t I) { return Operation{I, false}; }});
  All.push_back(
      {"stream_write", 32, [](uint64_t I) { return Operation{I, true}; }});
  All.push_back({"stream_1_to_1", 32, twoStreams(OtherBank, true)});
  All.push_back({"row_stride", 32,
                 [](uint64_t I) { return Operation{LinesOfRow * I, false}; }});
  All.push_back({"two_streams_same_bank", 32, twoStreams(SameBank, false)});
  All.push_back({"two_streams_other_bank", 32, twoStreams(OtherBank, false)});
  All.push_back({"ping_pong", 1, [](uint64_t I) {
                   return Operation{I / 2 % LinesOfRow + (I % 2 ? SameBank : 0),
                                    false};
                 }});
  All.push_back({"one_bank_random", 32, [Draw = Random()](uint64_t) mutable {
                   return rowOfBank0(Draw() % 8192);
                 }});
  for (const uint64_t Length : {2U, 4U, 8U})
    All.push_back(
        {fmt::format("bursts_of_{}", Length), 32, shortBursts(Length, 0)});
  All.push_back({"bursts_of_4_3_to_1", 32, shortBursts(4, 4)});
  All.push_back({"hot_rows", 32, hotRows(0)});
  All.push_back({"hot_rows_3_to_1", 32, hotRows(4)});
  All.push_back({"random_9_to_1", 32, randomLines(10)});
  All.push_back({"random_2_to_1", 32, randomLines(3)});
  All.push_back({"random_2_to_1_8", 8, randomLines(3)});
  return All;
}

/// What runs are made with.
struct Setup {
  TimingTable Table;
  ControllerOptions Options;
  AddressMap Map;
  uint64_t Requests = 100000;
  uint64_t Front = 0; ///< ticks from issue to the controller
};

/// One run: a channel, and who waits for it.
class Run {
public:
  explicit Run(const Setup &SIn)
      : S(SIn), Decode(S.Map, S.Table), Channel(S.Table, S.Options),
        LinesOfWriteQueue(Channel.room(true)) {}

  /// Writes what would be issued into \p List, and runs nothing.
  void listTo(std::string &List) { Listed = &List; }
  void closed(const Pattern &P);
  /// Random reads at \p Load of the peak bandwidth, times as of a Poisson
  /// process.
  void open(double Load);

  nlohmann::ordered_json json() const;

private:
  struct Sent {
    uint64_t At, Id;
    Operation What;
  };
  /// A line of a list of requests (--list).
  void list(uint64_t At, const Operation &O);
  void submit(uint64_t At, uint64_t Id, const Operation &O) {
    const Location L = Decode(O.Line * LineBytes);
    Channel.submit({At, Id, O.Line, L.Where, O.IsWrite});
  }
  void advance(uint64_t Until);

  const Setup &S;
  AddressDecoder Decode;
  Controller Channel;
  const uint64_t LinesOfWriteQueue;
  std::vector<uint64_t> IssuedAt; ///< by request
  std::vector<Reply> Replies;     ///< of the last advance()
  std::vector<uint64_t> Latencies;
  uint64_t End = 0;
  std::string *Listed = nullptr;
};

void Run::list(uint64_t At, const Operation &O) {
  const Location L = Decode(O.Line * LineBytes);
  *Listed +=
      fmt::format("{} {} {} {} {} {} {}\n", At, O.IsWrite ? 1 : 0, O.Line,
                  L.Where.Bank / S.Table.BanksPerGroup,
                  L.Where.Bank % S.Table.BanksPerGroup, L.Where.Row, L.Column);
}

void Run::advance(uint64_t Until) {
  Replies.clear();
  Channel.advance(Until, Replies);
  for (const Reply &R : Replies) {
    End = std::max(End, R.Done);
    if (!R.IsWrite)
      Latencies.push_back(R.Done - IssuedAt[R.Id]);
  }
}

void Run::closed(const Pattern &P) {
  std::priority_queue<uint64_t, std::vector<uint64_t>, std::greater<>> Busy;
  std::deque<Sent> Front;
  uint64_t ReadsOut = 0;
  uint64_t WritesInFront = 0;
  Sequence Next = P.At;
  if (Listed) {
    *Listed += fmt::format("{} {} {}\n", P.Name, P.ReadSlots, WriteSlots);
    for (uint64_t I = 0; I != S.Requests; ++I)
      list(0, Next(I));
    return;
  }
  Operation O = Next(0);
  const auto HasSlot = [&] {
    if (!O.IsWrite)
      return ReadsOut < P.ReadSlots;
    const uint64_t InQueue = LinesOfWriteQueue - Channel.room(true);
    return WritesInFront + InQueue < WriteSlots;
  };
  for (uint64_t Now = 0; Now != Never;) {
    for (; !Busy.empty() && Busy.top() <= Now; Busy.pop())
      --ReadsOut;
    const auto HandOver = [&] {
      for (; !Front.empty() && Front.front().At <= Now &&
             Channel.room(Front.front().What.IsWrite) != 0;
           Front.pop_front()) {
        submit(Now, Front.front().Id, Front.front().What);
        WritesInFront -= Front.front().What.IsWrite;
      }
    };
    HandOver();
    while (IssuedAt.size() != S.Requests && HasSlot()) {
      Front.push_back({Now + S.Front, IssuedAt.size(), O});
      IssuedAt.push_back(Now);
      ++(O.IsWrite ? WritesInFront : ReadsOut);
      O = Next(IssuedAt.size());
      HandOver();
    }
    uint64_t Then = Channel.nextEvent();
    if (!Busy.empty())
      Then = std::min(Then, Busy.top());
    if (!Front.empty() && Front.front().At > Now)
      Then = std::min(Then, Front.front().At);
    Now = Then;
    if (Now == Never)
      break;
    advance(Now);
    for (const Reply &R : Replies)
      if (!R.IsWrite)
        Busy.push(R.Done);
  }
}

void Run::open(double Load) {
  const double Gap =
      LineBytes / (Load * S.Table.peakBandwidth() * S.Table.TickPs / 1000);
  Sequence Lines = randomLines(0);
  Random Times;
  double At = 0;
  if (Listed) // no more than fit wait
    *Listed +=
        fmt::format("{:.0f} {} {}\n", 100 * Load, S.Requests, S.Requests);
  for (uint64_t I = 0; I != S.Requests; ++I) {
    constexpr uint64_t Steps = uint64_t{1} << 32;
    At -= Gap * std::log(static_cast<double>(Times() % Steps + 1) /
                         static_cast<double>(Steps));
    const auto Tick = static_cast<uint64_t>(At);
    if (Listed) {
      list(Tick, Lines(I));
      continue;
    }
    IssuedAt.push_back(Tick);
    submit(Tick + S.Front, I, Lines(I));
    advance(Tick);
  }
  while (Channel.nextEvent() != Never)
    advance(Channel.nextEvent());
}

nlohmann::ordered_json Run::json() const {
  const double NsOfTick = S.Table.TickPs / 1000.0;
  const double Ns = static_cast<double>(End) * NsOfTick;
  std::vector<uint64_t> Sorted = Latencies;
  std::ranges::sort(Sorted);
  const uint64_t Sum = std::accumulate(Sorted.begin(), Sorted.end(), 0ULL);
  const auto Reads = static_cast<double>(Sorted.size());
  const ControllerCounts &C = Channel.counts();
  nlohmann::ordered_json J = {
      {"ticks", End},
      {"ns", Ns},
      {"gb_s", static_cast<double>(S.Requests * LineBytes) / Ns},
      {"mean_read_ns", nullptr},
      {"read_95_ns", nullptr},
      {"row_hits", C.RowHits},
      {"row_misses", C.RowMisses},
      {"row_conflicts", C.RowConflicts},
      {"activations", C.Activations},
      {"refreshes", C.Refreshes},
      {"forwarded", C.Forwarded}};
  if (!Sorted.empty()) {
    J["mean_read_ns"] = static_cast<double>(Sum) / Reads * NsOfTick;
    J["read_95_ns"] =
        static_cast<double>(Sorted[Sorted.size() * 95 / 100]) * NsOfTick;
  }
  return J;
}

int run(int Argc, char **Argv) {
  CLI::App App("Request patterns through one DRAM channel, as JSON.",
               "dram_patterns");
  std::string Standard = "ramulator-lpddr4";
  std::string Map = "digit_sum";
  std::string Only;
  uint32_t Queue = 64;
  double FrontNs = 0;
  std::string List;
  Setup S;
  App.add_option("--standard", Standard, "a standard, or a table's file");
  App.add_option("--map", Map, "address map");
  App.add_option("--queue", Queue, "bursts of each queue");
  App.add_option("--front-ns", FrontNs, "from issue to the controller");
  App.add_option("--requests", S.Requests, "of each pattern");
  App.add_option("--only", Only, "one pattern");
  App.add_option("--list", List,
                 "write each pattern's requests into this folder, as "
                 "PATTERN: a line with its name, read and write slots; then a "
                 "line a request: tick, 1 for a write, line, bank group, bank, "
                 "row, column");
  App.add_option("--cap", S.Options.RowHitCap,
                 "accesses beyond the first that have precedence");
  App.add_flag_callback(
      "--by-bank",
      [&S] { S.Options.Refresh = ControllerOptions::RefreshBy::Bank; },
      "refresh bank by bank");
  if (const auto Exit = parseCommandLine(
          App, std::vector<std::string>(Argv + 1, Argv + Argc)))
    return *Exit;
  const auto Fail = [](const Error &E) {
    return reportError("dram_patterns", E);
  };
  auto Table = Standard.ends_with(".json") ? readTimingTable(Standard)
                                           : standardTable(Standard);
  if (!Table)
    return Fail(Table.error());
  S.Table = *Table;
  S.Options.ReadQueue = S.Options.WriteQueue = Queue;
  S.Front = static_cast<uint64_t>(FrontNs * 1000 / S.Table.TickPs);
  if (const auto Good = check(S.Table, S.Options); !Good)
    return Fail(Good.error());
  auto Chosen = addressMap(Map, S.Table, 1, LineBytes);
  if (!Chosen)
    return Fail(Chosen.error());
  S.Map = *Chosen;

  nlohmann::ordered_json Closed = nlohmann::ordered_json::object();
  nlohmann::ordered_json Open = nlohmann::ordered_json::object();
  if (!List.empty()) {
    const auto Write = [&](const std::string &Name,
                           const std::function<void(Run &)> &Body) {
      Run R(S);
      std::string Text;
      R.listTo(Text);
      Body(R);
      return writeFileAtomically(List + "/" + Name, Text);
    };
    for (const Pattern &P : patterns())
      if (const auto Good = Write(P.Name, [&P](Run &R) { R.closed(P); }); !Good)
        return Fail(Good.error());
    for (int Percent = 10; Percent <= 90; Percent += 10)
      if (const auto Good =
              Write(fmt::format("{}", Percent),
                    [Percent](Run &R) { R.open(Percent / 100.0); });
          !Good)
        return Fail(Good.error());
    return 0;
  }
  const auto Measure = [&S](const std::function<void(Run &)> &Body) {
    Run R(S);
    const std::clock_t Begin = std::clock();
    Body(R);
    const double Seconds =
        static_cast<double>(std::clock() - Begin) / CLOCKS_PER_SEC;
    nlohmann::ordered_json J = R.json();
    J["host_ns"] = Seconds * 1e9 / static_cast<double>(S.Requests);
    return J;
  };
  for (const Pattern &P : patterns())
    if (Only.empty() || Only == P.Name)
      Closed[P.Name] = Measure([&P](Run &R) { R.closed(P); });
  for (int Percent = 10; Percent <= 90; Percent += 10)
    if (const auto Name = fmt::format("{}", Percent);
        Only.empty() || Only == Name)
      Open[Name] = Measure([Percent](Run &R) { R.open(Percent / 100.0); });
  const nlohmann::ordered_json All = {{"standard", S.Table.Standard},
                                      {"map", Map},
                                      {"queue", Queue},
                                      {"front_ns", FrontNs},
                                      {"requests", S.Requests},
                                      {"closed", Closed},
                                      {"open_per_cent", Open}};
  fmt::print("{}\n", jsonText(All, 1));
  return 0;
}

} // namespace

int main(int Argc, char **Argv) {
  return runTool("dram_patterns", [=] { return run(Argc, Argv); });
}
