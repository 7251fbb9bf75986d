#include "vorion/isasim/Session.h"

#include "observe/Profile.h"
#include "observe/Stats.h"
#include "observe/Timeline.h"
#include "observe/Trace.h"
#include "observe/check/Checkers.h"
#include "observe/gdb/GdbServer.h"
#include "observe/numerics/Numerics.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

struct FileCloser {
  void operator()(std::FILE *F) const { std::fclose(F); }
};
using GrowingFile = std::unique_ptr<std::FILE, FileCloser>;

/// Files that grow during a run cannot be written aside: a reader may follow
/// them, and what was written before a crash is what it is read for.
Expected<GrowingFile> openGrowing(const std::string &Path) {
  std::FILE *F = std::fopen(Path.c_str(), "wb");
  if (!F)
    return Error{Path, std::string("cannot write: ") + std::strerror(errno) +
                           ", expected a folder that can be written"};
  return GrowingFile(F);
}

} // namespace

SessionOptions SessionOptions::fromEnvironment() {
  SessionOptions O;
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  if (const char *Text = std::getenv(VARIABLE))                                \
    O.MEMBER = Text;
#include "vorion/isasim/SessionOptions.def"
#undef VORION_SESSION_OPTION
  return O;
}

std::vector<NamedFile> SessionOptions::outputs() const {
  std::vector<NamedFile> Files{{"--stats", Stats}, {"--timeline", Timeline}};
  if (Profile != StandardOutput)
    Files.push_back({"--profile", Profile});
  // What does not parse is told when the session begins.
  if (const auto Request = TraceRequest::parse(Trace))
    Files.push_back({"--trace", Request->File});
  if (const auto O = NumericOptions::parse(Numerics); O && !Numerics.empty()) {
    if (O->Text != StandardOutput)
      Files.push_back({"text= of --numerics", O->Text});
    Files.push_back({"json= of --numerics", O->Json});
  }
  return Files;
}

struct Session::Impl {
  Expected<Success> open(const SessionOptions &O);
  Expected<Success> openTrace(const std::string &Text);
  Expected<Success> listenForGdb(const std::string &Text);
  Expected<Success> openNumerics(const std::string &Text);

  std::function<void(std::string_view)> Print;
  SessionOptions Options;
  GrowingFile TraceFile, TimelineFile;
  std::string TraceName;
  std::unique_ptr<Trace> Tracer;
  std::unique_ptr<Timeline> Times;
  std::unique_ptr<Profile> Profiler;
  std::unique_ptr<Stats> Counts;
  std::unique_ptr<Checkers> Checks;
  std::unique_ptr<Numerics> Shadow;
  std::unique_ptr<Observer> Debugger;
  std::string Tool;
  double WatchdogSeconds = 0;
  std::string RunName;
};

Session::Session() : I(std::make_unique<Impl>()) {}
Session::~Session() = default;

Expected<Success> Session::Impl::openTrace(const std::string &Text) {
  const Expected<TraceRequest> Request = TraceRequest::parse(Text);
  if (!Request)
    return Request.error();
  if (!Request->File.empty()) {
    Expected<GrowingFile> F = openGrowing(Request->File);
    if (!F)
      return F.error();
    TraceFile = std::move(*F);
    TraceName = Request->File;
  }
  Tracer = std::make_unique<Trace>(TraceFile ? TraceFile.get() : stderr,
                                   Request->Categories);
  return Success{};
}

Expected<Success> Session::Impl::listenForGdb(const std::string &Text) {
  unsigned Port = 0;
  const char *End = Text.data() + Text.size();
  const auto Read = std::from_chars(Text.data(), End, Port);
  if (Read.ec != std::errc() || Read.ptr != End || Port > 65535)
    return Error{"", fmt::format("gdb port '{}', expected 0 to 65535", Text),
                 ExitCode::Usage};
  auto Made = startGdbServer(Port, [this](std::string_view Line) {
    printNote(fmt::format("{}: {}\n", Tool, Line));
    std::fflush(stderr);
  });
  if (!Made)
    return Made.error();
  Debugger = std::move(*Made);
  return Success{};
}

Expected<Success> Session::Impl::openNumerics(const std::string &Text) {
  const Expected<NumericOptions> O = NumericOptions::parse(Text);
  if (!O)
    return O.error();
  if (O->Text == "-" && !Print)
    return Error{"",
                 "the numerics report has nowhere to go, expected text=FILE or "
                 "json=FILE",
                 ExitCode::Usage};
  Shadow = std::make_unique<Numerics>(*O);
  return Success{};
}

