/// The observers that a user asked for, and the files that they write. One
/// session watches all runs of one machine.
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"
#include "vorion/support/Outputs.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// Texts as the command line or the environment has them; empty for no.
struct SessionOptions {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  std::string MEMBER;
#include "vorion/isasim/SessionOptions.def"
#undef VORION_SESSION_OPTION

  /// What the environment's variables say (docs/debugging.md).
  static SessionOptions fromEnvironment();
  /// The files that will be written, but for standard output.
  std::vector<NamedFile> outputs() const;
};

class Session {
public:
  /// Errors: an option that does not parse, a file that cannot be written.
  /// \p Print receives what is meant for stdout: tables and a profile without a
  /// file. Null: stdout is the application's; there are files only.
  /// What checkers find goes to stderr as messages of \p Tool.
  static Expected<std::unique_ptr<Session>>
  create(const SessionOptions &O, std::string Tool,
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

  /// Whether the driver has to say what it does with global memory, with what
  /// follows. All of it does nothing where not.
  bool checksMemory() const;
  void allocated(uint32_t Address, uint64_t Bytes, std::string Name);
  void released(uint32_t Address);
  void written(uint32_t Address, uint64_t Bytes);
  /// What the buffer at \p Address is for the next run.
  void nameBuffer(uint32_t Address, std::string Name);
  /// Local memory that the next run's kernel has; at first, all there is.
  void useLocal(uint64_t Bytes);
  /// Bytes to leave free behind each buffer.
  uint64_t guardBytes() const;

  /// What the checkers have found so far.
  uint64_t findings() const;

private:
  Session();
  struct Impl;
  std::unique_ptr<Impl> I;
};

} // namespace vorion::isasim
