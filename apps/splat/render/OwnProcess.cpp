#include "render/OwnProcess.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vorion::splat {

namespace {

/// A result as bytes: the exit code, and the text or the parts of the error.
std::string packed(const Expected<std::string> &Result) {
  if (Result)
    return '\0' + *Result;
  const Error &E = Result.error();
  return static_cast<char>(E.Code) + E.Where + '\0' + E.What;
}

Expected<std::string> unpacked(const std::string &Bytes) {
  const auto Code = static_cast<ExitCode>(static_cast<unsigned char>(Bytes[0]));
  if (Code == ExitCode::Ok)
    return Bytes.substr(1);
  const std::size_t End = Bytes.find('\0', 1);
  return Error{Bytes.substr(1, End - 1), Bytes.substr(End + 1), Code};
}

void writeAll(int To, const std::string &Bytes) {
  for (std::size_t At = 0; At < Bytes.size();) {
    const ssize_t Done = write(To, Bytes.data() + At, Bytes.size() - At);
    if (Done < 0 && errno != EINTR)
      return; // what is missing tells
    At += static_cast<std::size_t>(std::max<ssize_t>(Done, 0));
  }
}

std::string readAll(int From) {
  std::string Bytes;
  std::array<char, 4096> Part{};
  for (;;) {
    const ssize_t Got = read(From, Part.data(), Part.size());
    if (Got < 0 && errno == EINTR)
      continue;
    if (Got <= 0)
      return Bytes;
    Bytes.append(Part.data(), static_cast<std::size_t>(Got));
  }
}

} // namespace

Expected<std::string>
inOwnProcess(const std::function<Expected<std::string>()> &Work) {
  std::array<int, 2> Ends{};
  const auto Failed = [](const char *What) {
    return Error{"",
                 fmt::format("cannot {}: {}, expected a process for each frame",
                             What, std::strerror(errno)),
                 ExitCode::Internal};
  };
  if (pipe(Ends.data()) != 0)
    return Failed("make a pipe");
  const pid_t Child = fork();
  if (Child == 0) {
    close(Ends[0]);
    writeAll(Ends[1], packed(Work()));
    // Not what ends this process's parent: its files and reports are its own.
    _exit(0);
  }
  close(Ends[1]);
  if (Child < 0) {
    close(Ends[0]);
    return Failed("start a process");
  }
  const std::string Bytes = readAll(Ends[0]);
  close(Ends[0]);
  int Status = 0;
  while (waitpid(Child, &Status, 0) < 0 && errno == EINTR) {
  }
  if (Bytes.empty() || !WIFEXITED(Status) || WEXITSTATUS(Status) != 0)
    return Error{"",
                 fmt::format("a process ended with status {} and no result, "
                             "expected one",
                             Status),
                 ExitCode::Internal};
  return unpacked(Bytes);
}

} // namespace vorion::splat
