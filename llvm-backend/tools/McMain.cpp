// llvm-mc assembles for its host where no target is named. This program has one
// target, the machine's, and names it before it calls llvm-mc's main.
#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/TargetParser/RISCVTargetParser.h"

#include <optional>
#include <string>
#include <vector>

int llvmMcMain(int Argc, char **Argv);

using llvm::StringRef;

/// The value of the option \p Name, with one dash or two, in its argument or in
/// the next one.
static std::optional<StringRef> valueOf(llvm::ArrayRef<char *> Arguments,
                                        StringRef Name) {
  for (std::size_t I = 1; I < Arguments.size(); ++I) {
    StringRef A = Arguments[I];
    if (!A.consume_front("-"))
      continue;
    A.consume_front("-");
    if (!A.consume_front(Name))
      continue;
    if (A.consume_front("="))
      return A;
    if (A.empty())
      return I + 1 < Arguments.size() ? Arguments[I + 1] : A;
  }
  return std::nullopt;
}

int main(int Argc, char **Argv) {
  std::vector<char *> Arguments(Argv, Argv + Argc);
  std::string Triple = "--triple=riscv32-unknown-elf", Cpu = "--mcpu=vorion",
              Attributes = "--riscv-add-build-attributes";
  if (!valueOf(Arguments, "triple") && !valueOf(Arguments, "arch")) {
    const auto Named = valueOf(Arguments, "mcpu");
    if (!Named) {
      Arguments.push_back(Cpu.data());
    } else if (*Named != "vorion" && *Named != "help" &&
               !llvm::RISCV::parseCPU(*Named, /*IsRV64=*/false)) {
      llvm::errs() << "vorion-mc: error: --mcpu " << *Named
                   << ": unknown processor, expected vorion or another of 32 "
                      "bits\n";
      return 1;
    }
    // Without them other tools do not know an object's instructions.
    if (valueOf(Arguments, "filetype") == "obj" &&
        !valueOf(Arguments, "riscv-add-build-attributes"))
      Arguments.push_back(Attributes.data());
    Arguments.push_back(Triple.data());
  }
  return llvmMcMain(int(Arguments.size()), Arguments.data());
}
