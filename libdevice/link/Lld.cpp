#include "Lld.h"

#include "lld/Common/Driver.h"
#include "lld/Common/ErrorHandler.h"
#include "llvm/Support/raw_ostream.h"

LLD_HAS_DRIVER(elf)

void vorion::link::runLld(const std::vector<std::string> &Arguments) {
  std::vector<const char *> Argv;
  Argv.reserve(Arguments.size());
  for (const std::string &Argument : Arguments)
    Argv.push_back(Argument.c_str());
  const bool Linked = lld::elf::link(Argv, llvm::outs(), llvm::errs(),
                                     /*exitEarly=*/true,
                                     /*disableOutput=*/false);
  lld::exitLld(Linked ? 0 : 1);
}
