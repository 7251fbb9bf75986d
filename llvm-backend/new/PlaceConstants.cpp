//===- PlaceConstants.cpp - constants live where registers are left -------===//
//
// MachineLICM moves every constant out of every loop, for the allocator to make
// it again inside if registers are short. The allocator does so value by value,
// and spills others meanwhile. This pass counts first. It knows how many
// registers each block needs for all but constants, and gives those that are
// left to the constants that are used most; where none is left, a constant is
// made in front of its use.
//
//===----------------------------------------------------------------------===//

#include "RISCVSubtarget.h"
#include "Remarks.h"
#include "Vorion.h"
#include "llvm/ADT/BitVector.h"
#include "llvm/ADT/MapVector.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/CodeGen/MachineDominators.h"
#include "llvm/CodeGen/MachineFunctionPass.h"
#include "llvm/CodeGen/MachineInstrBuilder.h"
#include "llvm/CodeGen/MachineLoopInfo.h"
#include "llvm/CodeGen/MachineRegisterInfo.h"
#include "llvm/Support/CommandLine.h"
#include <cmath>
#include <tuple>

using namespace llvm;

static cl::opt<bool>
    Enabled("vorion-place-constants", cl::Hidden, cl::init(true),
            cl::desc("Place constants where registers are left for them"));

namespace {

enum Bank { Integer, Float };

/// Registers for values: all but x0, sp, gp and tp, and all.
constexpr int registersOf(Bank B) { return B == Integer ? 28 : 32; }

/// What is in neither has no limit that matters here.
std::optional<Bank> bankOf(Register Reg, const MachineRegisterInfo &MRI) {
  if (!Reg.isVirtual())
    return std::nullopt;
  const TargetRegisterClass *Class = MRI.getRegClass(Reg);
  if (RISCV::GPRRegClass.hasSubClassEq(Class))
    return Integer;
  if (RISCV::FPR32RegClass.hasSubClassEq(Class))
    return Float;
  return std::nullopt;
}

/// Whether \p MI does nothing but make a number that it reads from nowhere.
bool makesConstant(const MachineInstr &MI) {
  switch (MI.getOpcode()) {
  case RISCV::PseudoFloatConstant:
  case RISCV::PseudoMovImm:
    return true;
  case RISCV::LUI:
    return MI.getOperand(1).isImm();
  case RISCV::ADDI:
    return MI.getOperand(1).isReg() && MI.getOperand(1).getReg() == RISCV::X0 &&
           MI.getOperand(2).isImm();
  default:
    return false;
  }
}

/// How many registers of a bank each block needs for what is no constant.
class Needs {
public:
  Needs(const MachineFunction &MF, const MachineRegisterInfo &MRI, Bank Of)
      : MRI(MRI), Of(Of), Most(MF.getNumBlockIDs(), 0) {
    for (unsigned I = 0; I != MRI.getNumVirtRegs(); ++I)
      if (counts(Register::index2VirtReg(I)))
        Index.try_emplace(Register::index2VirtReg(I), Index.size());
    LiveOut.assign(MF.getNumBlockIDs(), BitVector(Index.size()));
    const SmallVector<const MachineBasicBlock *> Order(post_order(&MF));
    for (bool Changed = true; Changed;) {
      Changed = false;
      for (const MachineBasicBlock *MBB : Order)
        Changed |= step(*MBB);
    }
  }

  unsigned in(const MachineBasicBlock &MBB) const {
    return Most[MBB.getNumber()];
  }

private:
  bool counts(Register Reg) const {
    const MachineInstr *Def = MRI.getVRegDef(Reg);
    return bankOf(Reg, MRI) == Of && Def && !makesConstant(*Def);
  }

  /// Walks \p MBB from its end to its beginning. Whether a block in front of it
  /// has more alive at its end than was known.
  bool step(const MachineBasicBlock &MBB) {
    BitVector Live = LiveOut[MBB.getNumber()];
    unsigned Now = Live.count(), Top = Now;
    auto note = [&](const MachineOperand &MO, bool IsLive) {
      const auto Found = MO.isReg() ? Index.find(MO.getReg()) : Index.end();
      if (Found == Index.end() || Live.test(Found->second) == IsLive)
        return;
      Live.flip(Found->second);
      Now += IsLive ? 1 : -1;
    };
    for (const MachineInstr &MI : reverse(MBB)) {
      for (const MachineOperand &MO : MI.all_defs())
        note(MO, false);
      if (MI.isPHI() || MI.isDebugInstr())
        continue;
      for (const MachineOperand &MO : MI.all_uses())
        note(MO, true);
      Top = std::max(Top, Now);
    }
    Most[MBB.getNumber()] = Top;
    bool Changed = false;
    for (const MachineBasicBlock *Before : MBB.predecessors()) {
      BitVector At = Live;
      for (const MachineInstr &Phi : MBB.phis())
        for (unsigned K = 1; K < Phi.getNumOperands(); K += 2) {
          const auto Found = Index.find(Phi.getOperand(K).getReg());
          if (Phi.getOperand(K + 1).getMBB() == Before && Found != Index.end())
            At.set(Found->second);
        }
      BitVector &Known = LiveOut[Before->getNumber()];
      if (At.test(Known)) {
        Known |= At;
        Changed = true;
      }
    }
    return Changed;
  }

