#include "vorion/isasim/Session.h"

#include "observe/Tool.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Variables.h"
#include "vorion/support/Diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>

namespace vorion::isasim {

namespace {

/// By the number of their option.
constexpr const ToolKind *Kinds[] = {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  &tools::MEMBER,
#include "vorion/isasim/SessionOptions.def"
};

/// The help of an option of \p Kind: what it does, and what it can name.
std::string help(const char *Does, const ToolKind &Kind) {
  return Kind.Names.empty()
             ? Does
             : fmt::format("{}: all, {}", Does, fmt::join(Kind.Names, ", "));
}

} // namespace

std::span<const SessionOption> sessionOptions() {
  static const SessionOption Options[] = {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  {&SessionOptions::MEMBER,                                                    \
   OPTION,                                                                     \
   VARIABLE,                                                                   \
   VALUE,                                                                      \
   ALONE,                                                                      \
   help(HELP, tools::MEMBER),                                                  \
   tools::MEMBER.Names},
#include "vorion/isasim/SessionOptions.def"
  };
  return Options;
}

std::vector<NamedFile> SessionOptions::outputs() const {
  std::vector<NamedFile> All;
  for (size_t N = 0; N != std::size(Kinds); ++N) {
    const std::string &Text = this->*sessionOptions()[N].Text;
    if (Text.empty() || !Kinds[N]->Outputs)
      continue;
    const std::vector<NamedFile> Files = Kinds[N]->Outputs(Text);
    All.insert(All.end(), Files.begin(), Files.end());
  }
  return All;
}

bool SessionOptions::needClock() const {
  for (size_t N = 0; N != std::size(Kinds); ++N)
    if (Kinds[N]->NeedsClock && !(this->*sessionOptions()[N].Text).empty())
      return true;
  return false;
}

struct Session::Impl {
  Expected<Success> open(const SessionOptions &O, NamedBy Names);
  void findObservers();
  void tell(auto What);

  ToolOutput To;
  /// A tool, and what its option is called.
  struct NamedTool {
    std::unique_ptr<Tool> Made;
    const char *Variable; ///< null: not by a variable

    Tool *operator->() const { return Made.get(); }
    /// What \p Came of it, an error as one of its variable.
    Expected<Success> named(const Expected<Success> &Came) const {
      return Came || !Variable ? Came : inVariable(Variable, Came.error());
    }
  };
  std::vector<NamedTool> Tools;
  std::vector<Observer *> Observers; ///< of all tools
  std::string RunName;
};

Session::Session() : PImpl(std::make_unique<Impl>()) {}
Session::~Session() = default;

Expected<Success> Session::Impl::open(const SessionOptions &O, NamedBy Names) {
  for (size_t N = 0; N != std::size(Kinds); ++N) {
    const std::string &Text = O.*sessionOptions()[N].Text;
    if (Text.empty())
      continue;
    const char *Variable =
        Names == NamedBy::Variable ? sessionOptions()[N].Variable : nullptr;
    auto Made = Kinds[N]->Make(Text, To);
    if (!Made)
      return Variable ? inVariable(Variable, Made.error()) : Made.error();
    Tools.push_back({std::move(*Made), Variable});
  }
  findObservers();
  if (!Observers.empty() && !Machine::canBeObserved())
    return Error{"",
                 "a build without observers, expected one with "
                 "VORION_OBSERVERS=ON",
                 ExitCode::Usage};
  return Success{};
}

Expected<std::unique_ptr<Session>>
Session::create(const SessionOptions &O, std::string Tool, NamedBy Names,
                std::function<void(std::string_view)> Print,
                std::shared_ptr<const EnergyModel> Energy) {
  std::unique_ptr<Session> S(new Session());
  S->PImpl->To = {.Print = std::move(Print),
                  .Report =
                      [Tool = std::move(Tool)](std::string_view Text) {
                        printNote(fmt::format("{}: {}\n", Tool, Text));
                        std::fflush(stderr);
                      },
                  .Energy = std::move(Energy)};
  if (Expected<Success> Ok = S->PImpl->open(O, Names); !Ok)
    return Ok.error();
  return S;
}

void Session::Impl::findObservers() {
  Observers.clear();
  for (const bool ChangesRuns : {true, false})
    for (const auto &T : Tools)
      if (T->changesRuns() == ChangesRuns)
        std::ranges::copy(T->observers(), std::back_inserter(Observers));
}

Expected<Success> Session::attach(Machine &M) {
  for (const auto &T : PImpl->Tools)
    if (auto Ok = T.named(T->attach(M)); !Ok)
      return Ok;
  // A tool may watch machines with a clock in another way.
  PImpl->findObservers();
  M.setObservers(PImpl->Observers);
  std::vector<TimeObserver *> OfClock;
  for (const auto &T : PImpl->Tools)
    std::ranges::copy(T->timeObservers(), std::back_inserter(OfClock));
  M.setTimeObservers(std::move(OfClock));
  return Success{};
}

Expected<Success> Session::runEnded(const RunResult &R) {
  for (const auto &T : PImpl->Tools)
    if (Expected<Success> Ok = T.named(T->runEnded(PImpl->RunName, R)); !Ok)
      return Ok;
  return Success{};
}

void Session::Impl::tell(auto What) {
  for (Observer *O : Observers)
    What(*O);
}

bool Session::observes() const { return !PImpl->Observers.empty(); }

void Session::allocated(uint32_t Address, uint64_t Bytes,
                        const std::string &Name) {
  PImpl->tell([&](Observer &O) { O.allocated(Address, Bytes, Name); });
}

void Session::released(uint32_t Address) {
  PImpl->tell([&](Observer &O) { O.released(Address); });
}

void Session::hostWrote(uint32_t Address, uint64_t Bytes) {
  PImpl->tell([&](Observer &O) { O.hostWrote(Address, Bytes); });
}

void Session::hostRead(uint32_t Address, uint64_t Bytes) {
  PImpl->tell([&](Observer &O) { O.hostRead(Address, Bytes); });
}

void Session::bufferNamed(uint32_t Address, const std::string &Name) {
  PImpl->tell([&](Observer &O) { O.bufferNamed(Address, Name); });
}

void Session::localUsed(uint64_t Bytes) {
  PImpl->tell([&](Observer &O) { O.localUsed(Bytes); });
}

void Session::memoryGiven(const std::vector<GivenMemory> &Given) {
  for (const auto &T : PImpl->Tools)
    T->memoryGiven(Given);
}

void Session::runBegins(const std::string &Name, uint32_t LaunchBlock) {
  PImpl->RunName = Name;
  PImpl->tell([&](Observer &O) { O.runNamed(Name); });
  for (const auto &T : PImpl->Tools)
    T->runBegins(Name, LaunchBlock);
}

Expected<Success> Session::finished() const {
  for (const auto &T : PImpl->Tools)
    if (Expected<Success> Ok = T.named(T->finished()); !Ok)
      return Ok;
  return Success{};
}

uint64_t Session::guardBytes() const {
  uint64_t Most = 0;
  for (const auto &T : PImpl->Tools)
    Most = std::max(Most, T->guardBytes());
  return Most;
}

uint64_t Session::findings() const {
  uint64_t Sum = 0;
  for (const auto &T : PImpl->Tools)
    Sum += T->findings();
  return Sum;
}

} // namespace vorion::isasim
