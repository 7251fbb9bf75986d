#include "view/Interrupt.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace vorion::splat {

namespace {

/// A handler may do little more than write into a pipe.
std::array<int, 2> Pipe{-1, -1};
constexpr char Signalled = 's', Ended = 'e';

void tell(char What) {
  const int Kept = errno;
  // Nobody is left to hear that it failed.
  if (write(Pipe[1], &What, 1) != 1)
    errno = Kept;
  errno = Kept;
}

void onSignal(int /*Number*/) { tell(Signalled); }

void handle(void (*Handler)(int)) {
  struct sigaction Action{};
  Action.sa_handler = Handler;
  Action.sa_flags = SA_RESTART | SA_RESETHAND;
  for (const int Number : {SIGINT, SIGTERM})
    sigaction(Number, &Action, nullptr);
}

} // namespace

Interrupt::Interrupt(std::function<void()> OnSignal) {
  if (pipe2(Pipe.data(), O_CLOEXEC) != 0)
    return; // signals then end the process as they do without this
  Waiter = std::thread([OnSignal = std::move(OnSignal)] {
    char What = Ended;
    while (read(Pipe[0], &What, 1) < 0 && errno == EINTR)
      ;
    if (What == Signalled)
      OnSignal();
  });
  handle(onSignal);
}

Interrupt::~Interrupt() {
  if (!Waiter.joinable())
    return;
  handle(SIG_DFL);
  tell(Ended);
  Waiter.join();
  for (int &End : Pipe)
    close(std::exchange(End, -1));
}

} // namespace vorion::splat
