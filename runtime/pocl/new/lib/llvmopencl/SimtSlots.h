//===- SimtSlots.h - fewer values to keep across barriers -----------------===//
//
// PHI nodes have become variables of a work-item ("slots") when regions are
// made. What a region leaves to another is kept in memory, so a value that is
// read from a slot in one region for use in another, and one that is computed
// in one region and put into the slot in another, would be kept twice.
//
//===----------------------------------------------------------------------===//

#ifndef POCL_SIMT_SLOTS_H
#define POCL_SIMT_SLOTS_H

#include <functional>

namespace llvm {
class AllocaInst;
class BasicBlock;
class Function;
class LoopInfo;
} // namespace llvm

namespace pocl {

/// Whether a region has both blocks; asked of one block, whether any has it.
using ShareRegion = std::function<bool(llvm::BasicBlock *, llvm::BasicBlock *)>;

/// Reads slots in the region that uses the value, and writes them in the one
/// that computes it, where nothing between can tell. \p IsKept: whether the
/// slot is kept in memory for each work-item; others are left alone.
void shortenSlots(llvm::Function &F, llvm::LoopInfo &Loops,
                  const ShareRegion &Share,
                  const std::function<bool(llvm::AllocaInst *)> &IsKept);

/// Whether no region both reads and writes \p Slot: if its values are the same
/// for the whole group, passes over the group can then share it.
bool readsApartFromWrites(llvm::AllocaInst *Slot, const ShareRegion &Share);

} // namespace pocl

#endif
