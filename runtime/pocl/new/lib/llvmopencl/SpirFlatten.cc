//===- SpirFlatten.cc - one address space ---------------------------------===//

#include "SpirFlatten.h"
#include "CompilerWarnings.h"
IGNORE_COMPILER_WARNING("-Wmaybe-uninitialized")
#include <llvm/ADT/DenseMap.h>
POP_COMPILER_DIAGS
IGNORE_COMPILER_WARNING("-Wunused-parameter")
#include <llvm/IR/Constants.h>
#include <llvm/IR/DerivedTypes.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/Intrinsics.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/ValueMapper.h>
POP_COMPILER_DIAGS

#include <optional>

using namespace llvm;

namespace pocl {

namespace {

class FlatTypes : public ValueMapTypeRemapper {
public:
  Type *remapType(Type *T) override {
    Type *&Known = Flat[T];
    if (!Known) {
      Type *Made = make(T);
      // Making it may have moved the table.
      Flat[T] = Made;
      return Made;
    }
    return Known;
  }

private:
  Type *make(Type *T) {
    if (isa<PointerType>(T))
      return PointerType::get(T->getContext(), 0);
    if (auto *V = dyn_cast<VectorType>(T))
      return VectorType::get(remapType(V->getElementType()),
                             V->getElementCount());
    if (auto *A = dyn_cast<ArrayType>(T))
      return ArrayType::get(remapType(A->getElementType()),
                            A->getNumElements());
    if (auto *F = dyn_cast<FunctionType>(T))
      return FunctionType::get(remapType(F->getReturnType()), all(F->params()),
                               F->isVarArg());
    if (auto *S = dyn_cast<StructType>(T); S && !S->isOpaque()) {
      const SmallVector<Type *, 8> Elements = all(S->elements());
      if (ArrayRef<Type *>(Elements) == S->elements())
        return S;
      if (S->isLiteral())
        return StructType::get(S->getContext(), Elements, S->isPacked());
      return StructType::create(S->getContext(), Elements, S->getName(),
                                S->isPacked());
    }
    return T;
  }

  SmallVector<Type *, 8> all(ArrayRef<Type *> Types) {
    SmallVector<Type *, 8> Result;
    for (Type *T : Types)
      Result.push_back(remapType(T));
    return Result;
  }

  DenseMap<Type *, Type *> Flat;
};

/// Copies a module and drops the casts between address spaces in constants; in
/// code they go afterwards.
class Flattener : private ValueMaterializer {
public:
  explicit Flattener(const Module &From)
      : From(From), To(std::make_unique<Module>(From.getModuleIdentifier(),
                                                From.getContext())) {}

  std::unique_ptr<Module> run() {
    To->setTargetTriple(From.getTargetTriple());
    To->setDataLayout(From.getDataLayout());
    declare();
    for (const GlobalVariable &G : From.globals())
      if (G.hasInitializer())
        cast<GlobalVariable>(Map[&G])->setInitializer(
            MapValue(G.getInitializer(), Map, RF_None, &Types, this));
    for (const Function &F : From)
      if (!F.isDeclaration())
        define(F);
    for (const NamedMDNode &Node : From.named_metadata()) {
      NamedMDNode *Copy = To->getOrInsertNamedMetadata(Node.getName());
      if (Copy->getNumOperands() == 0)
        for (const MDNode *Operand : Node.operands())
          Copy->addOperand(MapMetadata(Operand, Map, RF_None, &Types, this));
    }
    for (Function &F : make_early_inc_range(*To))
      if (std::optional<Function *> Named =
              Intrinsic::remangleIntrinsicFunction(&F)) {
        F.replaceAllUsesWith(*Named);
        F.eraseFromParent();
      }
    return std::move(To);
  }

private:
  Value *materialize(Value *V) override {
    auto *Cast = dyn_cast<ConstantExpr>(V);
    if (!Cast || Cast->getOpcode() != Instruction::AddrSpaceCast)
      return nullptr;
    return MapValue(Cast->getOperand(0), Map, RF_None, &Types, this);
  }

  void declare() {
    for (const GlobalVariable &G : From.globals()) {
      auto *Copy =
          new GlobalVariable(*To, Types.remapType(G.getValueType()),
                             G.isConstant(), G.getLinkage(), nullptr,
                             G.getName(), nullptr, G.getThreadLocalMode(), 0);
      Copy->copyAttributesFrom(&G);
      Map[&G] = Copy;
    }
    for (const Function &F : From) {
      Function *Copy = Function::Create(
          cast<FunctionType>(Types.remapType(F.getFunctionType())),
          F.getLinkage(), 0, F.getName(), To.get());
      Copy->copyAttributesFrom(&F);
      Map[&F] = Copy;
    }
  }

  void define(const Function &F) {
    auto *Copy = cast<Function>(Map[&F]);
    auto Argument = Copy->arg_begin();
    for (const llvm::Argument &A : F.args()) {
      Argument->setName(A.getName());
      Map[&A] = &*Argument++;
    }
    SmallVector<ReturnInst *, 4> Returns;
    CloneFunctionInto(Copy, &F, Map, CloneFunctionChangeType::DifferentModule,
                      Returns, "", nullptr, &Types, this);
    for (Instruction &I : make_early_inc_range(instructions(Copy)))
      if (auto *Cast = dyn_cast<AddrSpaceCastInst>(&I)) {
        Cast->replaceAllUsesWith(Cast->getOperand(0));
        Cast->eraseFromParent();
      }
  }

  const Module &From;
  std::unique_ptr<Module> To;
  FlatTypes Types;
  ValueToValueMapTy Map;
};

} // namespace

std::unique_ptr<Module> flattenAddressSpaces(const Module &From) {
  return Flattener(From).run();
}

} // namespace pocl
