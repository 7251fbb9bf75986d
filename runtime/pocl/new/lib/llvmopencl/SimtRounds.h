//===- SimtRounds.h - a kernel as rounds from barrier to barrier ----------===//

#ifndef POCL_SIMT_ROUNDS_H
#define POCL_SIMT_ROUNDS_H

#include <llvm/ADT/StringRef.h>

namespace llvm {
class Function;
class Module;
} // namespace llvm

namespace pocl {

/// Rewrites a kernel as a loop. Each round runs what lies between the barrier
/// that the group has come to and the next ones:
///
///     place = start;
///     do {
///       barrier();
///       switch (place) {
///       case start: ...; place = barrier 1; break;
///       case barrier 1: ...; if (...) place = barrier 1 else place = end;
///       }
///     } while (place != end);
///
/// Lanes that part within a round meet at its end at the latest, however the
/// kernel's ways run. So this is right for every kernel whose work-items come
/// to the same barriers. Each round has a copy of all that it may reach, and a
/// value that lives across a barrier is chosen at the head of the loop. So a
/// kernel that lanes can run as it is written is faster that way.
void runInRounds(llvm::Function &F);

/// The same for a kernel from which single work-items return while others of
/// the group go on. Those that have returned go through the further rounds
/// without doing anything. The others agree where the group goes on.
void runInRoundsOfSome(llvm::Function &F);

/// Says why a kernel runs in rounds, and in which of its lines that begins (0:
/// not known), to the machine's compiler, which is to tell it
/// (llvm-backend/new/Resources.cpp): the kernel itself becomes a part of
/// others.
void keepReasonOfRounds(llvm::Module &M, llvm::StringRef Reason, unsigned Line);

/// Whether the barriers of a module's kernel could not be mapped to loops over
/// work-items, and it does not run in rounds. Then the kernel is to be made
/// again from the beginning, after askForRounds().
bool needsRounds(const llvm::Module &M);
void askForRounds(llvm::Module &M);
bool areRoundsAskedFor(const llvm::Module &M);

} // namespace pocl

#endif
