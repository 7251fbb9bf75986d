//===- Resources.cpp - the resources of a function ------------------------===//

#include "Resources.h"
#include "RISCVSubtarget.h"
#include "llvm/CodeGen/LivePhysRegs.h"
#include "llvm/CodeGen/MachineFrameInfo.h"
#include "llvm/CodeGen/MachineFunction.h"
#include "llvm/CodeGen/MachineRegisterInfo.h"
#include "llvm/CodeGen/PseudoSourceValue.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/Module.h"
#include "llvm/Support/CommandLine.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/JSON.h"
#include "llvm/Support/raw_ostream.h"
#include <cstddef>
#include <set>
#include <vorion_abi.h>

using namespace llvm;

namespace {

/// Empty if no report is requested.
cl::opt<std::string>
    FileName(StringRef(vorion::ResourcesOption), cl::Hidden,
             cl::value_desc("file"),
             cl::desc("Append the resources of each function, as JSON"));

/// Kind of the metadata of a function that has its divergent branches: strings
/// of JSON.
constexpr StringLiteral Branches = "vorion.branches";

void addPlace(json::Object &To, StringRef SourceFile, unsigned Line) {
  To["file"] = Line ? json::Value(SourceFile.str()) : json::Value(nullptr);
  To["line"] = Line ? json::Value(Line) : json::Value(nullptr);
}

/// Counts of one kind of register.
struct RegisterCount {
  const TargetRegisterClass &Class;
  unsigned Used = 0;
  unsigned Alive = 0; ///< at once, at most

  json::Object object() const {
    return json::Object{{"alive", Alive}, {"used", Used}};
  }
};

class Collector {
public:
  explicit Collector(const MachineFunction &MF)
      : MF(MF), Subtarget(MF.getSubtarget<RISCVSubtarget>()),
        TII(*Subtarget.getInstrInfo()), Frame(MF.getFrameInfo()) {}

  json::Object collect() {
    countRegisters();
    for (const MachineBasicBlock &Block : MF)
      for (const MachineInstr &MI : Block)
        count(MI);
    const Function &F = MF.getFunction();
    json::Object All{{"function", F.getName()},
                     {"kernel", F.hasFnAttribute("vorion-kernel")}};
    const DISubprogram *Source = F.getSubprogram();
    addPlace(All, Source ? Source->getFilename() : "",
             Source ? Source->getLine() : 0);
    All["instructions"] = Instructions;
    All["code_bytes"] = Bytes;
    All["registers"] =
        json::Object{{"integer", Integer.object()}, {"float", Float.object()}};
    All["stack_bytes"] = Frame.getStackSize();
    All["spills"] = json::Object{{"bytes", slotBytes(SlotKind::Spill)},
                                 {"stores", SpillStores},
                                 {"loads", SpillLoads}};
    All["saved_bytes"] = slotBytes(SlotKind::Saved);
    All["private_bytes"] = slotBytes(SlotKind::Variable);
    addRecord(All);
    All["splits"] = Splits;
    All["predicates"] = Predicates;
    All["joins"] = Joins;
    All["barriers"] = Barriers;
    All["divisions"] = Divisions;
    All["rounds"] = rounds();
    All["calls"] = json::Array(Calls);
    All["branches"] = branches();
    return All;
  }

private:
  void countRegisters() {
    const MachineRegisterInfo &MRI = MF.getRegInfo();
    for (RegisterCount *Count : {&Integer, &Float})
      for (MCPhysReg Reg : Count->Class)
        Count->Used += !MRI.isReserved(Reg) && MRI.isPhysRegUsed(Reg);
    LivePhysRegs Live(*Subtarget.getRegisterInfo());
    for (const MachineBasicBlock &Block : MF) {
      Live.clear();
      Live.addLiveOutsNoPristines(Block);
      for (const MachineInstr &MI : reverse(Block)) {
        if (MI.isDebugInstr())
          continue;
        Live.stepBackward(MI);
        for (RegisterCount *Count : {&Integer, &Float})
          Count->Alive = std::max<unsigned>(
              Count->Alive, count_if(Count->Class, [&](MCPhysReg Reg) {
                return !MRI.isReserved(Reg) && MRI.isPhysRegUsed(Reg) &&
                       Live.contains(Reg);
              }));
      }
    }
  }

  void count(const MachineInstr &MI) {
    const unsigned Size = TII.getInstSizeInBytes(MI);
    Bytes += Size;
    Instructions += Size / 4;
    if (MI.hasOneMemOperand()) {
      const auto *Slot = dyn_cast_or_null<FixedStackPseudoSourceValue>(
          (*MI.memoperands_begin())->getPseudoValue());
      if (Slot && kindOf(Slot->getFrameIndex()) == SlotKind::Spill) {
        SpillStores += MI.mayStore();
        SpillLoads += MI.mayLoad();
      }
    }
    if (MI.isCall())
      for (const MachineOperand &Operand : MI.operands()) {
        if (Operand.isGlobal())
          Calls.insert(Operand.getGlobal()->getName().str());
        else if (Operand.isSymbol())
          Calls.insert(Operand.getSymbolName());
      }
    switch (MI.getOpcode()) {
    case RISCV::VX_SPLIT:
    case RISCV::VX_SPLIT_N:
      // One of x0 only asks for the depth.
      Splits += MI.getOperand(1).getReg() != RISCV::X0;
      break;
    case RISCV::VX_PRED:
    case RISCV::VX_PRED_N:
      ++Predicates;
      break;
    case RISCV::VX_JOIN:
      ++Joins;
      break;
    case RISCV::VX_BAR:
      ++Barriers;
      break;
    case RISCV::DIV:
    case RISCV::DIVU:
    case RISCV::REM:
    case RISCV::REMU:
    case RISCV::FDIV_S:
    case RISCV::FSQRT_S:
      ++Divisions;
      break;
    default:
      break;
    }
  }

