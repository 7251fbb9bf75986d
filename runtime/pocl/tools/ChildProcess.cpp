#include "ChildProcess.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vorion {

namespace {

constexpr std::array Ends{SIGHUP, SIGINT, SIGTERM};

// Read and written by the handler, and elsewhere while it is held back.
volatile sig_atomic_t Running = 0;
volatile sig_atomic_t EndedBy = 0;

void endChild(int Number) {
  EndedBy = Number;
  if (Running != 0)
    kill(Running, SIGTERM);
}

/// Holds the signals back while it lives: none comes between the start of a
/// child and the note of which it is.
class HeldBack {
public:
  HeldBack() {
    sigset_t Set;
    sigemptyset(&Set);
    for (const int Number : Ends)
      sigaddset(&Set, Number);
    sigprocmask(SIG_BLOCK, &Set, &Before);
  }
  HeldBack(const HeldBack &) = delete;
  HeldBack &operator=(const HeldBack &) = delete;
  ~HeldBack() { sigprocmask(SIG_SETMASK, &Before, nullptr); }
  const sigset_t &before() const { return Before; }

private:
  sigset_t Before{};
};

/// Gives an error's number, or 0 and the child in Running.
int start(const std::vector<std::string> &Arguments,
          const std::array<int, 2> &Pipe) {
  std::vector<char *> Pointers;
  Pointers.reserve(Arguments.size() + 1);
  for (const std::string &Argument : Arguments)
    Pointers.push_back(const_cast<char *>(Argument.c_str()));
  Pointers.push_back(nullptr);
  posix_spawn_file_actions_t Actions;
  posix_spawn_file_actions_init(&Actions);
  posix_spawn_file_actions_adddup2(&Actions, Pipe[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&Actions, Pipe[1], STDERR_FILENO);
  posix_spawn_file_actions_addclose(&Actions, Pipe[0]);
  posix_spawn_file_actions_addclose(&Actions, Pipe[1]);
  const HeldBack Held;
  int Problem = EINTR;
  if (!isEnding()) {
    posix_spawnattr_t Attributes;
    posix_spawnattr_init(&Attributes);
    posix_spawnattr_setflags(&Attributes, POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigmask(&Attributes, &Held.before());
    pid_t Child = 0;
    Problem = posix_spawn(&Child, Pointers[0], &Actions, &Attributes,
                          Pointers.data(), environ);
    Running = Problem == 0 ? Child : 0;
    posix_spawnattr_destroy(&Attributes);
  }
  posix_spawn_file_actions_destroy(&Actions);
  return Problem;
}

} // namespace

Ran runChild(const std::vector<std::string> &Arguments) {
  std::array<int, 2> Pipe{};
  if (pipe(Pipe.data()) != 0)
    return {false, 0, std::strerror(errno)};
  const int Problem = start(Arguments, Pipe);
  close(Pipe[1]);
  Ran Result;
  std::array<char, 4096> Chunk{};
  for (ssize_t Got = 0; (Got = read(Pipe[0], Chunk.data(), Chunk.size())) > 0;)
    Result.Output.append(Chunk.data(), static_cast<size_t>(Got));
  close(Pipe[0]);
  if (Problem != 0)
    return {false, 0, Arguments[0] + ": " + std::strerror(Problem)};
  // Until it is waited for, its number is nobody else's.
  siginfo_t Ended{};
  waitid(P_PID, static_cast<id_t>(Running), &Ended, WEXITED | WNOWAIT);
  const HeldBack Held;
  int Status = 0;
  Result.Succeeded = waitpid(Running, &Status, 0) == Running &&
                     WIFEXITED(Status) && WEXITSTATUS(Status) == 0;
  Result.Signal = WIFSIGNALED(Status) ? WTERMSIG(Status) : 0;
  Running = 0;
  return Result;
}

void passEndsToChildren() {
  struct sigaction Action{};
  Action.sa_handler = endChild;
  Action.sa_flags = SA_RESTART;
  for (const int Number : Ends) {
    struct sigaction Present{};
    sigaction(Number, nullptr, &Present);
    if (Present.sa_handler != SIG_IGN)
      sigaction(Number, &Action, nullptr);
  }
}

bool isEnding() { return EndedBy != 0; }

void endIfAsked() {
  if (!isEnding())
    return;
  std::signal(EndedBy, SIG_DFL);
  std::raise(EndedBy);
}

} // namespace vorion
