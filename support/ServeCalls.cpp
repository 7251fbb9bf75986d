#include "vorion/support/ServeCalls.h"

#include "vorion/support/ToolMessages.h"

#include <array>
#include <cstdio>
#include <fcntl.h>
#include <poll.h>
#include <string>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

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

int serveCalls(char *Name, const std::function<int(std::span<char *>)> &Call) {
  const pid_t Child = ::fork();
  if (Child != 0)
    return Child < 0 ? 1 : 0;
  // Away from the terminal's signals, and from what the client has open.
  ::setsid();
  constexpr int Socket = STDERR_FILENO + 1;
  if (::dup3(STDIN_FILENO, Socket, O_CLOEXEC) < 0)
    return 1;
  ::close_range(Socket + 1, ~0U, 0);
  ::close(STDIN_FILENO);
  if (::open("/dev/null", O_RDONLY) != STDIN_FILENO)
    return 1;
  Printed Output;
  if (!Output.good())
    return 1;
  while (isCalled(Socket)) {
    const auto Text = receiveText(Socket);
    if (!Text)
      break;
    std::vector<std::string> Arguments = argumentsOf(*Text);
    std::vector<char *> All{Name};
    for (std::string &Argument : Arguments)
      All.push_back(Argument.data());
    const int Code = Call(All);
    std::fflush(nullptr);
    if (!sendText(Socket, std::to_string(Code) + " " + Output.take()) ||
        Code != 0 || hasMuchMemory())
      break;
  }
  return 0;
}

} // namespace vorion
