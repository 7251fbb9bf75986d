#include "vorion/support/ServeCalls.h"

#include "vorion/support/ToolMessages.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace vorion {
namespace {

constexpr int IdleMilliseconds = 10'000;
/// Of memory that the process ever had, KiB.
constexpr long MostMemory = 512L << 10;

/// Where what is printed goes meanwhile.
class Printed {
public:
  Printed() : File(::memfd_create("printed", MFD_CLOEXEC)) {
    for (const int Stream : {STDOUT_FILENO, STDERR_FILENO})
      ::dup2(File, Stream);
  }
  bool good() const { return File >= 0; }
  /// What was printed since the last time.
  std::string take() {
    std::string Text;
    std::array<char, 4096> Part;
    ::lseek(File, 0, SEEK_SET);
    for (ssize_t Got; (Got = ::read(File, Part.data(), Part.size())) > 0;)
      Text.append(Part.data(), static_cast<std::size_t>(Got));
    static_cast<void>(::ftruncate(File, 0));
    ::lseek(File, 0, SEEK_SET);
    return Text;
  }

private:
  int File;
};

bool isCalled(int Socket) {
  pollfd Wanted{Socket, POLLIN, 0};
  return ::poll(&Wanted, 1, IdleMilliseconds) > 0;
}

bool hasMuchMemory() {
  rusage Used{};
  ::getrusage(RUSAGE_SELF, &Used);
  return Used.ru_maxrss > MostMemory;
}

} // namespace

int serveCalls(const std::function<int(std::vector<std::string>)> &Call) {
  const pid_t Child = ::fork();
  if (Child != 0)
    return Child < 0 ? 1 : 0;
  // Away from the terminal's signals, and from what the client has open.
  ::setsid();
  const int Socket = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  if (Socket < 0 || ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO) < 0)
    return 1;
  const int Lowest = ::dup3(Socket, 3, O_CLOEXEC) < 0 ? Socket : 3;
  ::close_range(static_cast<unsigned>(Lowest) + 1, ~0U, 0);
  Printed Output;
  if (!Output.good())
    return 1;
  while (isCalled(Lowest)) {
    const auto Text = receiveText(Lowest);
    if (!Text)
      break;
    const int Code = Call(argumentsOf(*Text));
    std::fflush(nullptr);
    if (!sendText(Lowest, std::to_string(Code) + " " + Output.take()) ||
        Code != 0 || hasMuchMemory())
      break;
  }
  return 0;
}

} // namespace vorion
