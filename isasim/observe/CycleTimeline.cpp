#include "observe/CycleTimeline.h"

#include "observe/ChipPower.h"
#include "timing/memory/L2Link.h"
#include "vorion/support/ClockText.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

/// Rows of the picture come in these groups.
enum Process : unsigned {
  OfRuns = 1,
  OfCores,
  OfRasterizers,
  OfPixelUnits,
  OfLink,
  OfL2,
  OfLlc,
  OfDram,
  OfPower,
  OfHost
};

} // namespace

CycleTimeline::CycleTimeline(std::FILE *File, const Config &C,
                             std::shared_ptr<const EnergyModel> EnergyIn)
    : Energy(std::move(EnergyIn)),
      Out(File,
          "1 cycle of " +
              clockedMachine(nameOf(C).Name, C.Timing.ClockMhz, ClockVersion)),
      L2Banks(C.Timing.L2.Banks) {
  addUnits<CoreCycle>(Cores, OfCores, "core", C.cores());
  addUnits<RasterCycle>(Rasters, OfRasterizers, "rasterizer", C.sockets());
  addUnits<PixelCycle>(Pixels, OfPixelUnits, "pixel unit", C.Clusters);
  if (L2Link::exists(C.Timing))
    for (const char *Way : {"to the L2", "from the L2"})
      addShare(Link, OfLink, Way);
  if (C.Timing.Host.DmaEngines) {
    addUnits<CommandCycle>(Commands, OfHost, "command processor", 1);
    addUnits<DmaCycle>(Dmas, OfHost, "DMA engine", C.Timing.Host.DmaEngines);
    for (unsigned N = 0; N != Dmas.size(); ++N)
      Dmas[N].Thread = N + 1;
    Out.nameProcess(OfHost, "command processor and DMA");
  }
  for (unsigned N = 0; N != C.Clusters; ++N)
    addBanks(L2, OfL2, fmt::format("slice {} bank", N), L2Banks);
  addBanks(Llc, OfLlc, "bank", C.Timing.Llc.Banks);
  addBanks(Channels, OfDram, "channel", C.Timing.Dram.Channels);

  for (const auto &[Id, Name] : {std::pair{OfRuns, "runs"},
                                 {OfCores, "cores"},
                                 {OfRasterizers, "rasterizers"},
                                 {OfPixelUnits, "pixel units"},
                                 {OfLink, "link"},
                                 {OfL2, "L2"},
                                 {OfLlc, "last-level cache"},
                                 {OfDram, "DRAM"},
                                 {OfPower, "power"}})
    Out.nameProcess(Id, Name);
  Out.nameThread(OfRuns, 0, "runs");
  for (const std::vector<Row> *Rows :
       {&Cores, &Rasters, &Pixels, &Commands, &Dmas})
    for (const Row &R : *Rows)
      Out.nameThread(R.Process, R.Thread, R.Name);
}

template <typename Reason>
void CycleTimeline::addUnits(std::vector<Row> &To, unsigned Process,
                             const char *Of, unsigned Count) {
  for (unsigned N = 0; N != Count; ++N)
    To.push_back({Process,
                  N,
                  fmt::format("{} {}", Of, N),
                  size_t(Reason::Count),
                  [](size_t Which) { return name(static_cast<Reason>(Which)); },
                  {}});
}

void CycleTimeline::addBanks(std::vector<Row> &To, unsigned Process,
                             const std::string &Of, unsigned Count) {
  for (unsigned N = 0; N != Count; ++N)
    addShare(To, Process, fmt::format("{} {}", Of, N));
}

void CycleTimeline::addShare(std::vector<Row> &To, unsigned Process,
                             const std::string &Of) {
  To.push_back({Process, 0, Of + ", % busy", 1, {}, {}});
}

