//===- ProgramVariables.cc - variables of program scope -------------------===//

#include "ProgramVariables.h"

#include "CompilerWarnings.h"
IGNORE_COMPILER_WARNING("-Wmaybe-uninitialized")
#include <llvm/ADT/MapVector.h>
POP_COMPILER_DIAGS
IGNORE_COMPILER_WARNING("-Wunused-parameter")
#include "LLVMUtils.h"
#include "pocl_llvm_api.h"
#include <llvm/ADT/SetVector.h>
#include <llvm/ADT/SmallPtrSet.h>
#include <llvm/Analysis/ConstantFolding.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/ReplaceConstant.h>
#include <llvm/Transforms/Utils/ModuleUtils.h>
POP_COMPILER_DIAGS

#include <map>
#include <vector>

using namespace llvm;

namespace pocl {

namespace {

bool isOfProgram(const GlobalVariable &G) {
  return !G.getName().starts_with("llvm.");
}

/// A module has one address space: local variables are known by their
/// beginning, which is undefined. A variable of program scope begins as zero if
/// nothing else is said.
bool isVariable(const GlobalVariable &G) {
  return isOfProgram(G) && !G.isConstant() &&
         !(G.hasInitializer() && isa<UndefValue>(G.getInitializer()));
}

bool isConstantObject(const GlobalVariable &G) {
  return isOfProgram(G) && G.isConstant() && G.hasInitializer();
}

bool holdsPointers(const Type *T) {
  return T->isPointerTy() || any_of(T->subtypes(), holdsPointers);
}

/// The objects whose address is part of \p C.
void collectObjects(Constant *C, SmallPtrSetImpl<Constant *> &Seen,
                    SetVector<GlobalVariable *> &Found) {
  if (!Seen.insert(C).second)
    return;
  if (auto *G = dyn_cast<GlobalVariable>(C)) {
    Found.insert(G);
    return;
  }
  for (Use &U : C->operands())
    if (auto *Operand = dyn_cast<Constant>(U))
      collectObjects(Operand, Seen, Found);
}

SetVector<GlobalVariable *> objectsOf(GlobalVariable &G) {
  SetVector<GlobalVariable *> Found;
  SmallPtrSet<Constant *, 16> Seen;
  collectObjects(G.getInitializer(), Seen, Found);
  return Found;
}

class Placer {
public:
  Placer(Module &M, std::string &Log)
      : M(M), Layout(M.getDataLayout()), Log(Log),
        I32(Type::getInt32Ty(M.getContext())),
        Pointer(PointerType::get(M.getContext(), 0)) {}

  /// False and the log if something is wrong.
  bool run() {
    if (!collect())
      return false;
    if (Places.empty())
      return true;
    addConstants();
    place();
    for (const auto &[G, Place] : Places)
      if (!write(G->getInitializer(), Place)) {
        Log += "the initial value of the variable " + G->getName().str() +
               " cannot be computed when the program is built\n";
        return false;
      }
    addRecord();
    replace();
    return true;
  }

  uint64_t bytes() const { return Bytes; }

private:
  bool collect() {
    bool Complete = true;
    for (GlobalVariable &G : M.globals()) {
      if (G.hasInitializer()) {
        if (isVariable(G))
          Places[&G] = 0;
      } else if (isOfProgram(G) && !G.use_empty()) {
        Log += "the variable " + G.getName().str() +
               " is declared, but no part of the program has it\n";
        Complete = false;
      }
    }
    return Complete;
  }

