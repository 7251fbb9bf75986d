/// The observers that a user requested, and their output files. A session
/// observes all runs of one machine.
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

/// Option values from the command line or the environment; empty: not given.
struct SessionOptions {
#define VORION_SESSION_OPTION(MEMBER, OPTION, VARIABLE, VALUE, ALONE, HELP)    \
  std::string MEMBER;
#include "vorion/isasim/SessionOptions.def"

  /// The output files, except standard output.
  std::vector<NamedFile> outputs() const;
  /// Whether the requested observers need the clock.
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

/// How errors of a session refer to an option: not at all, because the caller
/// adds its name, or by the environment variable.
enum class NamedBy { Nothing, Variable };

/// Information about the memory of a launch that only its caller has.
struct GivenMemory {
  size_t Argument = 0; ///< its number
  uint64_t Bytes = 0;
  bool IsZeros = true; ///< at the beginning
};

class Session {
public:
  /// Errors: an invalid option value, a file that cannot be written. \p Print
  /// receives output for stdout: tables and a profile without a file. Null:
  /// stdout belongs to the application; only files are written. Findings of
  /// checkers are printed to stderr as messages of \p Tool. \p Energy is the
  /// energy model; null: that of the default technology.
  static Expected<std::unique_ptr<Session>>
  create(const SessionOptions &O, std::string Tool,
         NamedBy Names = NamedBy::Nothing,
         std::function<void(std::string_view)> Print = nullptr,
         std::shared_ptr<const EnergyModel> Energy = nullptr);
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  /// Attaches the session to \p M; without observers the machine runs
  /// unobserved. Error: \p M does not support a requested observer.
  Expected<Success> attach(Machine &M);

  /// Call after each run: completes every file.
  Expected<Success> runEnded(const RunResult &R);

  /// Call after the last run. Error: a requested event did not occur.
  Expected<Success> finished() const;

  /// Whether the machine is observed. The driver reports actions of the host by
  /// the following functions (Observer.h), which have no effect without
  /// observers.
  bool observes() const;
  void allocated(uint32_t Address, uint64_t Bytes, const std::string &Name);
  void released(uint32_t Address);
  void hostWrote(uint32_t Address, uint64_t Bytes);
  void hostRead(uint32_t Address, uint64_t Bytes);
  void bufferNamed(uint32_t Address, const std::string &Name);
  void localUsed(uint64_t Bytes);

  /// Call before runBegins(), if known.
  void memoryGiven(const std::vector<GivenMemory> &Given);
  /// Call before every run with its name and the address of its launch block or
  /// 0. The image is loaded, the arguments are in memory.
  void runBegins(const std::string &Name, uint32_t LaunchBlock);

  /// Bytes of padding after each buffer.
  uint64_t guardBytes() const;
  /// Number of findings of checkers so far.
  uint64_t findings() const;

private:
  Session();
  struct Impl;
  std::unique_ptr<Impl> PImpl;
};

} // namespace vorion::isasim