void CycleTimeline::timeBegins(uint64_t Now) {
  Origin = Now;
  WindowCycles = ShortestWindow;
  for (std::vector<Row> *Rows : {&Cores, &Rasters, &Pixels, &Commands, &Dmas,
                                 &Link, &L2, &Llc, &Channels})
    for (Row &R : *Rows)
      R.Cycles.clear();
}

void CycleTimeline::coreSpent(const CoreSpent &S) {
  add(Cores[S.Core], size_t(S.What), S.When);
}

void CycleTimeline::rasterSpent(unsigned Socket, RasterCycle What,
                                CycleSpan When) {
  add(Rasters[Socket], size_t(What), When);
}

void CycleTimeline::pixelSpent(unsigned Cluster, PixelCycle What,
                               CycleSpan When) {
  add(Pixels[Cluster], size_t(What), When);
}

void CycleTimeline::linkBusy(bool IsToL2, CycleSpan When) {
  add(Link[IsToL2 ? 0 : 1], 0, When);
}

void CycleTimeline::commandSpent(CommandCycle What, CycleSpan When) {
  add(Commands[0], size_t(What), When);
}

void CycleTimeline::dmaSpent(unsigned Engine, DmaCycle What, CycleSpan When) {
  add(Dmas[Engine], size_t(What), When);
}

void CycleTimeline::bankBusy(BankPlace Where, CycleSpan When) {
  add(Where.IsLlc ? Llc[Where.Bank] : L2[Where.Slice * L2Banks + Where.Bank], 0,
      When);
}

void CycleTimeline::dramCommand(unsigned Channel, const dram::Issued &,
                                CycleSpan Data) {
  add(Channels[Channel], 0, Data);
}

/// Spends the cycles on the windows in which they lie.
void CycleTimeline::add(Row &R, size_t Reason, CycleSpan When) {
  When.From = std::max(When.From, Origin);
  if (isFull() || When.From >= When.Until)
    return;
  while (When.Until - Origin > MaxWindows * WindowCycles)
    widen();
  const size_t Last = (When.Until - 1 - Origin) / WindowCycles;
  if (R.Cycles.size() < (Last + 1) * R.Reasons)
    R.Cycles.resize((Last + 1) * R.Reasons);
  for (uint64_t At = When.From; At != When.Until;) {
    const size_t Window = (At - Origin) / WindowCycles;
    const uint64_t To =
        std::min(When.Until, Origin + (Window + 1) * WindowCycles);
    R.Cycles[Window * R.Reasons + Reason] += static_cast<uint32_t>(To - At);
    At = To;
  }
}

/// Makes one window of two.
void CycleTimeline::widen() {
  WindowCycles *= 2;
  for (std::vector<Row> *Rows : {&Cores, &Rasters, &Pixels, &Commands, &Dmas,
                                 &Link, &L2, &Llc, &Channels})
    for (Row &R : *Rows) {
      std::vector<uint32_t> Wide((R.Cycles.size() / R.Reasons + 1) / 2 *
                                 R.Reasons);
      for (size_t N = 0; N != R.Cycles.size(); ++N)
        Wide[N / R.Reasons / 2 * R.Reasons + N % R.Reasons] += R.Cycles[N];
      R.Cycles = std::move(Wide);
    }
}

void CycleTimeline::writeUnit(const Row &R) {
  const size_t Windows = R.Cycles.size() / R.Reasons;
  const auto MostOf = [&](size_t Window) {
    const auto First =
        R.Cycles.begin() + static_cast<std::ptrdiff_t>(Window * R.Reasons);
    return static_cast<size_t>(
        std::max_element(First,
                         First + static_cast<std::ptrdiff_t>(R.Reasons)) -
        First);
  };
  for (size_t First = 0, Behind = 0; First != Windows; First = Behind) {
    const size_t Most = MostOf(First);
    std::vector<uint64_t> Sums(R.Reasons);
    for (; Behind != Windows && MostOf(Behind) == Most; ++Behind)
      for (size_t N = 0; N != R.Reasons; ++N)
        Sums[N] += R.Cycles[Behind * R.Reasons + N];
    if (beginOf(First) == beginOf(Behind))
      return;
    std::string Args;
    for (size_t N = 0; N != R.Reasons; ++N)
      if (Sums[N])
        Args += fmt::format("{}\"{}\": {}", Args.empty() ? "" : ", ",
                            R.NameOf(N), Sums[N]);
    Out.slice(R.Process, R.Thread, R.NameOf(Most), beginOf(First),
              beginOf(Behind), "{" + Args + "}");
  }
}

