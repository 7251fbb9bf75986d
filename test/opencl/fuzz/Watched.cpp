#include "Watched.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace vorion::test {

namespace {

using Clock = std::chrono::steady_clock;

struct Settings {
  uint64_t First = 1, Count = 1;
  double Seconds = 1e9, Limit = 60;
  std::string Resume;
  bool Here = false;
};

bool parse(int Argc, char **Argv, Settings &S) {
  for (int I = 1; I < Argc; ++I) {
    const std::string_view Option = Argv[I];
    if (Option == "--here") {
      S.Here = true;
      continue;
    }
    if (++I == Argc)
      return false;
    if (Option == "--first")
      S.First = std::strtoull(Argv[I], nullptr, 10);
    else if (Option == "--count")
      S.Count = std::strtoull(Argv[I], nullptr, 10);
    else if (Option == "--seconds")
      S.Seconds = std::strtod(Argv[I], nullptr);
    else if (Option == "--limit")
      S.Limit = std::strtod(Argv[I], nullptr);
    else if (Option == "--resume")
      S.Resume = Argv[I];
    else
      return false;
  }
  return true;
}

double since(Clock::time_point Start) {
  return std::chrono::duration<double>(Clock::now() - Start).count();
}

/// What is wrong with one case, or nothing.
std::string watch(uint64_t Seed, double Limit,
                  const std::function<std::string(uint64_t)> &Case) {
  int Pipe[2];
  if (pipe(Pipe) != 0)
    return "no pipe";
  const pid_t Child = fork();
  if (Child < 0)
    return "no process";
  if (Child == 0) {
    close(Pipe[0]);
    // What the platform says of traps and sources is not what is looked for.
    if (!freopen("/dev/null", "w", stderr) ||
        !freopen("/dev/null", "w", stdout))
      _exit(2);
    const std::string Wrong = Case(Seed);
    const ssize_t Told = write(Pipe[1], Wrong.data(), Wrong.size());
    std::exit(Told == static_cast<ssize_t>(Wrong.size()) ? 0 : 2);
  }
  close(Pipe[1]);
  const Clock::time_point Start = Clock::now();
  int Status = 0;
  bool Late = false;
  while (waitpid(Child, &Status, WNOHANG) == 0) {
    if (since(Start) > Limit && !Late) {
      Late = true;
      kill(Child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::string Wrong;
  char Text[4096];
  for (ssize_t Got = 0; (Got = read(Pipe[0], Text, sizeof(Text))) > 0;)
    Wrong.append(Text, static_cast<std::size_t>(Got));
  close(Pipe[0]);
  if (Late)
    return "took more than " + std::to_string(Limit) + " seconds";
  if (WIFSIGNALED(Status))
    return std::string("ended by a signal: ") + strsignal(WTERMSIG(Status)) +
           (Wrong.empty() ? "" : " (after: " + Wrong + ")");
  if (WEXITSTATUS(Status) != 0)
    return "ended with exit code " + std::to_string(WEXITSTATUS(Status));
  return Wrong;
}

} // namespace

int runWatched(int Argc, char **Argv, const char *Name,
               const std::function<std::string(uint64_t)> &Case) {
  Settings S;
  if (!parse(Argc, Argv, S)) {
    std::cerr << Name
              << ": error: expected --first N, --count N, --seconds N, "
                 "--limit N, --resume FILE or --here\n";
    return 2;
  }
  if (S.Here) {
    const std::string Wrong = Case(S.First);
    std::cout << "seed " << S.First << ": " << (Wrong.empty() ? "good" : Wrong)
              << "\n";
    return Wrong.empty() ? 0 : 1;
  }
  uint64_t Seed = S.First, Finds = 0, Done = 0;
  if (!S.Resume.empty())
    if (std::ifstream Last(S.Resume); Last >> Seed)
      ++Seed;
  const Clock::time_point Start = Clock::now();
  for (; Seed < S.First + S.Count && since(Start) < S.Seconds; ++Seed, ++Done) {
    if (const std::string Wrong = watch(Seed, S.Limit, Case); !Wrong.empty()) {
      std::cout << "seed " << Seed << ": " << Wrong << "\n" << std::flush;
      ++Finds;
    }
    if (!S.Resume.empty())
      std::ofstream(S.Resume) << Seed << "\n";
  }
  std::cout << Done << " cases up to seed " << Seed - 1 << ", " << Finds
            << " finds\n";
  return Finds == 0 ? 0 : 1;
}

} // namespace vorion::test
