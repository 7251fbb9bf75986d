#include "CompilerProcess.h"

#include "vorion/support/ToolMessages.h"

#include <algorithm>
#include <cstring>
#include <fcntl.h>
#include <iterator>
#include <list>
#include <mutex>
#include <optional>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace vorion {

namespace {

constexpr int LimitReached = 5; // of vorion::ExitCode

/// Which file a descriptor is of; 0 of none.
ino_t fileOf(int Descriptor) {
  struct stat State{};
  return fstat(Descriptor, &State) == 0 && S_ISSOCK(State.st_mode)
             ? State.st_ino
             : 0;
}

/// The other end of a socket of the compiler. A program may close all
/// descriptors that it does not know, and get the number for a file of its own:
/// that one is left alone.
class Socket {
public:
  explicit Socket(int Number) : Number(Number), File(fileOf(Number)) {}
  Socket(Socket &&Other) noexcept
      : Number(Other.Number), File(std::exchange(Other.File, 0)) {}
  ~Socket() {
    if (isThere())
      close(Number);
  }

  int number() const { return Number; }
  std::optional<std::string> receive() {
    return isThere() ? receiveText(Number) : std::nullopt;
  }
  bool send(const std::string &Text) {
    return isThere() && sendText(Number, Text);
  }
  /// How long send() and receive() wait for the other side, in seconds; 0 is
  /// for ever. Then they fail with EAGAIN.
  void limit(unsigned Seconds) {
    const timeval Limit{static_cast<time_t>(Seconds), 0};
    for (const int Way : {SO_RCVTIMEO, SO_SNDTIMEO})
      setsockopt(Number, SOL_SOCKET, Way, &Limit, sizeof(Limit));
  }

private:
  bool isThere() const { return File != 0 && fileOf(Number) == File; }

  int Number;
  ino_t File; ///< 0 if it is another's
};

/// The compiler ends when the first socket is closed, so with this process at
/// the latest.
struct Server {
  Socket Calls, End;
  unsigned Seconds; ///< that it may be silent; 0: for ever
  bool IsSilent = false;

  Server(Socket Calls, Socket End, unsigned Seconds)
      : Calls(std::move(Calls)), End(std::move(End)), Seconds(Seconds) {
    this->Calls.limit(Seconds);
    this->End.limit(Seconds);
  }

  /// Nothing if it ended, or was silent.
  std::optional<std::string> call(const std::string &Request) {
    errno = 0;
    auto Response = Calls.send(Request) ? Calls.receive() : std::nullopt;
    IsSilent = !Response && errno == EAGAIN;
    return Response;
  }

  CompilerFailure failure() {
    constexpr const char *Wanted = ", expected errors or a result";
    const auto Because = [&](const std::string &What) {
      return CompilerProblem + What + Wanted;
    };
    if (IsSilent)
      return {Because("gave no answer in " + std::to_string(Seconds) +
                      " s (VORION_COMPILE_SECONDS)"),
              {},
              true};
    ServerEnd Ended;
    const auto Text = End.receive();
    if (!Text || !isReadInto(Ended, *Text))
      return {Because("was ended"), {}};
    const int Status = Ended.WaitStatus;
    if (WIFSIGNALED(Status))
      return {Because("crashed (signal " + std::to_string(WTERMSIG(Status)) +
                      ", " + strsignal(WTERMSIG(Status)) + ")"),
              {}};
    if (WEXITSTATUS(Status) == LimitReached)
      return {Because("reached a limit of memory or time"), Ended.Printed,
              true};
    return {
        Because("ended with exit code " + std::to_string(WEXITSTATUS(Status))),
        Ended.Printed};
  }
};

/// Both ends of a socket.
struct Ends {
  Socket Ours, Theirs;
};

std::optional<Ends> makeSocket() {
  int Both[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, Both) != 0)
    return std::nullopt;
  return Ends{Socket(Both[0]), Socket(Both[1])};
}

