/// The observers that a user asked for, and the files that they write. One
/// session watches all runs of one machine.
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace vorion::isasim {

/// Texts as the command line or the environment has them; empty for no.
struct SessionOptions {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  std::string MEMBER;
#include "vorion/isasim/SessionOptions.def"
#undef VORION_SESSION_OPTION

  /// What the environment's variables say (docs/debugging.md).
  static SessionOptions fromEnvironment();
};

class Session {
public:
  /// Errors: an option that does not parse, a file that cannot be written.
  /// \p Print receives what is meant for stdout: tables and a profile without a
  /// file. Null: stdout is the application's; there are files only.
  static Expected<std::unique_ptr<Session>>
  create(const SessionOptions &O,
         std::function<void(std::string_view)> Print = nullptr);
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  /// \p M reports to this session from now on; without observers it runs
  /// plain.
  void attach(Machine &M);

  /// Before a run: what it is called, for timeline and counters.
  void nameRun(const std::string &Name);
  /// After a run: every file is complete.
  Expected<Success> runEnded(const RunResult &R);

private:
  Session();
  struct Impl;
  std::unique_ptr<Impl> I;
};

} // namespace vorion::isasim
