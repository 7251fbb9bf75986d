// A limit of the size of files (ulimit -f) is an error of the write. LLVM takes
// its signal for a crash of LLVM's own: it installs all its handlers once, when
// the first function is added that a crash is to call.
#include "llvm/Support/Signals.h"

#include <csignal>

static const bool Ignored = [] {
  llvm::sys::AddSignalHandler([](void *) {}, nullptr);
  return std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR;
}();