/// What is started ends at once and leaves the compiler to nobody, so that a
/// program which waits for its own children is not kept. Gives an error's
/// number.
int spawn(const CompilerProgram &Compiler, int Calls, int End) {
  posix_spawn_file_actions_t Files;
  posix_spawn_file_actions_init(&Files);
  posix_spawn_file_actions_adddup2(&Files, Calls, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&Files, End, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&Files, STDERR_FILENO, "/dev/null", O_WRONLY,
                                   0);
  // As a program gets its signals that a shell starts.
  posix_spawnattr_t Attributes;
  posix_spawnattr_init(&Attributes);
  sigset_t None, All;
  sigemptyset(&None);
  sigfillset(&All);
  posix_spawnattr_setsigmask(&Attributes, &None);
  posix_spawnattr_setsigdefault(&Attributes, &All);
  posix_spawnattr_setflags(&Attributes,
                           POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::string Name = Compiler.File, Option = ServeCalls;
  char *const Arguments[] = {Name.data(), Option.data(), nullptr};
  std::vector<char *> Environment;
  Environment.reserve(Compiler.Environment.size() + 1);
  for (const std::string &Variable : Compiler.Environment)
    Environment.push_back(const_cast<char *>(Variable.c_str()));
  Environment.push_back(nullptr);
  pid_t Child = 0;
  const int Problem = posix_spawn(&Child, Name.c_str(), &Files, &Attributes,
                                  Arguments, Environment.data());
  posix_spawnattr_destroy(&Attributes);
  posix_spawn_file_actions_destroy(&Files);
  while (Problem == 0 && waitpid(Child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return Problem;
}

std::variant<Server, CompilerFailure> start(const CompilerProgram &Compiler) {
  auto Calls = makeSocket(), End = makeSocket();
  const int Problem = Calls && End ? spawn(Compiler, Calls->Theirs.number(),
                                           End->Theirs.number())
                                   : errno;
  if (Problem == 0)
    return Server(std::move(Calls->Ours), std::move(End->Ours),
                  Compiler.Seconds);
  return CompilerFailure{CompilerProblem + Compiler.File +
                             " cannot be started: " + strerror(Problem),
                         {},
                         true};
}

/// Compilers that nobody uses, with their environments: what a program sets
/// since their start they do not have.
class Idle {
public:
  std::optional<Server> take(const std::vector<std::string> &Environment) {
    const std::lock_guard Hold(Lock);
    forget();
    const auto Found =
        std::find_if(Servers.rbegin(), Servers.rend(), [&](const auto &Entry) {
          return Entry.first == Environment;
        });
    if (Found == Servers.rend())
      return std::nullopt;
    Server Last = std::move(Found->second);
    Servers.erase(std::next(Found).base());
    return Last;
  }
  void keep(const std::vector<std::string> &Environment, Server S) {
    const std::lock_guard Hold(Lock);
    forget();
    Servers.emplace_back(Environment, std::move(S));
  }

private:
  /// A forked process leaves those that it has to its parent: two must not talk
  /// over one socket.
  void forget() {
    if (Owner != getpid())
      Servers.clear();
    Owner = getpid();
  }
  std::mutex Lock;
  std::list<std::pair<std::vector<std::string>, Server>> Servers;
  pid_t Owner = getpid();
};

/// Kernels may be compiled while the program's static objects go.
Idle &idle() {
  static Idle *const All = new Idle;
  return *All;
}

} // namespace

std::variant<std::string, CompilerFailure>
askCompiler(const CompilerProgram &Compiler, const std::string &Request) {
  // One that is idle may have ended for many reasons, as it does after some
  // time.
  while (Compiler.Stays) {
    auto Used = idle().take(Compiler.Environment);
    if (!Used)
      break;
    if (auto Response = Used->call(Request)) {
      idle().keep(Compiler.Environment, std::move(*Used));
      return *Response;
    }
    if (Used->IsSilent)
      return Used->failure();
  }
  CompilerFailure Why;
  for (int Try = 0; Try < 2; ++Try) {
    auto New = start(Compiler);
    if (const auto *Problem = std::get_if<CompilerFailure>(&New))
      return *Problem;
    auto &Made = std::get<Server>(New);
    if (auto Response = Made.call(Request)) {
      if (Compiler.Stays)
        idle().keep(Compiler.Environment, std::move(Made));
      return *Response;
    }
    Why = Made.failure();
    if (Made.IsSilent)
      break;
  }
  return Why;
}

} // namespace vorion
