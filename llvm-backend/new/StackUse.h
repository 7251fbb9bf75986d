//===- StackUse.h - what each function takes of a lane's stack --*- C++ -*-===//

#ifndef VORION_LLVM_BACKEND_STACKUSE_H
#define VORION_LLVM_BACKEND_STACKUSE_H

namespace llvm {
class MachineFunction;

namespace vorion {

/// Records what \p MF, which is about to be emitted, takes of a lane's stack
/// and which functions it calls.
void recordStackUse(MachineFunction &MF);

} // namespace vorion
} // namespace llvm

#endif