  /// What a slot of the frame is for. Registers that the caller wants to find
  /// as they were lie in slots that LLVM calls spills, too.
  enum class SlotKind { Spill, Saved, Variable, Other };
  SlotKind kindOf(int Slot) const {
    if (any_of(Frame.getCalleeSavedInfo(), [&](const CalleeSavedInfo &Saved) {
          return !Saved.isSpilledToReg() && Saved.getFrameIdx() == Slot;
        }))
      return SlotKind::Saved;
    if (Frame.isSpillSlotObjectIndex(Slot))
      return SlotKind::Spill;
    return Frame.getObjectAllocation(Slot) ? SlotKind::Variable
                                           : SlotKind::Other;
  }
  int64_t slotBytes(SlotKind Kind) const {
    int64_t Sum = 0;
    for (int Slot = Frame.getObjectIndexBegin();
         Slot < Frame.getObjectIndexEnd(); ++Slot)
      if (!Frame.isDeadObjectIndex(Slot) && kindOf(Slot) == Kind)
        Sum += Frame.getObjectSize(Slot);
    return Sum;
  }

  /// What the record of a kernel says (docs/abi.md).
  void addRecord(json::Object &To) const {
    const Function &F = MF.getFunction();
    const GlobalVariable *Record = F.getParent()->getGlobalVariable(
        ("vorion_kernel." + F.getName()).str(), /*AllowInternal=*/true);
    const auto Field = [&](size_t Offset) -> json::Value {
      const Constant *Fields = Record && Record->hasInitializer()
                                   ? Record->getInitializer()
                                   : nullptr;
      const auto *Number =
          Fields ? dyn_cast_or_null<ConstantInt>(
                       Fields->getAggregateElement(Offset / sizeof(uint32_t)))
                 : nullptr;
      return Number ? json::Value(Number->getZExtValue())
                    : json::Value(nullptr);
    };
    To["local_bytes"] = Field(offsetof(vx_kernel, local_bytes));
    To["context_bytes"] = Field(offsetof(vx_kernel, context_bytes));
  }

  /// Why PoCL's passes let the kernel run in rounds (SimtMeetings.cc). A module
  /// has one kernel.
  json::Value rounds() const {
    const Function &F = MF.getFunction();
    const NamedMDNode *Notes = F.getParent()->getNamedMetadata("vorion.rounds");
    if (!Notes || !F.hasFnAttribute("vorion-kernel"))
      return nullptr;
    const MDNode &Note = *Notes->getOperand(0);
    json::Object Told{
        {"reason", cast<MDString>(Note.getOperand(0))->getString()}};
    const DISubprogram *Source = F.getSubprogram();
    addPlace(Told, Source ? Source->getFilename() : "",
             mdconst::extract<ConstantInt>(Note.getOperand(1))->getZExtValue());
    return Told;
  }

  json::Array branches() const {
    json::Array All;
    if (const MDNode *Notes = MF.getFunction().getMetadata(Branches))
      for (const MDOperand &Note : Notes->operands())
        All.push_back(cantFail(json::parse(cast<MDString>(Note)->getString())));
    return All;
  }

  const MachineFunction &MF;
  const RISCVSubtarget &Subtarget;
  const RISCVInstrInfo &TII;
  const MachineFrameInfo &Frame;
  RegisterCount Integer{RISCV::GPRRegClass}, Float{RISCV::FPR32RegClass};
  unsigned Instructions = 0, Bytes = 0;
  unsigned SpillStores = 0, SpillLoads = 0;
  unsigned Splits = 0, Predicates = 0, Joins = 0, Barriers = 0, Divisions = 0;
  std::set<std::string> Calls;
};

} // namespace

bool vorion::wantsResources() { return !FileName.empty(); }

void vorion::noteDivergentBranch(const BranchInst &Branch, StringRef Kind,
                                 const DebugLoc &Place, const Reason &Why) {
  json::Object Note{{"kind", Kind}, {"reason", sentence(Why, Place)}};
  addPlace(Note, fileOf(Place), Place ? Place.getLine() : 0);
  Note["column"] = Place ? Place.getCol() : 0;
  json::Array Chain;
  for (const ReasonStep &Step : Why) {
    json::Object At{{"what", Step.What}};
    addPlace(At, fileOf(Step.Place), Step.Place ? Step.Place.getLine() : 0);
    Chain.push_back(std::move(At));
  }
  Note["chain"] = std::move(Chain);

  auto &F = const_cast<Function &>(*Branch.getFunction());
  LLVMContext &Context = F.getContext();
  SmallVector<Metadata *, 8> All;
  if (const MDNode *Notes = F.getMetadata(Branches))
    All.append(Notes->op_begin(), Notes->op_end());
  std::string Text;
  raw_string_ostream(Text) << json::Value(std::move(Note));
  All.push_back(MDString::get(Context, Text));
  F.setMetadata(Branches, MDNode::get(Context, All));
}

void vorion::writeResources(const MachineFunction &MF) {
  if (!wantsResources())
    return;
  std::string Line;
  raw_string_ostream(Line) << json::Value(Collector(MF).collect()) << "\n";
  std::error_code Problem;
  raw_fd_ostream Out(FileName, Problem, sys::fs::OF_Append);
  if (!Problem) {
    Out << Line;
    Out.close();
    Problem = Out.error();
    Out.clear_error();
  }
  if (Problem)
    MF.getFunction().getContext().emitError(Twine(FileName) + ": " +
                                            Problem.message() +
                                            ", expected a file to write to");
}
