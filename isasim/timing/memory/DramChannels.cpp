#include "timing/memory/DramChannels.h"

#include "timing/common/Turn.h"
#include "timing/memory/MemoryWatch.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::isasim {

namespace {

/// By the number of a ControllerOptions::RefreshBy.
constexpr std::array<std::string_view, 3> RefreshNames = {"rank", "bank",
                                                          "none"};

/// An answer's id: which request it is, and below that the cache's miss.
constexpr unsigned MissBits = 16;

} // namespace

bool isTableFile(std::string_view Standard) {
  return Standard.ends_with(".json");
}

Expected<DramSetup> setUpDram(const DramTiming &P) {
  const auto Fail = [](std::string_view Key, std::string_view Text) {
    return Error{"configuration", fmt::format("timing.dram.{}: {}", Key, Text),
                 ExitCode::Usage};
  };
  const bool IsFile = isTableFile(P.Standard);
  auto Table = IsFile ? dram::readTimingTable(P.Standard)
                      : dram::standardTable(P.Standard);
  if (!Table)
    return Fail("standard", IsFile ? fmt::format("{}: {}", Table.error().Where,
                                                 Table.error().What)
                                   : Table.error().What);
  for (const auto &[Key, Value] :
       {std::pair{"channels", P.Channels}, {"channel_bytes", P.ChannelBytes}})
    if (!std::has_single_bit(Value))
      return Fail(Key, fmt::format("{}, expected a power of two", Value));
  auto Map = dram::addressMap(P.AddressMap, *Table, P.Channels, P.ChannelBytes);
  if (!Map)
    return Fail("address_map", Map.error().What);
  const auto Refresh = std::ranges::find(RefreshNames, P.Refresh);
  if (Refresh == RefreshNames.end())
    return Fail("refresh", fmt::format("\"{}\", expected one of {}{}",
                                       P.Refresh, fmt::join(RefreshNames, ", "),
                                       didYouMean(P.Refresh, RefreshNames)));
  const dram::ControllerOptions Options{
      .LineBytes = TimingLineBytes,
      .ReadQueue = P.ReadQueue,
      .WriteQueue = P.WriteQueue,
      .DrainAbove = P.DrainAbove,
      .DrainBelow = P.DrainBelow,
      .MostDrained = P.MostDrained,
      .RowHitCap = P.RowHitCap,
      .Refresh = static_cast<dram::ControllerOptions::RefreshBy>(
          Refresh - RefreshNames.begin())};
  if (const auto Good = check(*Table, Options); !Good)
    return Error{"configuration",
                 fmt::format("timing.dram: {}", Good.error().What),
                 ExitCode::Usage};
  return DramSetup{std::move(*Table), std::move(*Map), Options};
}

DramChannels::DramChannels(const DramTiming &Params, uint32_t Mhz)
    : Setup(*setUpDram(Params)),
      TableFile(isTableFile(Params.Standard) ? Params.Standard : ""),
      Decode(Setup.Map, Setup.Table), Tick(uint64_t{Mhz} * Setup.Table.TickPs),
      ByTick(Tick), FrontTicks(Params.ControllerPs / 2 / Setup.Table.TickPs),
      BackTicks(Params.ControllerPs / Setup.Table.TickPs - FrontTicks),
      NextEvent(Turn::Never) {
  const auto Make = pluggedPolicies().Dram;
  for (uint32_t N = 0; N != Params.Channels; ++N)
    Channels.push_back(
        {dram::Controller(
             Setup.Table, Setup.Options,
             Make ? Make({N, Setup.Table.banks(), Setup.Table.BanksPerGroup})
                  : nullptr),
         dram::Never,
         {}});
}

void DramChannels::watch(const MemoryWatch *Observers) {
  Watch = Observers;
  for (Channel &C : Channels)
    C.Control.record(Watch ? &C.Log : nullptr);
}

