//===- SimtMeetings.h - lanes meet before the group decides ---------------===//

#ifndef POCL_SIMT_MEETINGS_H
#define POCL_SIMT_MEETINGS_H

#include "config.h"

#include <llvm/IR/PassManager.h>
#include <llvm/Passes/PassBuilder.h>

namespace pocl {

/// Lanes that part meet where all their ways come together. A jump on which the
/// whole group agrees can lie on some of these ways and lead around that place:
///
///     if (odd) { a(); if (all) break; } else { b(); if (all) break; }
///     barrier();
///
/// Then the lanes would come to the barrier one side after the other. On a
/// device with lanes, all ways out of such a conditional lead to one block
/// first, which goes on to where the group agreed to go. Where the group need
/// not agree, because a barrier lies on one of the ways and nobody need come to
/// it, the kernel runs in rounds (SimtRounds.h).
///
/// Likewise a loop that begins where one with barriers begins gets a head of
/// its own, so that lanes that go round the inner loop apart do not pass the
/// outer one's head.
class SimtMeetings : public llvm::PassInfoMixin<SimtMeetings> {
public:
  static void registerWithPB(llvm::PassBuilder &PB);
  llvm::PreservedAnalyses run(llvm::Function &F,
                              llvm::FunctionAnalysisManager &AM);
  static bool isRequired() { return true; }
};

} // namespace pocl

#endif