  /// Each kernel's image has a constant at another place. So a constant lies
  /// with the variables if they can point to it, or if it points to them.
  void addConstants() {
    const bool All = any_of(Places, [](const auto &Each) {
      return holdsPointers(Each.first->getValueType());
    });
    std::vector<GlobalVariable *> Left;
    for (GlobalVariable &G : M.globals())
      if (isConstantObject(G))
        Left.push_back(&G);
    for (bool Grew = true; Grew;) {
      Grew = false;
      SetVector<GlobalVariable *> Wanted;
      for (const auto &[G, Place] : Places)
        Wanted.set_union(objectsOf(*G));
      erase_if(Left, [&](GlobalVariable *G) {
        const bool Added = All || Wanted.contains(G) ||
                           any_of(objectsOf(*G), [&](GlobalVariable *Of) {
                             return Places.contains(Of);
                           });
        if (Added)
          Places[G] = 0;
        Grew |= Added;
        return Added;
      });
    }
  }

  void place() {
    for (auto &[G, Place] : Places) {
      const Align Needed =
          Layout.getValueOrABITypeAlignment(G->getAlign(), G->getValueType());
      Alignment = std::max(Alignment, Needed);
      Place = alignTo(Bytes, Needed);
      Bytes = Place + Layout.getTypeAllocSize(G->getValueType());
    }
  }

  uint8_t *contentsAt(uint64_t Place, uint64_t Size) {
    if (Contents.size() < Place + Size)
      Contents.resize(Place + Size);
    return &Contents[Place];
  }

  void writeInteger(const APInt &Value, const Type *T, uint64_t Place) {
    const uint64_t Size = Layout.getTypeStoreSize(const_cast<Type *>(T));
    StoreIntToMemory(Value.zext(8 * Size), contentsAt(Place, Size), Size);
  }

  /// False if the value is not known.
  bool write(Constant *C, uint64_t Place) {
    if (C->isNullValue() || isa<UndefValue>(C))
      return true;
    Type *T = C->getType();
    if (const auto *Number = dyn_cast<ConstantInt>(C)) {
      writeInteger(Number->getValue(), T, Place);
      return true;
    }
    if (const auto *Number = dyn_cast<ConstantFP>(C)) {
      writeInteger(Number->getValueAPF().bitcastToAPInt(), T, Place);
      return true;
    }
    if (auto *Struct = dyn_cast<StructType>(T)) {
      const StructLayout *Fields = Layout.getStructLayout(Struct);
      for (unsigned I = 0; I < Struct->getNumElements(); ++I)
        if (!write(C->getAggregateElement(I),
                   Place + Fields->getElementOffset(I)))
          return false;
      return true;
    }
    if (isa<ArrayType>(T) || isa<FixedVectorType>(T)) {
      const auto *Array = dyn_cast<ArrayType>(T);
      const uint64_t Count = Array ? Array->getNumElements()
                                   : cast<FixedVectorType>(T)->getNumElements();
      const uint64_t Step = Layout.getTypeAllocSize(
          Array ? Array->getElementType()
                : cast<FixedVectorType>(T)->getElementType());
      for (uint64_t I = 0; I < Count; ++I)
        if (!write(C->getAggregateElement(I), Place + I * Step))
          return false;
      return true;
    }
    return writeAddress(C, Place);
  }

  /// An address as a pointer or as a number.
  bool writeAddress(Constant *C, uint64_t Place) {
    C = ConstantFoldConstant(C, Layout);
    if (const auto *Number = dyn_cast<ConstantInt>(C)) {
      writeInteger(Number->getValue(), C->getType(), Place);
      return true;
    }
    if (const auto *Cast = dyn_cast<ConstantExpr>(C))
      if (Cast->getOpcode() == Instruction::IntToPtr)
        if (auto *Number = dyn_cast<ConstantInt>(Cast->getOperand(0))) {
          writeInteger(Number->getValue().zextOrTrunc(32), I32, Place);
          return true;
        }
    GlobalValue *Of = nullptr;
    APInt Offset;
    if (!IsConstantOffsetFromGlobal(C, Of, Offset, Layout) ||
        Layout.getTypeStoreSize(C->getType()) != 4)
      return false;
    const auto Found = Places.find(dyn_cast<GlobalVariable>(Of));
    if (Found == Places.end())
      return false;
    writeInteger(APInt(32, Found->second) + Offset.sextOrTrunc(32), I32, Place);
    Pointers.push_back(ConstantInt::get(I32, Place));
    return true;
  }