/// What has been issued since the last time.
void DramChannels::tellCommands() {
  for (unsigned Number = 0; Number != Channels.size(); ++Number) {
    std::vector<dram::Issued> &Log = Channels[Number].Log;
    for (const dram::Issued &I : Log) {
      CycleSpan Data;
      if (I.What == dram::Command::Read || I.What == dram::Command::Write) {
        const uint64_t First =
            I.At + (I.What == dram::Command::Read ? Setup.Table.ReadLatency
                                                  : Setup.Table.WriteLatency);
        Data = {cycleOf(First), cycleOf(First + Setup.Table.BurstTicks)};
      }
      Watch->dramCommand(Number, I, Data);
    }
    Log.clear();
  }
}

std::optional<uint64_t> DramChannels::fetch(uint64_t Now, uint32_t Address,
                                            bool /*Keep*/, uint32_t Miss) {
  submit(Now, Address, Miss, false);
  return std::nullopt;
}

void DramChannels::writeBack(uint64_t Now, uint32_t Address) {
  submit(Now, Address, 0, true);
}

void DramChannels::submit(uint64_t Now, uint32_t Address, uint64_t Miss,
                          bool IsWrite) {
  const dram::Location Where = Decode(Address);
  Channel &C = Channels[Where.Channel];
  if (Watch)
    Watch->dramRequest(Where.Channel, Address, IsWrite);
  // A core whose place in the order was guessed may be late.
  C.Control.submit({.At = std::max(tickOf(Now) + FrontTicks, AdvancedTo),
                    .Id = Submitted++ << MissBits | Miss,
                    .Line = Address / TimingLineBytes,
                    .Where = Where.Where,
                    .IsWrite = IsWrite});
  C.NextEvent = C.Control.nextEvent();
  NextEvent = std::min(NextEvent, cycleOf(C.NextEvent));
}

void DramChannels::advance(uint64_t Until, std::vector<Fill> &Fills) {
  const uint64_t Limit = Until == Turn::Never ? dram::Never : tickOf(Until);
  Replies.clear();
  uint64_t First = dram::Never;
  for (;;) {
    First = dram::Never;
    for (const Channel &C : Channels)
      First = std::min(First, C.NextEvent);
    if (!Replies.empty() || First == dram::Never || First > Limit)
      break;
    // What is decided now is known above so many ticks later, so that nothing
    // that follows from it is sent down before.
    AdvancedTo = std::max(AdvancedTo, std::min(Limit, First + BackTicks));
    for (Channel &C : Channels)
      if (C.NextEvent <= AdvancedTo) {
        C.Control.advance(AdvancedTo, Replies);
        C.NextEvent = C.Control.nextEvent();
      }
    std::erase_if(Replies, [](const dram::Reply &R) { return R.IsWrite; });
  }
  if (Watch)
    tellCommands();
  NextEvent = First == dram::Never ? Turn::Never : cycleOf(First);
  std::ranges::sort(Replies, {}, [](const dram::Reply &R) {
    return std::pair(R.Decided, R.Id);
  });
  for (const dram::Reply &R : Replies)
    Fills.emplace_back(static_cast<uint32_t>(R.Id % (uint64_t{1} << MissBits)),
                       cycleOf(R.Done + BackTicks));
}

void DramChannels::idleUntil(uint64_t Until) {
  AdvancedTo = std::max(AdvancedTo, tickOf(Until));
  Replies.clear();
  for (Channel &C : Channels)
    if (C.NextEvent == dram::Never)
      C.Control.advance(AdvancedTo, Replies);
  assert(Replies.empty() && "an idle channel has no requests");
  if (Watch)
    tellCommands();
}

DramTime DramChannels::time() const {
  DramTime Sum;
  for (const Channel &C : Channels) {
    const dram::ControllerCounts &Counts = C.Control.counts();
    Sum.ReadBursts += Counts.Reads;
    Sum.WriteBursts += Counts.Writes;
    Sum.RowHits += Counts.RowHits;
    Sum.RowMisses += Counts.RowMisses;
    Sum.RowConflicts += Counts.RowConflicts;
    Sum.Forwarded += Counts.Forwarded;
    Sum.Activations += Counts.Activations;
    Sum.Drains += Counts.Drains;
    Sum.Refreshes += Counts.Refreshes;
    Sum.BusPs += Counts.BusTicks * Setup.Table.TickPs;
  }
  return Sum;
}

void DramChannels::clearCounters() {
  for (Channel &C : Channels)
    C.Control.clearCounts();
}

} // namespace vorion::isasim
