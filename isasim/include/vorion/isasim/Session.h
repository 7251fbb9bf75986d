/// The observers that a user asked for, and the files that they write. One
/// session watches all runs of one machine.
#pragma once

#include "vorion/isasim/Observer.h"
#include "vorion/support/Expected.h"
#include "vorion/support/Outputs.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// Texts as the command line or the environment has them; empty for no.
struct SessionOptions {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  std::string MEMBER;
#include "vorion/isasim/SessionOptions.def"

  /// The files that will be written, but for standard output.
  std::vector<NamedFile> outputs() const;
  /// Whether the machine has to have its clock on for what is asked for.
  bool needClock() const;
};

/// A line of SessionOptions.def.
struct SessionOption {
  std::string SessionOptions::*Text;
  const char *Option;   ///< of vorion-sim
  const char *Variable; ///< of the environment
  const char *Value;    ///< what --help calls the text
  const char *Alone;    ///< the text where none is given; null: one has to be
  std::string Help;
  std::span<const std::string_view> Names; ///< that the text may list, if any
};
std::span<const SessionOption> sessionOptions();

class EnergyModel;

/// What errors of a session name: the option of which they are is known to who
/// gave it, or has the name of its variable.
enum class NamedBy { Nothing, Variable };

/// What only who starts a kernel knows of the memory that it gives it.
struct GivenMemory {
  size_t Argument = 0; ///< its number
  uint64_t Bytes = 0;
  bool IsZeros = true; ///< at the beginning
};

class Session {
public:
  /// Errors: an option that does not parse, a file that cannot be written.
  /// \p Print receives what is meant for stdout: tables and a profile without a
  /// file. Null: stdout is the application's; there are files only.
  /// What checkers find goes to stderr as messages of \p Tool.
  /// \p Energy is the model that counts joules; null: the default technology's.
  static Expected<std::unique_ptr<Session>>
  create(const SessionOptions &O, std::string Tool,
         NamedBy Names = NamedBy::Nothing,
         std::function<void(std::string_view)> Print = nullptr,
         std::shared_ptr<const EnergyModel> Energy = nullptr);
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  /// \p M reports to this session from now on; without observers it runs
  /// plain. An error if it does not have what was asked for.
  Expected<Success> attach(Machine &M);

  /// After a run: every file is complete.
  Expected<Success> runEnded(const RunResult &R);

  /// After the last run: an error if what was asked for never came.
  Expected<Success> finished() const;

  /// Whether anything observes the machine. The driver has to tell what the
  /// host does, with what follows (Observer.h); where nothing observes, that
  /// does nothing.
  bool observes() const;
  void allocated(uint32_t Address, uint64_t Bytes, const std::string &Name);
  void released(uint32_t Address);
  void hostWrote(uint32_t Address, uint64_t Bytes);
  void hostRead(uint32_t Address, uint64_t Bytes);
  void bufferNamed(uint32_t Address, const std::string &Name);
  void localUsed(uint64_t Bytes);

  /// Before runBegins(), where it is known.
  void memoryGiven(const std::vector<GivenMemory> &Given);
  /// Before every run: what it is called, and the address of its launch block
  /// or 0. Its image is loaded, its arguments are in memory.
  void runBegins(const std::string &Name, uint32_t LaunchBlock);

  /// Bytes to leave free behind each buffer.
  uint64_t guardBytes() const;
  /// What checkers have found so far.
  uint64_t findings() const;

private:
  Session();
  struct Impl;
  std::unique_ptr<Impl> PImpl;
};

} // namespace vorion::isasim
