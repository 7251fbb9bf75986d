#include "SpirvTranslator.h"

#include "MemoryFile.h"

#include "llvm/Support/Program.h"

#include <array>
#include <cstring>
#include <optional>

namespace vorion {

namespace {

constexpr std::string_view Refused = "the module cannot be translated: ";

/// What the translator printed, without what is for its authors.
std::string printedIn(const MemoryFile &File) {
  const std::string Printed = File.contents();
  return Printed.substr(0, Printed.find("PLEASE submit"));
}

} // namespace

Translation translateSpirv(const std::string &Module) {
  const MemoryFile In(Module), Out, Printed;
  for (const MemoryFile *File : {&In, &Out, &Printed})
    if (const int Problem = File->problem())
      return {{}, std::string(strerror(Problem)) + ", expected memory"};
  // With version 2.0 of OpenCL, atomics are those of its memory model.
  const std::array<llvm::StringRef, 7> Call = {VORION_LLVM_SPIRV,
                                               "--spirv-target-env=CL2.0",
                                               "--spirv-gen-kernel-arg-name-md",
                                               "-r",
                                               "-o",
                                               "-",
                                               "/dev/stdin"};
  const std::string Files[] = {In.path(), Out.path(), Printed.path()};
  const std::optional<llvm::StringRef> Redirects[] = {Files[0], Files[1],
                                                      Files[2]};
  std::string Problem;
  bool CannotRun = false;
  if (llvm::sys::ExecuteAndWait(Call[0], Call, std::nullopt, Redirects, 0, 0,
                                &Problem, &CannotRun) == 0)
    return {Out.contents(), {}};
  const std::string Said = printedIn(Printed);
  if (CannotRun || Said.empty())
    return {{}, "cannot run " VORION_LLVM_SPIRV ": " + Problem};
  return {{}, std::string(Refused) + Said};
}

} // namespace vorion