/// Of what has a figure.
void CycleTimeline::writeShare(Row &R) {
  const size_t Windows = (End - Origin + WindowCycles - 1) / WindowCycles;
  R.Cycles.resize(Windows);
  for (size_t N = 0; N != Windows; ++N) {
    const uint64_t Length = beginOf(N + 1) - beginOf(N);
    // What it began in this window may go on beyond the run.
    const uint64_t Busy = std::min<uint64_t>(R.Cycles[N], Length);
    const uint64_t Share = (1000 * Busy + Length / 2) / Length;
    if (Share != R.Shown)
      Out.counter(R.Process, R.Name, beginOf(N),
                  static_cast<double>(Share) / 10);
    R.Shown = Share;
  }
}

/// What a unit took is spread over the cycles in which it worked, and the rest
/// over all.
void CycleTimeline::writePower(const TimeReport &Time) {
  const ChipEnergy Joules = chipEnergyOf(Time, Energy.get());
  const size_t Windows = (End - Origin + WindowCycles - 1) / WindowCycles;
  std::vector<double> Spent(Windows);
  for (size_t N = 0; N != Windows; ++N)
    Spent[N] = Joules.Always *
               static_cast<double>(beginOf(N + 1) - beginOf(N)) /
               static_cast<double>(End - Origin);
  const auto Spread = [&](const std::vector<Row> &Rows, size_t Working,
                          double Energy) {
    std::vector<double> Cycles(Windows);
    double All = 0;
    for (const Row &R : Rows)
      for (size_t N = 0; N * R.Reasons < R.Cycles.size() && N != Windows; ++N) {
        const double Worked = R.Cycles[N * R.Reasons + Working];
        Cycles[N] += Worked;
        All += Worked;
      }
    for (size_t N = 0; N != Windows && All > 0; ++N)
      Spent[N] += Energy * Cycles[N] / All;
  };
  Spread(Cores, size_t(CoreCycle::Issue), Joules.Cores);
  Spread(Rasters, size_t(RasterCycle::Blend), Joules.Rasterizers);
  Spread(Pixels, size_t(PixelCycle::Evaluate), Joules.PixelUnits);
  for (size_t N = 0; N != Windows; ++N) {
    const double Seconds = static_cast<double>(beginOf(N + 1) - beginOf(N)) /
                           (1e6 * Time.ClockMhz);
    const auto Milliwatts = static_cast<uint64_t>(1e3 * Spent[N] / Seconds);
    if (Milliwatts != ShownPower)
      Out.counter(OfPower, "chip, mW", beginOf(N),
                  static_cast<double>(Milliwatts));
    ShownPower = Milliwatts;
  }
}

void CycleTimeline::runEnded(const std::string &Name, const TimeReport *Time) {
  if (End == Origin)
    return;
  Out.slice(OfRuns, 0, Name.empty() ? "run" : Name, Origin, End);
  if (!isFull()) {
    for (const std::vector<Row> *Rows :
         {&Cores, &Rasters, &Pixels, &Commands, &Dmas})
      for (const Row &R : *Rows)
        writeUnit(R);
    for (std::vector<Row> *Rows : {&Link, &L2, &Llc, &Channels})
      for (Row &R : *Rows)
        writeShare(R);
    if (Time)
      writePower(*Time);
  }
  Out.complete();
  Origin = End;
}

} // namespace vorion::isasim
