// What every tool's --version says of us, after LLVM's own lines.
#include "vorion/support/Version.h"

#include "llvm/Support/CommandLine.h"
#include "llvm/Support/raw_ostream.h"

static const bool Registered = [] {
  llvm::cl::AddExtraVersionPrinter([](llvm::raw_ostream &Out) {
    Out << vorion::versionLine(VORION_TOOL) << "\n";
  });
  return true;
}();
