//===- RemarkHandler.h - what passes in PoCL tell of their decisions ------===//

#ifndef POCL_REMARK_HANDLER_H
#define POCL_REMARK_HANDLER_H

#include <llvm/IR/DiagnosticHandler.h>

#include <memory>

namespace llvm {
class DiagnosticPrinter;
} // namespace llvm

namespace pocl {

/// Prints those remarks of our passes to standard error that -Rpass-missed= in
/// the variable VORION_REMARKS asks for, and all else that LLVM tells to \p
/// Log. LLVM's own remarks come from the machine's compiler alone.
std::unique_ptr<llvm::DiagnosticHandler>
createRemarkHandler(llvm::DiagnosticPrinter &Log);

} // namespace pocl

#endif
