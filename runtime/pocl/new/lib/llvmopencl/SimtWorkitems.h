//===- SimtWorkitems.h - work-items on the lanes of a warp ----------------===//
//
// A device whose core runs a group on one warp of lanes (module property
// device_simt_lanes) executes the work-items of a group in passes: pass p gives
// lane l the work-item with linear id p * lanes + l. The group starts with a
// mask of min(lanes, items) lanes, so that every active lane has a work-item
// in the first pass. docs/adr/0006-work-item-loops.md gives the rules.
//
// WorkitemLoops uses SimtLoops where it would otherwise build its x, y, z
// loops; the rest of PoCL's region handling is unchanged. PoCL's own passes
// include this header alone.
//
//===----------------------------------------------------------------------===//

#ifndef POCL_SIMT_WORKITEMS_H
#define POCL_SIMT_WORKITEMS_H

#include "InlineFunctions.h"
#include "SimtBarriers.h"
#include "SimtInstructions.h"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

#include <set>
#include <vector>

namespace llvm {
class PassBuilder;
}

namespace pocl {

/// Pseudo variable: where the core's share of launch->context begins. The
/// Workgroup pass replaces loads of it.
inline constexpr const char *SimtContextGlobal = "_simt_context";

/// Module property: bytes a work-item keeps in the context.
inline constexpr const char *SimtContextBytes = "simt_context_bytes";

/// Module property: set if barriers could not be mapped to loops.
inline constexpr const char *SimtFailure = "simt_failure";

/// Lanes of a warp; 0 on devices that run work-items one after the other.
unsigned simtLanes(const llvm::Module &M);

/// The group size is known and no larger than a warp: there are no loops, a
/// work-item is a lane.
bool fitsOneWarp(const llvm::Module &M);

/// To the optimisation of a whole program in the front end: says first that
/// local variables are shared.
void addFirstSimtPasses(llvm::PassBuilder &PB);

/// To one kernel's module, before any other pass, the same; and makes kernels
/// work on their own copy of a by-value structure that they change; all
/// work-items share the one in the argument buffer.
void prepareSimtModule(llvm::Module &M);

/// Whether the work-item is one of the group's first pass.
llvm::Value *createIsFirstPass(llvm::IRBuilder<> &Builder);

/// What kernels ask of a launch block.
enum class LaunchField {
  NumGroups,
  GlobalOffset,
  LocalSize,
  WorkDim,
  Variables
};

/// \p Index: within a field of three, else -1.
llvm::Value *createLaunchLoad(llvm::IRBuilder<> &Builder, llvm::Value *Launch,
                              LaunchField Field, int Index);

/// What SimtContextGlobal stands for.
llvm::Value *createContextBase(llvm::IRBuilder<> &Builder, llvm::Module &M,
                               llvm::Value *Launch);

/// Builds the loops of one kernel.
class SimtLoops {
public:
  /// Sizes: of the group, unless they are known at run time only.
  struct GroupSize {
    uint64_t X, Y, Z;
    bool Dynamic;
    uint64_t items() const { return X * Y * Z; }
  };
  /// Three ids, or variables of them.
  struct LocalIds {
    llvm::Value *X, *Y, *Z;
  };

  /// \p Ids: the pseudo variables _local_id_x, _y, _z.
  SimtLoops(llvm::Function &F, unsigned Lanes, GroupSize Size, LocalIds Ids);

  /// Code at the kernel's entry; call before anything below.
  void begin();

  /// The linear id of the current work-item.
  llvm::Value *linearId(llvm::IRBuilder<> &Builder);

  /// Memory of one value a work-item, indexed by linear id; the size of
  /// \p Element is a multiple of \p Alignment. finish() decides where it lies.
  llvm::AllocaInst *createContextArray(llvm::Type *Element,
                                       llvm::Align Alignment,
                                       const std::string &Name);

  /// Runs [Entry, Exit] once for each work-item; with \p PeeledFirst for those
  /// that follow the first pass. Only edges from blocks outside \p InRegion are
  /// redirected. Returns the first and last block of the loop.
  template <typename RegionT>
  std::pair<llvm::BasicBlock *, llvm::BasicBlock *>
  createLoop(RegionT &Region, llvm::BasicBlock *Entry, llvm::BasicBlock *Exit,
             bool PeeledFirst) {
    std::set<llvm::BasicBlock *> InRegion(Region.begin(), Region.end());
    return createLoopAround(InRegion, Entry, Exit, PeeledFirst);
  }

  /// Makes \p Entry the start of a first pass outside any loop.
  void setFirstPass(llvm::BasicBlock *Entry);

  /// The branch decides between regions: every work-item takes the same way.
  void makeUniform(llvm::Instruction *Terminator);

  /// In the loop over later passes of a region, \p Block decided between this
  /// region and others: ways to these, which PoCL has cut off, trap.
  void trapElsewhere(llvm::BasicBlock &Block);

  /// A branch between regions takes the way of one pass. This makes all passes
  /// note, at the \p Exit of the region that computes the \p Condition, whether
  /// theirs is the first one's, and the branch trap if one is not. A condition
  /// that does not reach the exit on every way is not checked. Call before
  /// createLoop().
  void checkAgreement(llvm::Instruction *Terminator,
                      llvm::Instruction *Condition, llvm::BasicBlock *Exit);

  /// Ends the work; call after anything above.
  void finish();

private:
  std::pair<llvm::BasicBlock *, llvm::BasicBlock *>
  createLoopAround(const std::set<llvm::BasicBlock *> &InRegion,
                   llvm::BasicBlock *Entry, llvm::BasicBlock *Exit,
                   bool PeeledFirst);
  void answerFirstPass();
  /// Gives variables of the loops' bodies fixed places in the lane's frame.
  void tidyAllocas();
  /// Tells the optimiser that context arrays are apart from each other and from
  /// everything else, so that values stay in registers within loops.
  void tellAliases();
  /// Gives context arrays their memory. Bytes a work-item.
  uint64_t placeContextArrays();
  bool mayStraddle() const;
  LocalIds divideIds(llvm::IRBuilder<> &Builder, llvm::Value *Base);
  LocalIds countIds(llvm::IRBuilder<> &Builder, const LocalIds &Of);
  LocalIds load(llvm::IRBuilder<> &Builder, const LocalIds &From);
  void store(llvm::IRBuilder<> &Builder, const LocalIds &Values,
             const LocalIds &To);
  llvm::Value *anyLeft(llvm::IRBuilder<> &Builder, llvm::Value *Base,
                       llvm::Value *Linear);
  llvm::Constant *number(uint64_t N) const;

  struct ContextArray {
    llvm::AllocaInst *Placeholder;
    llvm::Align Alignment;
  };

  llvm::Function &F;
  llvm::Module &M;
  unsigned Lanes;
  GroupSize Size;
  LocalIds Ids;
  /// Ids are counted from pass to pass instead of divided in each.
  bool Straddle;
  llvm::AllocaInst *NextLinear = nullptr; ///< linear id in the pass that comes
  LocalIds Next = {};                     ///< variables: the ids in it
  LocalIds Step = {};                     ///< what a pass adds to the ids
  llvm::Type *SizeT;
  llvm::AllocaInst *BaseVar = nullptr;   ///< linear id of the pass's lane 0
  llvm::AllocaInst *LinearVar = nullptr; ///< linear id of the work-item
  llvm::Value *Lane = nullptr;
  llvm::Value *SizeX = nullptr, *SizeY = nullptr, *Items = nullptr;
  std::vector<ContextArray> ContextArrays;
};

} // namespace pocl

#endif
