//===- VerifySplits.cpp - splits and joins pair in what is emitted --------===//
//
// Everything after divergence lowering keeps each lane's sequence of
// instructions, so pairing should survive. A warp whose stack goes wrong runs
// on silently, though, hence this check of the final code: along every path,
// with every split taken to diverge, each join's token must be the depth (then
// it does nothing) or one less (then it ends the innermost split), each
// predicate's mask must have been read at the same depth, and a return must
// find the stack as the call left it.
//
//===----------------------------------------------------------------------===//

#include "RISCVSubtarget.h"
#include "Resources.h"
#include "StackUse.h"
#include "Vorion.h"
#include "VorionCsrs.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/CodeGen/MachineFunctionPass.h"
#include "llvm/CodeGen/PseudoSourceValue.h"
#include "llvm/IR/DiagnosticInfo.h"
#include <map>
#include <set>

using namespace llvm;

namespace {

/// Where a token or mask may be kept: a register, or a slot of the frame.
struct Place {
  bool IsSlot;
  int Number;
  auto operator<=>(const Place &) const = default;
};

/// What is known on one path: the depth, and the depth at which each kept token
/// or mask was made. Everything else a place may hold does not matter here.
struct PathState {
  int Depth = 0;
  std::map<Place, int> Kept;
  auto operator<=>(const PathState &) const = default;
};

class VerifySplits final : public MachineFunctionPass {
public:
  static char ID;
  VerifySplits() : MachineFunctionPass(ID) {}
  StringRef getPassName() const override { return "Vorion split verification"; }
  void getAnalysisUsage(AnalysisUsage &AU) const override {
    AU.setPreservesAll();
    MachineFunctionPass::getAnalysisUsage(AU);
  }
  bool runOnMachineFunction(MachineFunction &MF) override;

private:
  /// Paths through code that crosses itself multiply; past this many states of
  /// one block the rest is taken on trust.
  static constexpr size_t MaxStates = 16;

  bool step(const MachineInstr &MI, PathState &State);
  bool fail(const MachineInstr &MI, const Twine &Why);
  void forgetDefinitions(const MachineInstr &MI, PathState &State) const;

  const RISCVInstrInfo *TII = nullptr;
  const TargetRegisterInfo *TRI = nullptr;
};

char VerifySplits::ID = 0;
// The name is for -print-after and -stop-after.
const RegisterPass<VerifySplits> Registration("vorion-verify-splits",
                                              "Vorion split verification");

Place place(Register Reg) { return {false, int(Reg.id())}; }

/// The slot of the frame that \p MI loads or stores a register of, as spills
/// and reloads do.
std::optional<Place> slotOf(const MachineInstr &MI) {
  if (!MI.hasOneMemOperand())
    return std::nullopt;
  const auto *Slot = dyn_cast_or_null<FixedStackPseudoSourceValue>(
      (*MI.memoperands_begin())->getPseudoValue());
  if (!Slot)
    return std::nullopt;
  return Place{true, Slot->getFrameIndex()};
}

/// For each block the slots that are loaded before they are stored to again:
/// what others hold is of no use, and would only make states differ.
class LiveSlots {
public:
  explicit LiveSlots(const MachineFunction &MF) {
    bool Changed = true;
    while (Changed) {
      Changed = false;
      for (const MachineBasicBlock *Block : post_order(&MF))
        Changed |= update(*Block);
    }
  }
  bool isLiveIn(const MachineBasicBlock &Block, int Slot) const {
    auto Found = In.find(&Block);
    return Found != In.end() && Found->second.count(Slot);
  }

private:
  bool update(const MachineBasicBlock &Block) {
    std::set<int> Live;
    for (const MachineBasicBlock *Successor : Block.successors())
      Live.insert(In[Successor].begin(), In[Successor].end());
    for (const MachineInstr &MI : reverse(Block)) {
      std::optional<Place> Slot = slotOf(MI);
      if (Slot && MI.getOpcode() == RISCV::SW)
        Live.erase(Slot->Number);
      else if (Slot && MI.getOpcode() == RISCV::LW)
        Live.insert(Slot->Number);
    }
    std::set<int> &Known = In[&Block];
    if (Known == Live)
      return false;
    Known = std::move(Live);
    return true;
  }

  DenseMap<const MachineBasicBlock *, std::set<int>> In;
};

} // namespace

