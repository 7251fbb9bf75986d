#include "vorion/support/ServeCalls.h"

#include "vorion/support/ToolMessages.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iterator>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
extern "C" { // which glibc 2.36 lacks
#include <sys/pidfd.h>
}

namespace vorion {
namespace {

constexpr int IdleMilliseconds = 10'000;
/// Of memory that the process ever had, KiB.
constexpr long MostMemory = 512L << 10;
/// Where the process that serves has its socket.
constexpr int Socket = STDERR_FILENO + 1;

bool isCalled() {
  pollfd Wanted{Socket, POLLIN, 0};
  return ::poll(&Wanted, 1, IdleMilliseconds) > 0;
}

bool hasMuchMemory() {
  rusage Used{};
  ::getrusage(RUSAGE_SELF, &Used);
  return Used.ru_maxrss > MostMemory;
}

/// What is printed goes to a file in memory, which both processes have.
bool redirectOutput() {
  const int Printed = ::memfd_create("printed", 0);
  return Printed >= 0 && ::dup2(Printed, STDERR_FILENO) >= 0 &&
         ::close(Printed) == 0;
}

int serve(const std::function<Response(std::string_view)> &Answer) {
  if (::dup3(STDIN_FILENO, Socket, O_CLOEXEC) < 0)
    return 1;
  ::close_range(Socket + 1, ~0U, 0);
  for (const int Stream : {STDIN_FILENO, STDOUT_FILENO}) {
    ::close(Stream);
    if (::open("/dev/null", O_RDWR) != Stream)
      return 1;
  }
  while (isCalled()) {
    const auto Request = receiveText(Socket);
    if (!Request)
      break;
    const Response Given = Answer(*Request);
    std::fflush(nullptr);
    if (!sendText(Socket, Given.Text) || !Given.MayStay || hasMuchMemory())
      break;
  }
  return 0;
}

/// Waits for the process that serves, and ends it when the client is gone,
/// whatever it is doing. What it runs ends with it. Nothing is open but what
/// tells the client.
int watch(pid_t Server) {
  ::close(STDIN_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  pollfd Ends[] = {{STDOUT_FILENO, POLLRDHUP, 0},
                   {::pidfd_open(Server, 0), POLLIN, 0}};
  while (::poll(Ends, std::size(Ends), -1) < 0 && errno == EINTR) {
  }
  ::kill(-Server, SIGKILL);
  ServerEnd End;
  while (::waitpid(Server, &End.WaitStatus, 0) < 0 && errno == EINTR) {
  }
  End.Printed = takePrinted();
  sendText(STDOUT_FILENO, textOf(End));
  return 0;
}

} // namespace

std::string takePrinted() {
  std::string Text;
  std::array<char, 4096> Part{};
  ::lseek(STDERR_FILENO, 0, SEEK_SET);
  for (ssize_t Got;
       (Got = ::read(STDERR_FILENO, Part.data(), Part.size())) > 0;)
    Text.append(Part.data(), static_cast<std::size_t>(Got));
  static_cast<void>(::ftruncate(STDERR_FILENO, 0));
  ::lseek(STDERR_FILENO, 0, SEEK_SET);
  return Text;
}

int serveCalls(const std::function<Response(std::string_view)> &Answer) {
  const pid_t Child = ::fork();
  if (Child != 0)
    return Child < 0 ? 1 : 0;
  // Away from the terminal's signals.
  ::setsid();
  if (!redirectOutput())
    return 1;
  const pid_t Server = ::fork();
  if (Server < 0)
    return 1;
  // A process group with what it runs, whichever process comes first.
  ::setpgid(Server, Server);
  return Server == 0 ? serve(Answer) : watch(Server);
}

} // namespace vorion
