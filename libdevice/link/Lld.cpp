#include "Lld.h"

#include "lld/Common/CommonLinkerContext.h"
#include "lld/Common/Driver.h"
#include "lld/Common/ErrorHandler.h"
#include "llvm/Support/raw_ostream.h"

LLD_HAS_DRIVER(elf)

namespace vorion::link {

static bool link(const std::vector<std::string> &Arguments,
                 llvm::raw_ostream &Messages, bool EndEarly) {
  std::vector<const char *> Argv;
  Argv.reserve(Arguments.size());
  for (const std::string &Argument : Arguments)
    Argv.push_back(Argument.c_str());
  return lld::elf::link(Argv, llvm::outs(), Messages, EndEarly,
                        /*disableOutput=*/false);
}

void runLld(const std::vector<std::string> &Arguments) {
  lld::exitLld(link(Arguments, llvm::errs(), /*EndEarly=*/true) ? 0 : 1);
}

bool callLld(const std::vector<std::string> &Arguments,
             llvm::raw_ostream &Messages) {
  const bool Linked = link(Arguments, Messages, /*EndEarly=*/false);
  lld::CommonLinkerContext::destroy();
  return Linked;
}

} // namespace vorion::link
