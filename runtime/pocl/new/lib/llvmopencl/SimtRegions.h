//===- SimtRegions.h - what the regions of a kernel share, for lanes ------===//
//
// A region is what lies between two barriers. WorkitemLoops makes a loop of
// each; on a device with lanes it asks here which variables need no place for
// each work-item, and which branches decide what region comes next.
//
//===----------------------------------------------------------------------===//

#ifndef POCL_SIMT_REGIONS_H
#define POCL_SIMT_REGIONS_H

#include "ParallelRegion.h"
#include "SimtInstructions.h"

#include <set>
#include <vector>

namespace llvm {
class AllocaInst;
class LoopInfo;
} // namespace llvm

namespace pocl {

class VariableUniformityAnalysisResult;

class SimtRegions {
public:
  /// \p Regions of one kernel, which must outlive this.
  explicit SimtRegions(const ParallelRegion::ParallelRegionVector &Regions)
      : Regions(Regions) {}

  /// Leaves less to keep across barriers.
  void arrangeSlots(llvm::Function &F, llvm::LoopInfo &Loops,
                    VariableUniformityAnalysisResult &Uniformity);

  /// Whether \p Variable keeps nothing of a work-item's own across barriers:
  /// its place may be the lane's, which its work-items share one after the
  /// other. Call after arrangeSlots().
  bool isOfLane(llvm::AllocaInst *Variable) const {
    return isLaneVariable(*Variable) || Shared.count(Variable) ||
           onlyRegionUsing(Variable);
  }

  /// The branches of \p F that decide between regions: those in blocks between
  /// regions, and in a region those that lead into another one that begins with
  /// the same block.
  std::set<llvm::Instruction *> decisions(llvm::Function &F) const;

  /// A decision and what it decides by; if it lies between regions also the
  /// last block of the region that computes that, else null.
  struct Doubt {
    llvm::Instruction *Decision, *Condition;
    llvm::BasicBlock *Exit;
  };
  /// Those on which the group is not known to agree, in the order of the code.
  std::vector<Doubt>
  doubtful(llvm::Function &F, const std::set<llvm::Instruction *> &Decisions,
           VariableUniformityAnalysisResult &Uniformity) const;

private:
  ParallelRegion *regionOf(llvm::BasicBlock *Block) const;
  /// The one region in which the private variable is used; null if there are
  /// several, or if it cannot be known.
  ParallelRegion *onlyRegionUsing(llvm::AllocaInst *Variable) const;

  const ParallelRegion::ParallelRegionVector &Regions;
  /// Variables in which the whole group agrees, so that one will do.
  std::set<llvm::AllocaInst *> Shared;
};

} // namespace pocl

#endif
