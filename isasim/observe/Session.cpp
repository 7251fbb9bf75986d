#include "vorion/isasim/Session.h"

#include "observe/Profile.h"
#include "observe/Stats.h"
#include "observe/Timeline.h"
#include "observe/Trace.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/File.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace vorion::isasim {

namespace {

struct FileCloser {
  void operator()(std::FILE *F) const { std::fclose(F); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

/// Files that grow during a run cannot be written aside: a reader may follow
/// them, and what was written before a crash is what it is read for.
Expected<File> openGrowing(const std::string &Path) {
  std::FILE *F = std::fopen(Path.c_str(), "wb");
  if (!F)
    return Error{Path, std::string("cannot write: ") + std::strerror(errno) +
                           ", expected a folder that can be written"};
  return File(F);
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

struct Session::Impl {
  Expected<Success> open(const SessionOptions &O);
  Expected<Success> openTrace(const std::string &Text);

  std::function<void(std::string_view)> Print;
  SessionOptions Options;
  File TraceFile, TimelineFile;
  std::unique_ptr<Trace> Tracer;
  std::unique_ptr<Timeline> Times;
  std::unique_ptr<Profile> Profiler;
  std::unique_ptr<Stats> Counts;
  std::string RunName;
};

Session::Session() : I(std::make_unique<Impl>()) {}
Session::~Session() = default;

Expected<Success> Session::Impl::openTrace(const std::string &Text) {
  const Expected<TraceRequest> Request = TraceRequest::parse(Text);
  if (!Request)
    return Request.error();
  if (!Request->File.empty()) {
    Expected<File> F = openGrowing(Request->File);
    if (!F)
      return F.error();
    TraceFile = std::move(*F);
  }
  Tracer = std::make_unique<Trace>(TraceFile ? TraceFile.get() : stderr,
                                   Request->Categories);
  return Success{};
}

Expected<Success> Session::Impl::open(const SessionOptions &O) {
  Options = O;
  if (!O.Trace.empty())
    if (Expected<Success> Ok = openTrace(O.Trace); !Ok)
      return Ok;
  if (!O.Timeline.empty()) {
    Expected<File> F = openGrowing(O.Timeline);
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
  if ((Tracer || Times || Profiler) && !Machine::canBeObserved())
    return Error{"",
                 "a build without observers, expected one with "
                 "VORION_OBSERVERS=ON",
                 ExitCode::Usage};
  if (!O.Stats.empty())
    Counts = std::make_unique<Stats>();
  return Success{};
}

Expected<std::unique_ptr<Session>>
Session::create(const SessionOptions &O,
                std::function<void(std::string_view)> Print) {
  std::unique_ptr<Session> S(new Session());
  S->I->Print = std::move(Print);
  if (Expected<Success> Ok = S->I->open(O); !Ok) {
    Error E = Ok.error();
    return E;
  }
  return S;
}

void Session::attach(Machine &M) {
  std::vector<Observer *> Observers;
  for (Observer *O : std::initializer_list<Observer *>{
           I->Tracer.get(), I->Times.get(), I->Profiler.get()})
    if (O)
      Observers.push_back(O);
  M.setObservers(std::move(Observers));
  if (I->Counts)
    I->Counts->setConfig(M.config());
}

void Session::nameRun(const std::string &Name) {
  I->RunName = Name;
  if (I->Times)
    I->Times->nameRun(Name);
}

Expected<Success> Session::runEnded(const RunResult &R) {
  if (I->Counts) {
    I->Counts->add(I->RunName, R);
    if (I->Print)
      I->Print(Stats::table(R));
    if (Expected<Success> Ok =
            writeFileAtomically(I->Options.Stats, I->Counts->json());
        !Ok)
      return Ok;
  }
  if (I->Profiler) {
    const std::string Report = I->Profiler->report();
    if (I->Options.Profile != "-")
      return writeFileAtomically(I->Options.Profile, Report);
    I->Print(Report);
  }
  return Success{};
}

} // namespace vorion::isasim
