//===- RefuseBranches.cpp - no branches behind the lowering's back --------===//
//
// Divergence is lowered in IR. If selection, after that, expands an operation
// into a branch, nobody has asked whether lanes agree about it. Such a branch
// lies inside what was one block of IR, which is how it is found.
//
//===----------------------------------------------------------------------===//

#include "RISCVSubtarget.h"
#include "Vorion.h"
#include "llvm/CodeGen/MachineFunctionPass.h"
#include "llvm/IR/DiagnosticInfo.h"

using namespace llvm;

namespace {

/// A branch on counters that all lanes read alike (the 64-bit counter loop).
bool comparesCounters(const MachineInstr &Branch) {
  const MachineRegisterInfo &MRI = Branch.getMF()->getRegInfo();
  return all_of(Branch.operands(), [&](const MachineOperand &Operand) {
    if (!Operand.isReg())
      return true;
    const MachineInstr *Definition = MRI.getUniqueVRegDef(Operand.getReg());
    return Definition && Definition->getOpcode() == RISCV::CSRRS;
  });
}

void refuse(const MachineInstr &Branch) {
  const Function &F = Branch.getMF()->getFunction();
  F.getContext().diagnose(DiagnosticInfoUnsupported(
      F, "an operation that needs a branch which lanes may disagree about",
      Branch.getDebugLoc()));
}

class RefuseBranches final : public MachineFunctionPass {
public:
  static char ID;
  RefuseBranches() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override {
    return "Vorion branches of selection";
  }
  void getAnalysisUsage(AnalysisUsage &AU) const override {
    AU.setPreservesAll();
    MachineFunctionPass::getAnalysisUsage(AU);
  }

  bool runOnMachineFunction(MachineFunction &MF) override {
    if (!MF.getSubtarget<RISCVSubtarget>().hasVendorXVortex())
      return false;
    DenseMap<const BasicBlock *, const MachineBasicBlock *> First;
    for (const MachineBasicBlock &Block : MF)
      First.try_emplace(Block.getBasicBlock(), &Block);
    for (const MachineBasicBlock &Block : MF) {
      bool HasOther = false;
      for (const MachineInstr &MI : Block.terminators()) {
        if (!MI.isConditionalBranch() || comparesCounters(MI))
          continue;
        bool StaysInside =
            any_of(Block.successors(), [&](const MachineBasicBlock *Successor) {
              return Successor->getBasicBlock() == Block.getBasicBlock() &&
                     Successor != First.lookup(Block.getBasicBlock());
            });
        // The second of two is a condition taken in two steps, with one split.
        if (StaysInside || HasOther)
          refuse(MI);
        HasOther = true;
      }
    }
    return false;
  }
};

char RefuseBranches::ID = 0;
// The name is for -print-after and -stop-after.
const RegisterPass<RefuseBranches> Registration("vorion-refuse-branches",
                                                "Vorion branches of selection");

} // namespace

FunctionPass *vorion::createRefuseBranchesPass() {
  return new RefuseBranches();
}
