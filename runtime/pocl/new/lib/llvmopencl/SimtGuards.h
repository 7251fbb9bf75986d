//===- SimtGuards.h - work-items that have returned go along --------------===//

#ifndef POCL_SIMT_GUARDS_H
#define POCL_SIMT_GUARDS_H

namespace llvm {
class DebugLoc;
class Function;
} // namespace llvm

namespace pocl {

/// Changes a kernel from which work-items return before barriers, so that they
/// come to all barriers of the others:
///
///     bool gone = i >= n;
///     if (!gone) t[l] = a[i];
///     barrier();
///     for (uint s = k; s > 0; s /= 2) {
///       if (!gone && l < s) t[l] += t[l + s];
///       barrier();
///     }
///
/// What the whole group computes alike and without memory, such as \c s, is
/// computed by those that have returned, too: so they go as many rounds. What
/// all read from memory, such as a length, the others tell them
/// (SimtAgreement.h). False, and nothing of importance changed, if the way to a
/// barrier depends on anything else (then see SimtRounds.h). \p Obstacle: then,
/// where it does, if that is known.
bool guardReturned(llvm::Function &F, llvm::DebugLoc &Obstacle);

} // namespace pocl

#endif