bool VerifySplits::fail(const MachineInstr &MI, const Twine &Why) {
  const Function &F = MI.getMF()->getFunction();
  F.getContext().diagnose(DiagnosticInfoUnsupported(F, Why, MI.getDebugLoc()));
  return false;
}

void VerifySplits::forgetDefinitions(const MachineInstr &MI,
                                     PathState &State) const {
  std::erase_if(State.Kept, [&](const auto &Entry) {
    return !Entry.first.IsSlot &&
           MI.modifiesRegister(Register(Entry.first.Number), TRI);
  });
}

/// Follows one instruction. False if the code is wrong.
bool VerifySplits::step(const MachineInstr &MI, PathState &State) {
  auto kept = [&](Place From) -> std::optional<int> {
    auto Found = State.Kept.find(From);
    if (Found == State.Kept.end())
      return std::nullopt;
    return Found->second;
  };
  auto define = [&](Place To, std::optional<int> Depth) {
    forgetDefinitions(MI, State);
    State.Kept.erase(To);
    if (Depth)
      State.Kept[To] = *Depth;
  };

  switch (MI.getOpcode()) {
  case RISCV::VX_SPLIT:
  case RISCV::VX_SPLIT_N:
    define(place(MI.getOperand(0).getReg()), State.Depth);
    State.Depth += MI.getOperand(1).getReg() != RISCV::X0;
    return true;
  case RISCV::VX_JOIN: {
    std::optional<int> Token = kept(place(MI.getOperand(0).getReg()));
    if (!Token)
      return fail(MI, "vx_join of something that no vx_split made");
    if (*Token != State.Depth && *Token != State.Depth - 1)
      return fail(MI, "vx_join does not end the innermost vx_split");
    State.Depth = *Token;
    return true;
  }
  case RISCV::VX_PRED:
  case RISCV::VX_PRED_N:
    if (kept(place(MI.getOperand(1).getReg())) != State.Depth)
      return fail(MI, "vx_pred with a mask that is not the loop's own");
    return true;
  case RISCV::CSRRS:
    if (MI.getOperand(1).getImm() != vorion::csr::vx_active_threads)
      break;
    define(place(MI.getOperand(0).getReg()), State.Depth);
    return true;
  default:
    break;
  }

  if (MI.isReturn() && State.Depth != 0)
    return fail(MI, "a return between vx_split and vx_join");
  std::optional<Place> Slot = slotOf(MI);
  if (Slot && MI.getOpcode() == RISCV::SW) {
    define(*Slot, kept(place(MI.getOperand(0).getReg())));
  } else if (Slot && MI.getOpcode() == RISCV::LW) {
    define(place(MI.getOperand(0).getReg()), kept(*Slot));
  } else if (auto Copy = TII->isCopyInstr(MI)) {
    define(place(Copy->Destination->getReg()),
           kept(place(Copy->Source->getReg())));
  } else {
    forgetDefinitions(MI, State);
  }
  return true;
}

bool VerifySplits::runOnMachineFunction(MachineFunction &MF) {
  const auto &Subtarget = MF.getSubtarget<RISCVSubtarget>();
  if (!Subtarget.hasVendorXVortex())
    return false;
  TII = Subtarget.getInstrInfo();
  TRI = Subtarget.getRegisterInfo();

  const LiveSlots Slots(MF);
  DenseMap<const MachineBasicBlock *, std::set<PathState>> Seen;
  SmallVector<std::pair<const MachineBasicBlock *, PathState>, 16> Work;
  Work.push_back({&MF.front(), {}});
  while (!Work.empty()) {
    auto [Block, State] = Work.pop_back_val();
    std::set<PathState> &States = Seen[Block];
    std::erase_if(State.Kept, [&, B = Block](const auto &Entry) {
      auto [IsSlot, Number] = Entry.first;
      return IsSlot ? !Slots.isLiveIn(*B, Number) : !B->isLiveIn(Number);
    });
    if (States.size() >= MaxStates || !States.insert(State).second)
      continue;
    for (const MachineInstr &MI : *Block)
      if (!step(MI, State))
        return false;
    for (const MachineBasicBlock *Successor : Block->successors())
      Work.push_back({Successor, State});
  }
  vorion::recordStackUse(MF);
  vorion::writeResources(MF);
  return false;
}

FunctionPass *vorion::createVerifySplitsPass() { return new VerifySplits(); }
