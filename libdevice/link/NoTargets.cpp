// lld initializes all targets of the installed LLVM before it compiles bitcode,
// which it does not here (NoBitcode.cpp). A target that the program contains
// replaces its function.
extern "C" {
#define LLVM_TARGET(Name)                                                      \
  [[gnu::weak]] void LLVMInitialize##Name##TargetInfo() {}                     \
  [[gnu::weak]] void LLVMInitialize##Name##Target() {}                         \
  [[gnu::weak]] void LLVMInitialize##Name##TargetMC() {}
#include "llvm/Config/Targets.def"
#define LLVM_ASM_PRINTER(Name)                                                 \
  [[gnu::weak]] void LLVMInitialize##Name##AsmPrinter() {}
#include "llvm/Config/AsmPrinters.def"
#define LLVM_ASM_PARSER(Name)                                                  \
  [[gnu::weak]] void LLVMInitialize##Name##AsmParser() {}
#include "llvm/Config/AsmParsers.def"
}