  Constant *number(uint64_t N) { return ConstantInt::get(I32, N); }

  Constant *table(Constant *Rows) {
    auto *G = new GlobalVariable(M, Rows->getType(), true,
                                 GlobalValue::PrivateLinkage, Rows);
    G->setAlignment(Align(4));
    return G;
  }

  void addRecord() {
    Constant *Nothing = ConstantPointerNull::get(Pointer);
    Constant *First =
        Contents.empty()
            ? Nothing
            : table(ConstantDataArray::get(M.getContext(), Contents));
    Constant *Moved =
        Pointers.empty() ? Nothing
                         : table(ConstantArray::get(
                               ArrayType::get(I32, Pointers.size()), Pointers));
    Constant *Record = ConstantStruct::getAnon(
        {number(Bytes), number(Alignment.value()), First,
         number(Contents.size()), Moved, number(Pointers.size())});
    new GlobalVariable(M, Record->getType(), true, GlobalValue::ExternalLinkage,
                       Record, VariablesRecord);
  }

  /// Where the variables lie, in \p F.
  Value *base(Function &F) {
    Instruction *&Known = Bases[&F];
    if (!Known) {
      auto Start = F.getEntryBlock().getFirstInsertionPt();
      while (isa<AllocaInst>(*Start))
        ++Start;
      IRBuilder<> Builder(&*Start);
      Known = Builder.CreateLoad(
          Pointer, M.getOrInsertGlobal(PoclGVarBufferName, Pointer),
          "variables");
    }
    return Known;
  }

  Value *address(Function &F, GlobalVariable *G) {
    Value *&Known = Addresses[{&F, G}];
    if (!Known) {
      Instruction *Base = cast<Instruction>(base(F));
      IRBuilder<> Builder(Base->getNextNode());
      Known = Builder.CreateInBoundsGEP(Builder.getInt8Ty(), Base,
                                        number(Places[G]), G->getName());
    }
    return Known;
  }

  void replace() {
    removeFromUsedLists(M, [&](Constant *C) {
      return Places.contains(dyn_cast<GlobalVariable>(C->stripPointerCasts()));
    });
    std::vector<Constant *> All;
    for (const auto &[G, Place] : Places) {
      G->setInitializer(UndefValue::get(G->getValueType()));
      All.push_back(G);
    }
    convertUsersOfConstantsToInstructions(All);
    for (const auto &[G, Place] : Places) {
      for (Use &U : make_early_inc_range(G->uses())) {
        auto *User = cast<Instruction>(U.getUser());
        U.set(address(*User->getFunction(), G));
      }
      G->eraseFromParent();
    }
  }

  Module &M;
  const DataLayout &Layout;
  std::string &Log;
  Type *I32;
  PointerType *Pointer;

  MapVector<GlobalVariable *, uint64_t> Places; ///< in bytes from the first
  uint64_t Bytes = 0;
  Align Alignment;
  std::vector<uint8_t> Contents;    ///< zeros follow
  std::vector<Constant *> Pointers; ///< places that hold addresses
  std::map<Function *, Instruction *> Bases;
  std::map<std::pair<Function *, GlobalVariable *>, Value *> Addresses;
};

} // namespace

bool placeProgramVariables(Module &M, size_t &Bytes, std::string &Log) {
  Placer P(M, Log);
  if (!P.run())
    return true;
  Bytes = P.bytes();
  // Read again with the program.
  if (Bytes)
    setModuleIntMetadata(&M, PoclGVarMDName, Bytes);
  return false;
}

void dropUnusedVariables(Module &M) {
  GlobalVariable *Base = M.getGlobalVariable(PoclGVarBufferName);
  GlobalVariable *Record = M.getGlobalVariable(VariablesRecord);
  if (!Record || (Base && !Base->use_empty()))
    return;
  if (Base)
    Base->eraseFromParent();
  Record->eraseFromParent();
}

} // namespace pocl