  const MachineRegisterInfo &MRI;
  const Bank Of;
  DenseMap<Register, unsigned> Index;
  std::vector<BitVector> LiveOut;
  std::vector<unsigned> Most;
};

/// Where a constant is read: an operand, and the block at whose end or inside
/// which it must be there.
struct Use {
  MachineOperand *Operand;
  MachineBasicBlock *Block;
};

/// A number that the function uses, and all its uses.
struct Constant {
  MachineInstr *Made = nullptr;
  SmallVector<Use> Uses;
  double Weight = 0;  ///< how often it is used, by loops
  unsigned Order = 0; ///< in the function
};

class Placer {
public:
  Placer(MachineFunction &MF, MachineLoopInfo &Loops, MachineDominatorTree &DT)
      : MF(MF), MRI(MF.getRegInfo()), Loops(Loops), DT(DT) {}

  bool run() {
    // Code that nothing leads to has no place in the order of dominators.
    if (any_of(MF, [&](MachineBasicBlock &MBB) {
          return !DT.isReachableFromEntry(&MBB);
        }))
      return false;
    std::vector<Constant> All = collect();
    if (All.empty())
      return false;
    for (const Bank B : {Integer, Float}) {
      const Needs Needed(MF, MRI, B);
      Left.assign(MF.getNumBlockIDs(), 0);
      for (const MachineBasicBlock &MBB : MF)
        Left[MBB.getNumber()] = registersOf(B) - int(Needed.in(MBB));
      for (Constant &C : All)
        if (bankOf(C.Made->getOperand(0).getReg(), MRI) == B)
          place(*C.Made, C.Uses, nullptr);
    }
    for (MachineInstr *MI : Old) {
      MRI.markUsesInDebugValueAsUndef(MI->getOperand(0).getReg());
      MI->eraseFromParent();
    }
    return true;
  }

private:
  /// Constants with their uses, the most used ones first.
  std::vector<Constant> collect() {
    // Of one class, so that each may stand where another did.
    using Number = std::tuple<unsigned, int64_t, const TargetRegisterClass *>;
    MapVector<Number, Constant> Found;
    for (MachineBasicBlock &MBB : MF)
      for (MachineInstr &MI : MBB) {
        if (!makesConstant(MI))
          continue;
        const Register Reg = MI.getOperand(0).getReg();
        if (!bankOf(Reg, MRI) || !MRI.hasOneDef(Reg))
          continue;
        Constant &C =
            Found[{MI.getOpcode(),
                   MI.getOperand(MI.getNumExplicitOperands() - 1).getImm(),
                   MRI.getRegClass(Reg)}];
        if (!C.Made)
          C.Made = &MI;
        Old.push_back(&MI);
        for (MachineOperand &MO : MRI.use_nodbg_operands(Reg)) {
          MachineInstr &User = *MO.getParent();
          MachineBasicBlock *Block =
              User.isPHI()
                  ? User.getOperand(User.getOperandNo(&MO) + 1).getMBB()
                  : User.getParent();
          C.Uses.push_back({&MO, Block});
          C.Weight += std::pow(10.0, Loops.getLoopDepth(Block));
        }
      }
    std::vector<Constant> All;
    for (auto &[Key, C] : Found) {
      C.Order = All.size();
      All.push_back(std::move(C));
    }
    sort(All, [](const Constant &A, const Constant &B) {
      return std::pair(-A.Weight, A.Order) < std::pair(-B.Weight, B.Order);
    });
    return All;
  }

  /// Where one instruction serves all of \p Uses, in \p Loop but in no loop
  /// inside it.
  MachineBasicBlock *placeFor(ArrayRef<Use> Uses, const MachineLoop *Loop) {
    MachineBasicBlock *At = Uses.front().Block;
    for (const Use &U : Uses)
      At = DT.findNearestCommonDominator(At, U.Block);
    while (Loops.getLoopFor(At) != Loop)
      At = DT.getNode(At)->getIDom()->getBlock();
    return At;
  }

  /// The blocks in which a value is alive that is made in \p At.
  SmallVector<const MachineBasicBlock *> between(const MachineBasicBlock *At,
                                                 ArrayRef<Use> Uses) {
    SmallVector<const MachineBasicBlock *> Blocks = {At};
    SmallPtrSet<const MachineBasicBlock *, 16> Seen = {At};
    auto add = [&](const MachineBasicBlock *MBB) {
      if (Seen.insert(MBB).second)
        Blocks.push_back(MBB);
    };
    for (const Use &U : Uses)
      add(U.Block);
    for (size_t K = 1; K < Blocks.size(); ++K)
      for (const MachineBasicBlock *Before : Blocks[K]->predecessors())
        add(Before);
    return Blocks;
  }