Expected<Success> Session::Impl::open(const SessionOptions &O) {
  Options = O;
  if (!O.Trace.empty())
    if (Expected<Success> Ok = openTrace(O.Trace); !Ok)
      return Ok;
  if (!O.Timeline.empty()) {
    Expected<GrowingFile> F = openGrowing(O.Timeline);
    if (!F)
      return F.error();
    TimelineFile = std::move(*F);
    Times = std::make_unique<Timeline>(TimelineFile.get());
  }
  if (O.Profile == "-" && !Print)
    return Error{"", "the profile has nowhere to go, expected a file name",
                 ExitCode::Usage};
  if (!O.Profile.empty())
    Profiler = std::make_unique<Profile>();
  if (!O.Numerics.empty())
    if (Expected<Success> Ok = openNumerics(O.Numerics); !Ok)
      return Ok;
  if ((Tracer || Times || Profiler || Shadow || !O.Check.empty() ||
       !O.Gdb.empty()) &&
      !Machine::canBeObserved())
    return Error{"",
                 "a build without observers, expected one with "
                 "VORION_OBSERVERS=ON",
                 ExitCode::Usage};
  if (!O.Watchdog.empty()) {
    const char *End = O.Watchdog.data() + O.Watchdog.size();
    const auto Read = std::from_chars(O.Watchdog.data(), End, WatchdogSeconds);
    if (Read.ec != std::errc() || Read.ptr != End || !(WatchdogSeconds > 0))
      return Error{
          "",
          fmt::format("watchdog of '{}', expected seconds above 0", O.Watchdog),
          ExitCode::Usage};
  }
  if (!O.Gdb.empty())
    if (Expected<Success> Ok = listenForGdb(O.Gdb); !Ok)
      return Ok;
  if (!O.Stats.empty())
    Counts = std::make_unique<Stats>();
  if (!O.Check.empty()) {
    auto Made = Checkers::create(O.Check, [this](std::string_view Text) {
      printNote(fmt::format("{}: {}\n", Tool, Text));
    });
    if (!Made)
      return Made.error();
    Checks = std::move(*Made);
  }
  return Success{};
}

Expected<std::unique_ptr<Session>>
Session::create(const SessionOptions &O, std::string Tool,
                std::function<void(std::string_view)> Print) {
  std::unique_ptr<Session> S(new Session());
  S->I->Print = std::move(Print);
  S->I->Tool = std::move(Tool);
  if (Expected<Success> Ok = S->I->open(O); !Ok) {
    Error E = Ok.error();
    return E;
  }
  return S;
}

void Session::attach(Machine &M) {
  std::vector<Observer *> Observers;
  // The debugger first: what it calls is over before others hear of the
  // instruction that the warp stands at.
  for (Observer *O : std::initializer_list<Observer *>{
           I->Debugger.get(), I->Tracer.get(), I->Times.get(),
           I->Profiler.get(), I->Shadow.get()})
    if (O)
      Observers.push_back(O);
  if (I->Checks)
    for (Observer *O : I->Checks->observers())
      Observers.push_back(O);
  M.setObservers(std::move(Observers));
  M.setWatchdog(I->WatchdogSeconds);
  if (I->Counts)
    I->Counts->setConfig(M.config());
}

void Session::nameRun(const std::string &Name) {
  I->RunName = Name;
  if (I->Times)
    I->Times->nameRun(Name);
}

bool Session::checksMemory() const { return I->Checks || I->Shadow; }

void Session::allocated(uint32_t Address, uint64_t Bytes, std::string Name) {
  if (I->Checks)
    I->Checks->allocated(Address, Bytes, std::move(Name));
}

void Session::released(uint32_t Address) {
  if (I->Checks)
    I->Checks->released(Address);
}

void Session::written(uint32_t Address, uint64_t Bytes) {
  if (I->Checks)
    I->Checks->written(Address, Bytes);
  if (I->Shadow)
    I->Shadow->written(Address, Bytes);
}

void Session::nameBuffer(uint32_t Address, std::string Name) {
  if (I->Checks)
    I->Checks->rename(Address, std::move(Name));
}

void Session::useLocal(uint64_t Bytes) {
  if (I->Checks)
    I->Checks->useLocal(Bytes);
}

uint64_t Session::guardBytes() const {
  return I->Checks ? I->Checks->guardBytes() : 0;
}

uint64_t Session::findings() const {
  return I->Checks ? I->Checks->findings() : 0;
}

/// Whether \p F, a growing file or none, has all that was written to it.
static Expected<Success> checkGrown(std::FILE *F, const std::string &Path) {
  if (!F || (std::fflush(F) == 0 && !std::ferror(F)))
    return Success{};
  return Error{Path, "cannot write all of it, expected room for what is "
                     "observed"};
}

Expected<Success> Session::runEnded(const RunResult &R) {
  if (Expected<Success> Ok = checkGrown(I->TraceFile.get(), I->TraceName); !Ok)
    return Ok;
  if (Expected<Success> Ok =
          checkGrown(I->TimelineFile.get(), I->Options.Timeline);
      !Ok)
    return Ok;
  if (I->Counts) {
    I->Counts->add(I->RunName, R);
    if (I->Print)
      I->Print(Stats::table(R));
    if (Expected<Success> Ok =
            writeFileAtomically(I->Options.Stats, I->Counts->json());
        !Ok)
      return Ok;
  }
  if (I->Shadow)
    if (Expected<Success> Ok = I->Shadow->write(I->Print); !Ok)
      return Ok;
  if (I->Profiler) {
    const std::string Report = I->Profiler->report();
    if (I->Options.Profile != "-")
      return writeFileAtomically(I->Options.Profile, Report);
    I->Print(Report);
  }
  return Success{};
}

} // namespace vorion::isasim
