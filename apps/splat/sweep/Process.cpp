#include "sweep/Process.h"

#include "vorion/support/File.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace vorion::splat {

static std::string lastLine(const std::string &File) {
  const auto Bytes = readFile(File);
  if (!Bytes)
    return {};
  std::string Text(reinterpret_cast<const char *>(Bytes->data()),
                   Bytes->size());
  while (!Text.empty() && Text.back() == '\n')
    Text.pop_back();
  return Text.substr(Text.rfind('\n') + 1);
}

/// As exec() wants them.
static std::vector<char *> pointersTo(std::vector<std::string> &Words) {
  std::vector<char *> Pointers;
  Pointers.reserve(Words.size() + 1);
  for (std::string &Word : Words)
    Pointers.push_back(Word.data());
  Pointers.push_back(nullptr);
  return Pointers;
}

/// This process's environment, with what \p Machine was given in place of
/// variables of the same names.
static std::vector<std::string> environmentWith(const DeviceOptions &Machine) {
  std::vector<std::string> All;
  for (char **Each = environ; *Each; ++Each)
    if (const std::string Text = *Each;
        !Machine.commandLine().contains(Text.substr(0, Text.find('='))))
      All.push_back(Text);
  for (const auto &[Name, Text] : Machine.commandLine())
    All.push_back(fmt::format("{}={}", Name, Text));
  return All;
}

/// How \p Child ended.
static int waitFor(pid_t Child, const std::function<bool()> &GiveUp) {
  int Status = 0;
  pid_t Ended = 0;
  while ((Ended = waitpid(Child, &Status, GiveUp ? WNOHANG : 0)) <= 0) {
    if (Ended < 0 && errno != EINTR)
      break;
    if (!GiveUp)
      continue;
    if (GiveUp())
      kill(Child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return Status;
}

Expected<Success> runSplat(const std::vector<std::string> &Arguments,
                           const DeviceOptions &Machine,
                           const std::string &LogFile,
                           const std::function<bool()> &GiveUp) {
  std::vector<std::string> Words{"splat"};
  Words.insert(Words.end(), Arguments.begin(), Arguments.end());
  std::vector<std::string> Environment = environmentWith(Machine);

  posix_spawn_file_actions_t Actions;
  posix_spawn_file_actions_init(&Actions);
  posix_spawn_file_actions_addopen(&Actions, STDOUT_FILENO, LogFile.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_adddup2(&Actions, STDOUT_FILENO, STDERR_FILENO);
  // What another thread opens at this moment is not for it.
  posix_spawn_file_actions_addclosefrom_np(&Actions, STDERR_FILENO + 1);
  pid_t Child = 0;
  const int Problem =
      posix_spawn(&Child, "/proc/self/exe", &Actions, nullptr,
                  pointersTo(Words).data(), pointersTo(Environment).data());
  posix_spawn_file_actions_destroy(&Actions);
  if (Problem != 0)
    return Error{"",
                 fmt::format("cannot start splat: {}, expected a machine with "
                             "room for a process",
                             std::strerror(Problem)),
                 ExitCode::LimitReached};
  const int Status = waitFor(Child, GiveUp);
  if (WIFEXITED(Status) && WEXITSTATUS(Status) == 0)
    return Success{};
  return Error{
      "",
      fmt::format("'{}' failed: {}", fmt::join(Words, " "), lastLine(LogFile)),
      WIFEXITED(Status) ? static_cast<ExitCode>(WEXITSTATUS(Status))
                        : ExitCode::Internal};
}

} // namespace vorion::splat
