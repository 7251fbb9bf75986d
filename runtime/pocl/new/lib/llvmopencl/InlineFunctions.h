//===- InlineFunctions.h - functions that are declared inline ---*- C++ -*-===//

#ifndef POCL_INLINEFUNCTIONS_H
#define POCL_INLINEFUNCTIONS_H

#include <llvm/IR/PassManager.h>

namespace pocl {

/// The text of the mark below.
inline constexpr const char *InlineNote = "vorion.inline";

/// What stands for `inline` in a program's source: the front end would leave
/// out such functions, and a call that is not inlined would have nowhere to go.
inline constexpr const char *InlineMark =
    "__attribute__((annotate(\"vorion.inline\")))";

/// Gives each function with that mark to the program, as one of perhaps
/// several equal definitions (C99, 6.7.4): another program that is linked with
/// it may have the function, too. Takes all notes of the module away: no other
/// means anything to the machine.
void defineInlineFunctions(llvm::Module &M);

/// defineInlineFunctions as a pass.
class DefineInlineFunctions
    : public llvm::PassInfoMixin<DefineInlineFunctions> {
public:
  llvm::PreservedAnalyses run(llvm::Module &M, llvm::ModuleAnalysisManager &) {
    defineInlineFunctions(M);
    return llvm::PreservedAnalyses::all();
  }
  static bool isRequired() { return true; }
};

} // namespace pocl

#endif
