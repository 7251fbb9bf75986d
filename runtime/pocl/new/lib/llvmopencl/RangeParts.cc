//===- RangeParts.cc - launches that are parts of a range -----------------===//

#include "RangeParts.h"

#include "CompilerWarnings.h"
IGNORE_COMPILER_WARNING("-Wunused-parameter")
#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/IR/Instructions.h>
POP_COMPILER_DIAGS

#include <vorion_abi.h>

#include <cstddef>

using namespace llvm;

namespace pocl {

namespace {

constexpr const char *Prefix = "_vorion_launch_";

/// A number in one dimension.
using Question = function_ref<Value *(IRBuilder<> &, unsigned Dimension)>;

/// Makes \p Name, a function of a dimension, answer \p Ask, and \p Beyond in
/// dimensions that no range has.
void answer(Module &M, StringRef Name, unsigned Beyond, Question Ask) {
  Function *F = M.getFunction(Name);
  if (!F || F->isDeclaration())
    return;
  const GlobalValue::LinkageTypes Linkage = F->getLinkage();
  F->deleteBody();
  F->setLinkage(Linkage);
  IRBuilder<> Builder(BasicBlock::Create(M.getContext(), "", F));
  Value *Result = ConstantInt::get(F->getReturnType(), Beyond);
  for (unsigned Dimension = 0; Dimension < 3; ++Dimension)
    Result = Builder.CreateSelect(
        Builder.CreateICmpEQ(F->getArg(0), Builder.getInt32(Dimension)),
        Ask(Builder, Dimension), Result);
  Builder.CreateRet(Result);
}

Value *load(IRBuilder<> &Builder, const std::string &Name) {
  Module &M = *Builder.GetInsertBlock()->getModule();
  Type *I32 = Builder.getInt32Ty();
  return Builder.CreateLoad(I32, M.getOrInsertGlobal(Name, I32));
}

/// Element \p Dimension of the field of vx_launch at \p Offset.
Value *loadWord(IRBuilder<> &Builder, size_t Offset, unsigned Dimension) {
  return load(Builder, Prefix + std::to_string(Offset + 4 * Dimension));
}

/// The work-items of the whole range before the launch's first.
Value *loadSkipped(IRBuilder<> &Builder, unsigned Dimension) {
  return Builder.CreateMul(
      loadWord(Builder, offsetof(vx_launch, groups_before), Dimension),
      loadWord(Builder, offsetof(vx_launch, enqueued_size), Dimension));
}

/// One of PoCL's pseudo variables.
Value *loadPseudo(IRBuilder<> &Builder, const char *Name, unsigned Dimension) {
  return load(Builder, std::string(Name) + "xyz"[Dimension]);
}

/// Makes get_global_linear_id() answer for the whole range.
void answerLinearId(Module &M) {
  Function *F = M.getFunction("_Z20get_global_linear_idv");
  if (!F || F->isDeclaration())
    return;
  const GlobalValue::LinkageTypes Linkage = F->getLinkage();
  F->deleteBody();
  F->setLinkage(Linkage);
  IRBuilder<> Builder(BasicBlock::Create(M.getContext(), "", F));
  Value *Result = Builder.getInt32(0);
  for (unsigned Dimension : {2, 1, 0}) {
    Value *Own = Builder.CreateAdd(
        Builder.CreateMul(loadPseudo(Builder, "_local_size_", Dimension),
                          loadPseudo(Builder, "_group_id_", Dimension)),
        loadPseudo(Builder, "_local_id_", Dimension));
    Value *Size =
        loadWord(Builder, offsetof(vx_launch, global_size), Dimension);
    Result = Builder.CreateAdd(
        Builder.CreateMul(Result, Size),
        Builder.CreateAdd(loadSkipped(Builder, Dimension), Own));
  }
  Builder.CreateRet(Result);
}

} // namespace

void askForWholeRange(Module &M) {
  const auto AnswerSize = [&M](StringRef Name, size_t Offset) {
    answer(M, Name, 1, [Offset](IRBuilder<> &Builder, unsigned Dimension) {
      return loadWord(Builder, Offset, Dimension);
    });
  };
  AnswerSize("_Z14get_num_groupsj", offsetof(vx_launch, all_groups));
  AnswerSize("_Z15get_global_sizej", offsetof(vx_launch, global_size));
  AnswerSize("_Z23get_enqueued_local_sizej",
             offsetof(vx_launch, enqueued_size));
  answer(
      M, "_Z12get_group_idj", 0, [](IRBuilder<> &Builder, unsigned Dimension) {
        return Builder.CreateAdd(
            loadPseudo(Builder, "_group_id_", Dimension),
            loadWord(Builder, offsetof(vx_launch, groups_before), Dimension));
      });
  // The launch's own offset is that of its first work-item, less the range's
  // first group.
  answer(M, "_Z17get_global_offsetj", 0,
         [](IRBuilder<> &Builder, unsigned Dimension) {
           return Builder.CreateSub(
               loadPseudo(Builder, "_global_offset_", Dimension),
               loadSkipped(Builder, Dimension));
         });
  answerLinearId(M);
}

std::vector<GlobalVariable *> launchWords(Module &M) {
  std::vector<GlobalVariable *> Words;
  for (GlobalVariable &G : M.globals())
    if (isLaunchWord(&G))
      Words.push_back(&G);
  return Words;
}

bool isLaunchWord(const Value *Pointer) {
  return isa<GlobalVariable>(Pointer) && Pointer->getName().starts_with(Prefix);
}

Value *createLaunchWord(IRBuilder<> &Builder, Value *Launch,
                        const GlobalVariable &Word) {
  unsigned Offset = 0;
  Word.getName().drop_front(StringRef(Prefix).size()).getAsInteger(10, Offset);
  LoadInst *Load = Builder.CreateLoad(
      Word.getValueType(),
      Builder.CreateConstGEP1_32(Builder.getInt8Ty(), Launch, Offset));
  Load->setMetadata(LLVMContext::MD_invariant_load,
                    MDNode::get(Builder.getContext(), {}));
  return Load;
}

} // namespace pocl