  /// Makes the number of \p Made at \p At, for \p Uses.
  void make(const MachineInstr &Made, MachineBasicBlock &At,
            ArrayRef<Use> Uses) {
    MachineBasicBlock::iterator Place = At.getFirstTerminator();
    SmallPtrSet<const MachineInstr *, 8> Users;
    for (const Use &U : Uses)
      Users.insert(U.Operand->getParent());
    for (MachineInstr &MI : At)
      if (!MI.isPHI() && Users.contains(&MI)) {
        Place = MI.getIterator();
        break;
      }
    const Register New = MRI.cloneVirtualRegister(Made.getOperand(0).getReg());
    MachineInstr *Copy = MF.CloneMachineInstr(&Made);
    Copy->getOperand(0).setReg(New);
    At.insert(Place, Copy);
    for (const Use &U : Uses) {
      U.Operand->setReg(New);
      U.Operand->setIsKill(false);
    }
  }

  /// Makes it there if every block up to the uses has a register left, and
  /// takes one from each of them.
  bool makeIfFree(const MachineInstr &Made, MachineBasicBlock *At,
                  ArrayRef<Use> Uses) {
    const auto Blocks = between(At, Uses);
    if (any_of(Blocks, [&](const MachineBasicBlock *MBB) {
          return Left[MBB->getNumber()] <= 0;
        }))
      return false;
    for (const MachineBasicBlock *MBB : Blocks)
      --Left[MBB->getNumber()];
    make(Made, *At, Uses);
    return true;
  }

  /// Makes the number for \p Uses, all of them inside \p Loop, as far outside
  /// as registers are left.
  void place(const MachineInstr &Made, ArrayRef<Use> Uses,
             const MachineLoop *Loop) {
    if (Uses.empty() || makeIfFree(Made, placeFor(Uses, Loop), Uses))
      return;
    MapVector<const MachineLoop *, SmallVector<Use>> Inner;
    MapVector<MachineBasicBlock *, SmallVector<Use>> Own;
    for (const Use &U : Uses) {
      const MachineLoop *L = Loops.getLoopFor(U.Block);
      if (L == Loop) {
        Own[U.Block].push_back(U);
        continue;
      }
      while (L->getParentLoop() != Loop)
        L = L->getParentLoop();
      Inner[L].push_back(U);
    }
    for (auto &[L, Group] : Inner) {
      MachineBasicBlock *Before = L->getLoopPreheader();
      if (!Before || !makeIfFree(Made, Before, Group))
        place(Made, Group, L);
    }
    for (auto &[Block, Group] : Own) {
      --Left[Block->getNumber()];
      make(Made, *Block, Group);
      if (!Loop || !Block->getBasicBlock())
        continue;
      const DebugLoc &User = Group.front().Operand->getParent()->getDebugLoc();
      vorion::remark<OptimizationRemarkMissed>(
          vorion::remarks::Constant, "NoRegister",
          User ? User : Loop->getStartLoc(), *Block->getBasicBlock(), [] {
            return "a constant is made in every iteration: the loop needs all "
                   "registers";
          });
    }
  }

  MachineFunction &MF;
  MachineRegisterInfo &MRI;
  MachineLoopInfo &Loops;
  MachineDominatorTree &DT;
  std::vector<int> Left;
  std::vector<MachineInstr *> Old;
};

class PlaceConstants final : public MachineFunctionPass {
public:
  static char ID;
  PlaceConstants() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override {
    return "Vorion places of constants";
  }
  void getAnalysisUsage(AnalysisUsage &AU) const override {
    AU.addRequired<MachineLoopInfoWrapperPass>();
    AU.addRequired<MachineDominatorTreeWrapperPass>();
    AU.setPreservesCFG();
    MachineFunctionPass::getAnalysisUsage(AU);
  }
  bool runOnMachineFunction(MachineFunction &MF) override {
    if (!Enabled || !MF.getSubtarget<RISCVSubtarget>().hasVendorXVortex() ||
        skipFunction(MF.getFunction()))
      return false;
    return Placer(MF, getAnalysis<MachineLoopInfoWrapperPass>().getLI(),
                  getAnalysis<MachineDominatorTreeWrapperPass>().getDomTree())
        .run();
  }
};

char PlaceConstants::ID = 0;
// The name is for -run-pass, -print-after and -stop-after. It is not that of
// the option, because opt makes options of the names of passes.
const RegisterPass<PlaceConstants> Registration("vorion-constant-places",
                                                "Vorion places of constants");

} // namespace

FunctionPass *vorion::createPlaceConstantsPass() {
  return new PlaceConstants();
}
