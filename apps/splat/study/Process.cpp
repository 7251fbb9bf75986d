#include "study/Process.h"

#include "study/PointStore.h"
#include "vorion/support/ChildGroup.h"
#include "vorion/support/Environment.h"
#include "vorion/support/File.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <spawn.h>
#include <sstream>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace vorion::splat {

std::string lastLine(const std::string &File) {
  const auto Bytes = readFile(File);
  if (!Bytes)
    return {};
  std::string Text(reinterpret_cast<const char *>(Bytes->data()),
                   Bytes->size());
  while (!Text.empty() && Text.back() == '\n')
    Text.pop_back();
  return Text.substr(Text.rfind('\n') + 1);
}

Expected<std::string> findProgram(const std::string &Name,
                                  std::string_view What) {
  const char *Path = environmentVariable("PATH");
  std::istringstream Folders(Path ? Path : "");
  for (std::string Folder; std::getline(Folders, Folder, ':');) {
    const std::string File =
        (std::filesystem::path(Folder.empty() ? "." : Folder) / Name).string();
    if (access(File.c_str(), X_OK) == 0 && !std::filesystem::is_directory(File))
      return File;
  }
  return Error{"", fmt::format("{0}: not found in PATH, expected the program "
                               "that {1} (Debian: apt install {0})",
                               Name, What)};
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

/// This process's environment, with \p Variables in place of those of the same
/// names.
static std::vector<std::string>
environmentWith(const std::map<std::string, std::string> &Variables) {
  std::vector<std::string> All;
  for (char **Each = environ; *Each; ++Each)
    if (const std::string Text = *Each;
        !Variables.contains(Text.substr(0, Text.find('='))))
      All.push_back(Text);
  for (const auto &[Name, Text] : Variables)
    All.push_back(fmt::format("{}={}", Name, Text));
  return All;
}

/// How \p Child ended, and what it \p Used.
static int waitFor(pid_t Child, const std::function<bool()> &GiveUp,
                   rusage &Used) {
  int Status = 0;
  pid_t Ended = 0;
  while ((Ended = wait4(Child, &Status, GiveUp ? WNOHANG : 0, &Used)) <= 0) {
    if (Ended < 0 && errno != EINTR)
      break;
    if (!GiveUp)
      continue;
    if (GiveUp())
      kill(-Child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return Status;
}

static double seconds(const timeval &T) {
  return static_cast<double>(T.tv_sec) + 1e-6 * static_cast<double>(T.tv_usec);
}

Expected<ProcessEnd>
runProgram(std::vector<std::string> Words,
           const std::map<std::string, std::string> &Variables,
           const std::string &OutFile, const std::string &LogFile,
           const std::function<bool()> &GiveUp) {
  std::vector<std::string> Environment = environmentWith(Variables);
  posix_spawn_file_actions_t Actions;
  posix_spawn_file_actions_init(&Actions);
  const auto Open = [&Actions](int Descriptor, const std::string &File) {
    posix_spawn_file_actions_addopen(&Actions, Descriptor, File.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
  };
  Open(STDOUT_FILENO, OutFile);
  if (LogFile == OutFile)
    posix_spawn_file_actions_adddup2(&Actions, STDOUT_FILENO, STDERR_FILENO);
  else
    Open(STDERR_FILENO, LogFile);
  // What another thread opens at this moment is not for it.
  posix_spawn_file_actions_addclosefrom_np(&Actions, STDERR_FILENO + 1);
  // A group with what it starts, which ends with this process.
  posix_spawnattr_t Attributes;
  posix_spawnattr_init(&Attributes);
  posix_spawnattr_setflags(&Attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  // A signal that ends this thread waits until the group is known to end, too.
  sigset_t All, Before;
  sigfillset(&All);
  pthread_sigmask(SIG_SETMASK, &All, &Before);
  posix_spawnattr_setsigmask(&Attributes, &Before);
  pid_t Child = 0;
  const int Problem =
      posix_spawn(&Child, Words.front().c_str(), &Actions, &Attributes,
                  pointersTo(Words).data(), pointersTo(Environment).data());
  std::optional<ChildGroup> Ends;
  if (Problem == 0)
    Ends.emplace(Child);
  pthread_sigmask(SIG_SETMASK, &Before, nullptr);
  posix_spawnattr_destroy(&Attributes);
  posix_spawn_file_actions_destroy(&Actions);
  if (Problem != 0)
    return Error{
        "",
        fmt::format("cannot start {}: {}, expected sufficient resources "
                    "for a process",
                    Words.front(), std::strerror(Problem)),
        ExitCode::LimitReached};
  rusage Used{};
  const int Status = waitFor(Child, GiveUp, Used);
  if (!WIFEXITED(Status))
    return Error{"",
                 fmt::format("'{}' was terminated by a signal: {}",
                             fmt::join(Words, " "), lastLine(LogFile)),
                 ExitCode::Internal};
  return ProcessEnd{static_cast<ExitCode>(WEXITSTATUS(Status)),
                    seconds(Used.ru_utime) + seconds(Used.ru_stime)};
}

Expected<ProcessEnd> runSplat(const std::vector<std::string> &Arguments,
                              const DeviceOptions &Machine,
                              const std::string &LogFile,
                              const std::function<bool()> &GiveUp) {
  std::vector<std::string> Words{"/proc/self/exe"};
  Words.insert(Words.end(), Arguments.begin(), Arguments.end());
  auto Ended =
      runProgram(Words, Machine.commandLine(), LogFile, LogFile, GiveUp);
  if (Ended && Ended->Code != ExitCode::Ok)
    return Error{"",
                 fmt::format("'splat {}' failed: {}", fmt::join(Arguments, " "),
                             lastLine(LogFile)),
                 Ended->Code};
  return Ended;
}

Expected<RunReport> runForReport(std::vector<std::string> Arguments,
                                 const DeviceOptions &Machine,
                                 const std::string &Base) {
  const std::string File = Base + ".json", Log = Base + ".log";
  Arguments.insert(Arguments.end(), {"--json", File});
  const auto Ended = runSplat(Arguments, Machine, Log);
  if (!Ended)
    return Ended.error();
  auto Report = readOwnJson(File);
  if (!Report)
    return Report.error();
  std::filesystem::remove(File);
  std::filesystem::remove(Log);
  return RunReport{std::move(*Report), Ended->ProcessorSeconds};
}

} // namespace vorion::splat
