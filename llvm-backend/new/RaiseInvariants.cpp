//===- RaiseInvariants.cpp - sums in front of loops, not their terms ------===//
//
// LLVM's induction-variable simplification sinks what a loop does not use
// behind it, one instruction at a time, to have one value less alive inside.
// A sum of twenty products goes the same way, and then twenty terms are alive
// in place of one. Nothing brings them back. This step does, where fewer values
// are then alive across the loop.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "Remarks.h"
#include "llvm/ADT/EquivalenceClasses.h"
#include "llvm/ADT/SetVector.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/Instructions.h"
#include "llvm/Support/CommandLine.h"

using namespace llvm;

static cl::opt<bool> Enabled("vorion-raise-invariants", cl::Hidden,
                             cl::init(true),
                             cl::desc("Raise sums in front of loops again"));

namespace {

/// Moves from behind one loop to in front of it.
class Raiser {
public:
  Raiser(const Loop &L, const LoopInfo &Loops, const DominatorTree &Dominators,
         BasicBlock &Before, BasicBlock &Behind)
      : L(L), Loops(Loops), Dominators(Dominators), Before(Before),
        Behind(Behind) {}

  bool run() {
    for (Instruction &I : Behind)
      if (canRaise(I))
        Raisable.insert(&I);
    // What shares a term is raised together or not at all.
    EquivalenceClasses<Instruction *> Sums;
    for (Instruction *I : Raisable) {
      Sums.insert(I);
      for (Value *V : I->operands())
        if (auto *Term = dyn_cast<Instruction>(V);
            Term && (Raisable.contains(Term) || mayEnd(*Term)))
          Sums.unionSets(I, Term);
    }
    SmallPtrSet<const Instruction *, 16> Worthwhile;
    int Gain = 0;
    for (auto Sum = Sums.begin(); Sum != Sums.end(); ++Sum)
      if (const int Fewer = Sum->isLeader() ? gain(Sums, Sum) : 0; Fewer > 0) {
        Gain += Fewer;
        for (auto M = Sums.member_begin(Sum); M != Sums.member_end(); ++M)
          Worthwhile.insert(*M);
      }
    Raisable.remove_if([&](Instruction *I) { return !Worthwhile.contains(I); });
    if (Raisable.empty())
      return false;
    vorion::remark<OptimizationRemark>(
        vorion::remarks::Raise, "Raised", *Raisable.front(), [&] {
          return (Twine(Raisable.size()) +
                  " instructions moved in front of a loop, behind which they "
                  "had been sunk; values alive across it: " +
                  Twine(-Gain))
              .str();
        });
    for (Instruction *I : Raisable)
      I->moveBefore(Before.getTerminator());
    return true;
  }

private:
  bool canRaise(Instruction &I) const {
    if (isa<PHINode>(I) || I.isTerminator() || I.isEHPad() ||
        I.mayReadOrWriteMemory() || I.getType()->isTokenTy() ||
        !isSafeToSpeculativelyExecute(&I))
      return false;
    if (const auto *Call = dyn_cast<CallBase>(&I); Call && Call->isConvergent())
      return false;
    return all_of(I.operands(), [&](Value *V) {
      auto *const Term = dyn_cast<Instruction>(V);
      return !Term || Raisable.contains(Term) ||
             (!L.contains(Term) &&
              Dominators.dominates(Term, Before.getTerminator()));
    });
  }

  /// Whether \p Term, which is there in front of the loop, need not be alive
  /// inside it if nothing behind uses it. Loops around it need all else anyway.
  bool mayEnd(const Instruction &Term) const {
    return Loops.getLoopFor(Term.getParent()) == Loops.getLoopFor(&Before);
  }

  /// How many values fewer are alive across the loop if \p Sum is raised.
  int gain(const EquivalenceClasses<Instruction *> &Sums,
           EquivalenceClasses<Instruction *>::iterator Sum) const {
    int Fewer = 0;
    for (auto M = Sums.member_begin(Sum); M != Sums.member_end(); ++M) {
      const bool IsRaised = Raisable.contains(*M);
      const bool IsUsedBehind = any_of((*M)->users(), [&](User *U) {
        auto *const I = cast<Instruction>(U);
        return !Raisable.contains(I) &&
               (isa<PHINode>(I) ||
                !Dominators.dominates(I->getParent(), &Before));
      });
      if (IsRaised && IsUsedBehind)
        --Fewer;
      if (!IsRaised && !IsUsedBehind)
        ++Fewer;
    }
    return Fewer;
  }

  const Loop &L;
  const LoopInfo &Loops;
  const DominatorTree &Dominators;
  BasicBlock &Before, &Behind;
  SmallSetVector<Instruction *, 16> Raisable; ///< in order
};

} // namespace

bool vorion::raiseInvariants(Function &F, FunctionAnalysisManager &Analyses) {
  if (!Enabled)
    return false;
  const LoopInfo &Loops = Analyses.getResult<LoopAnalysis>(F);
  const auto &Dominators = Analyses.getResult<DominatorTreeAnalysis>(F);
  bool Changed = false;
  const auto Outside = Loops.getLoopsInPreorder();
  for (const Loop *L : reverse(Outside)) {
    BasicBlock *const Before = L->getLoopPreheader();
    BasicBlock *const Behind = L->getUniqueExitBlock();
    if (Before && Behind && Dominators.dominates(Before, Behind) &&
        all_of(predecessors(Behind),
               [&](const BasicBlock *B) { return L->contains(B); }))
      Changed |= Raiser(*L, Loops, Dominators, *Before, *Behind).run();
  }
  return Changed;
}
