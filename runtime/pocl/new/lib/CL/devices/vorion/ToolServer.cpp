#include "ToolServer.h"

#include "vorion/support/ToolMessages.h"

#include <cstdlib>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

extern char **environ;

namespace vorion {

namespace {

/// Which file a descriptor is of; 0 of none.
ino_t fileOf(int Descriptor) {
  struct stat State{};
  return fstat(Descriptor, &State) == 0 && S_ISSOCK(State.st_mode)
             ? State.st_ino
             : 0;
}

/// The other end of a server's standard input. The server ends when it is
/// closed, so with this process at the latest. A program may close all
/// descriptors that it does not know, and get the number for a file of its own:
/// that one is left alone.
class Server {
public:
  explicit Server(int Socket) : Socket(Socket), File(fileOf(Socket)) {}
  Server(Server &&Other) noexcept
      : Socket(Other.Socket), File(std::exchange(Other.File, 0)) {}
  ~Server() {
    if (isThere())
      close(Socket);
  }

  /// Nothing if the server has gone, as it does after some time.
  std::optional<ToolAnswer> call(const std::vector<std::string> &Arguments) {
    if (!isThere() || !sendText(Socket, callText(Arguments)))
      return std::nullopt;
    const auto Answer = receiveText(Socket);
    const size_t Blank = Answer ? Answer->find(' ') : std::string::npos;
    if (Blank == std::string::npos)
      return std::nullopt;
    return ToolAnswer{std::atoi(Answer->c_str()), Answer->substr(Blank + 1)};
  }

private:
  bool isThere() const { return File != 0 && fileOf(Socket) == File; }

  int Socket;
  ino_t File; ///< 0 if it is another's
};

/// A server of \p Tool. What is started ends at once and leaves the server to
/// nobody, so that a program which waits for its own children is not kept.
std::optional<Server> start(const std::string &Tool) {
  int Ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, Ends) != 0)
    return std::nullopt;
  Server Ours(Ends[0]);
  posix_spawn_file_actions_t Files;
  posix_spawn_file_actions_init(&Files);
  posix_spawn_file_actions_adddup2(&Files, Ends[1], STDIN_FILENO);
  for (const int Stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&Files, Stream, "/dev/null", O_WRONLY, 0);
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
  std::string Name = Tool, Option = ServeCalls;
  char *const Arguments[] = {Name.data(), Option.data(), nullptr};
  pid_t Child = 0;
  const int Failed = posix_spawn(&Child, Tool.c_str(), &Files, &Attributes,
                                 Arguments, environ);
  posix_spawnattr_destroy(&Attributes);
  posix_spawn_file_actions_destroy(&Files);
  close(Ends[1]);
  if (Failed)
    return std::nullopt;
  while (waitpid(Child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return Ours;
}

/// Servers that nobody uses, by tool.
class Idle {
public:
  std::optional<Server> take(const std::string &Tool) {
    const std::lock_guard Hold(Lock);
    forget();
    auto &Of = Servers[Tool];
    if (Of.empty())
      return std::nullopt;
    Server Last = std::move(Of.back());
    Of.pop_back();
    return Last;
  }
  void keep(const std::string &Tool, Server S) {
    const std::lock_guard Hold(Lock);
    forget();
    Servers[Tool].push_back(std::move(S));
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
  std::map<std::string, std::vector<Server>> Servers;
  pid_t Owner = getpid();
};

/// Kernels may be compiled while the program's static objects go.
Idle &idle() {
  static Idle *const All = new Idle;
  return *All;
}

} // namespace

std::optional<ToolAnswer>
askToolServer(const std::string &Tool,
              const std::vector<std::string> &Arguments) {
  while (auto Used = idle().take(Tool)) {
    if (auto Answer = Used->call(Arguments)) {
      idle().keep(Tool, std::move(*Used));
      return Answer;
    }
  }
  auto New = start(Tool);
  if (!New)
    return std::nullopt;
  auto Answer = New->call(Arguments);
  if (Answer)
    idle().keep(Tool, std::move(*New));
  return Answer;
}

} // namespace vorion
