/// What a session is made of. Each tool that a user can ask for is made from
/// its option's text, owns its files and writes its report. A new one is its
/// own files and one line of SessionOptions.def.
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"
#include "vorion/support/Outputs.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

class EnergyModel;
struct GivenMemory;
class TimeObserver;

/// Where tools send what is not for a file of theirs.
struct ToolOutput {
  /// What is meant for stdout. Null: stdout is the application's.
  std::function<void(std::string_view)> Print;
  /// A message for people, without the last newline.
  std::function<void(std::string_view)> Report;
  /// The model that counts joules. Null: the default technology's.
  std::shared_ptr<const EnergyModel> Energy;
};

class Tool {
public:
  virtual ~Tool() = default;

  /// What watches the runs, in the order in which it is told. None: the tool
  /// needs no observed run. Asked for again after attach().
  virtual std::vector<Observer *> observers() { return {}; }
  /// What watches the clock, in the order in which it is told. Asked for after
  /// attach().
  virtual std::vector<TimeObserver *> timeObservers() { return {}; }
  /// Whether its observers change runs. They are told before all others: what
  /// they do is over before others hear of the instruction that the warp
  /// stands at.
  virtual bool changesRuns() const { return false; }
  /// The machine of the runs that follow. An error if it does not have what was
  /// asked for.
  virtual Expected<Success> attach(Machine &) { return Success{}; }
  /// Of the arguments of the run that follows, where that is known.
  virtual void memoryGiven(const std::vector<GivenMemory> &) {}
  /// Before a run of the machine's image that is called \p Name, or nothing.
  virtual void runBegins(const std::string & /*Name*/,
                         uint32_t /*LaunchBlock*/) {}
  /// After a run that is called \p Name, or nothing: every file is complete.
  virtual Expected<Success> runEnded(const std::string & /*Name*/,
                                     const RunResult &) {
    return Success{};
  }
  /// Bytes that are to stay free behind each buffer.
  virtual uint64_t guardBytes() const { return 0; }
  /// After the last run: an error if what was asked for never came.
  virtual Expected<Success> finished() const { return Success{}; }
  /// Errors of programs that it has found so far.
  virtual uint64_t findings() const { return 0; }
};

/// How a tool is made from the text of its option.
struct ToolKind {
  Expected<std::unique_ptr<Tool>> (*Make)(const std::string &Text,
                                          const ToolOutput &To);
  /// The files that it will write, but for standard output; null for none. A
  /// text that does not parse has none.
  std::vector<NamedFile> (*Outputs)(const std::string &Text) = nullptr;
  /// What its option chooses from, for --help; empty if it names nothing.
  // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
  std::span<const std::string_view> Names = {};
  /// Whether there is nothing to see of a machine without a clock.
  bool NeedsClock = false;
};

/// The kinds by their members of SessionOptions, each defined with its tool.
namespace tools {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  extern const ToolKind MEMBER;
#include "vorion/isasim/SessionOptions.def"
} // namespace tools

} // namespace vorion::isasim
