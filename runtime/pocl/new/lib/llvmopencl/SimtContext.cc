//===- SimtContext.cc - what work-items keep from region to region --------===//
//
// A value that a region computes and a later one reads has a place for each
// work-item: in the context, which is memory of the core.
//
//===----------------------------------------------------------------------===//

#include "SimtWorkitems.h"

#include <llvm/IR/MDBuilder.h>

#include <algorithm>
#include <map>

using namespace llvm;

namespace pocl {

/// All accesses through \p Pointer; false if it may be used otherwise.
static bool collectAccesses(const Value *Pointer,
                            std::vector<const Instruction *> &Accesses) {
  for (const User *U : Pointer->users()) {
    if (isa<GetElementPtrInst>(U)) {
      if (!collectAccesses(U, Accesses))
        return false;
    } else if (isa<LoadInst>(U) ||
               (isa<StoreInst>(U) && U->getOperand(0) != Pointer)) {
      Accesses.push_back(cast<Instruction>(U));
    } else {
      return false;
    }
  }
  return true;
}

AllocaInst *SimtLoops::createContextArray(Type *Element, Align Alignment,
                                          const std::string &Name) {
  IRBuilder<> Builder(&*F.getEntryBlock().getFirstInsertionPt());
  ContextArrays.push_back(
      {Builder.CreateAlloca(Element, nullptr, Name), Alignment});
  return ContextArrays.back().Placeholder;
}

/// Alias analysis walks the lists of both accesses for each pair of them, and a
/// kernel in rounds keeps hundreds of values: one took 109 s to compile with a
/// scope for each, 39 s with 64 or 24.
static constexpr size_t MaxScopes = 64;

void SimtLoops::tellAliases() {
  // Arrays whose address goes nowhere but into loads and stores.
  MDBuilder Builder(F.getContext());
  MDNode *Domain = Builder.createAnonymousAliasScopeDomain("simt_context");
  std::map<const Instruction *, Metadata *> ScopeOf;
  std::vector<Metadata *> Scopes;
  size_t Number = 0;
  for (const ContextArray &Array : ContextArrays) {
    std::vector<const Instruction *> Accesses;
    if (!collectAccesses(Array.Placeholder, Accesses))
      continue;
    if (Scopes.size() < MaxScopes)
      Scopes.push_back(Builder.createAnonymousAliasScope(Domain));
    for (const Instruction *I : Accesses)
      ScopeOf[I] = Scopes[Number % MaxScopes];
    ++Number;
  }
  if (Scopes.empty())
    return;
  for (BasicBlock &Block : F)
    for (Instruction &I : Block) {
      if (!isa<LoadInst, StoreInst>(I))
        continue;
      const auto Own = ScopeOf.find(&I);
      std::vector<Metadata *> Others;
      for (Metadata *Scope : Scopes)
        if (Own == ScopeOf.end() || Scope != Own->second)
          Others.push_back(Scope);
      const auto Add = [&I](unsigned Kind, ArrayRef<Metadata *> List) {
        I.setMetadata(Kind,
                      MDNode::concatenate(I.getMetadata(Kind),
                                          MDNode::get(I.getContext(), List)));
      };
      if (Own != ScopeOf.end())
        Add(LLVMContext::MD_alias_scope, Own->second);
      if (!Others.empty())
        Add(LLVMContext::MD_noalias, Others);
    }
}

/// Pass by pass, and array by array in a pass: what a pass keeps lies within
/// reach of one address, and lanes that follow each other read words that do.
uint64_t SimtLoops::placeContextArrays() {
  if (ContextArrays.empty())
    return 0;
  IRBuilder<> Builder(F.getEntryBlock().getTerminator());
  Value *Context = Builder.CreateLoad(
      Builder.getPtrTy(),
      M.getOrInsertGlobal(SimtContextGlobal, Builder.getPtrTy()),
      "simt_context");
  // An element's size is a multiple of its alignment. With the largest
  // alignment first every array of the first pass begins aligned, and the sum
  // is rounded up so that those of the others do.
  std::stable_sort(ContextArrays.begin(), ContextArrays.end(),
                   [](const ContextArray &A, const ContextArray &B) {
                     return A.Alignment > B.Alignment;
                   });
  const DataLayout &Layout = M.getDataLayout();
  uint64_t Bytes = 0;
  for (const ContextArray &Array : ContextArrays)
    Bytes += Layout.getTypeAllocSize(Array.Placeholder->getAllocatedType());
  Bytes = alignTo(Bytes, ContextArrays.front().Alignment);
  uint64_t Offset = 0;
  for (const ContextArray &Array : ContextArrays) {
    const std::vector<User *> Users(Array.Placeholder->user_begin(),
                                    Array.Placeholder->user_end());
    for (User *U : Users) {
      auto *Element = cast<GetElementPtrInst>(U);
      Builder.SetInsertPoint(Element);
      Value *Base = Builder.CreateSub(Element->getOperand(1), Lane);
      Value *Start = Builder.CreateGEP(
          Builder.getInt8Ty(), Context,
          Builder.CreateAdd(Builder.CreateMul(Base, number(Bytes)),
                            number(Lanes * Offset)),
          Array.Placeholder->getName());
      Element->setOperand(0, Start);
      Element->setOperand(1, Lane);
    }
    Offset += Layout.getTypeAllocSize(Array.Placeholder->getAllocatedType());
    Array.Placeholder->eraseFromParent();
  }
  return Bytes;
}

} // namespace pocl
