//===- SpirCalls.cc - calls of the built-in functions ---------------------===//

#include "SpirCalls.h"
#include "CompilerWarnings.h"
IGNORE_COMPILER_WARNING("-Wmaybe-uninitialized")
#include <llvm/ADT/StringMap.h>
#include <llvm/ADT/StringSet.h>
POP_COMPILER_DIAGS
IGNORE_COMPILER_WARNING("-Wunused-parameter")
#include <llvm/Demangle/Demangle.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Support/Regex.h>
POP_COMPILER_DIAGS

#include <array>
#include <cstdlib>
#include <utility>
#include <vector>

using namespace llvm;

namespace pocl {

namespace {

/// How PoCL's library calls its own functions, so that they are nobody else's.
constexpr StringLiteral OwnPrefix = "_cl_";

/// The name within _Z6vload4jPU3AS1Ki, without the library's prefix: vload4.
/// Nothing if the name is not of this kind.
StringRef baseName(StringRef Mangled) {
  unsigned Length = 0;
  if (!Mangled.consume_front("_Z") || Mangled.consumeInteger(10, Length))
    return {};
  StringRef Name = Mangled.take_front(Length);
  Name.consume_front(OwnPrefix);
  return Name;
}

void replaceAll(std::string &Text, StringRef From, StringRef To) {
  for (size_t At = 0; (At = Text.find(From.str(), At)) != std::string::npos;
       At += To.size())
    Text.replace(At, From.size(), To.str());
}

/// What both sides say of a function alike: vload4(unsigned int, int AS1*).
std::string signature(StringRef Mangled) {
  const std::string Name = Mangled.str(); // which the demangler refers to
  ItaniumPartialDemangler Demangler;
  if (Demangler.partialDemangle(Name.c_str()))
    return {};
  size_t Size = 0;
  char *Made = Demangler.finishDemangle(nullptr, &Size);
  std::string Text = Made ? Made : "";
  std::free(Made);
  if (StringRef(Text).starts_with(OwnPrefix))
    Text.erase(0, OwnPrefix.size());
  constexpr std::array<std::pair<StringLiteral, StringLiteral>, 9> Rules = {
      {{" CLglobal", " AS1"},
       {" CLconstant", " AS2"},
       {" CLlocal", " AS3"},
       {" CLgeneric", " AS4"},
       // Without a qualifier a pointer is one to private memory.
       {" CLprivate", ""},
       {" AS0", ""},
       // No two functions differ in these alone.
       {" const", ""},
       {" volatile", ""},
       {" restrict", ""}}};
  for (const auto &[From, To] : Rules)
    replaceAll(Text, From, To);
  return Text;
}

/// What a declaration of a translated module means, as signature() says it.
/// Dot products are instructions of SPIR-V. The translator makes functions of
/// them whose types say nothing of signs, and whose names do.
std::string meaning(StringRef Mangled) {
  const std::string Text = signature(Mangled);
  SmallVector<StringRef, 5> Parts;
  if (!StringRef(Text).starts_with("__spirv_") ||
      !Regex("^__spirv_(S|U|SU)Dot(AccSat)?(KHR)?_Ru?int"
             "\\(char vector\\[4\\], char vector\\[4\\](, int)?\\)$")
           .match(Text, &Parts))
    return Text;
  const StringRef Signs = Parts[1];
  const std::string First = Signs == "U" ? "unsigned char" : "char";
  const std::string Second = Signs == "S" ? "char" : "unsigned char";
  const std::string Sum = Parts[2].empty() ? ""
                          : Signs == "U"   ? ", unsigned int"
                                           : ", int";
  return (Parts[2].empty() ? "dot(" : "dot_acc_sat(") + First + " vector[4], " +
         Second + " vector[4]" + Sum + ")";
}

/// A function that a translated module wants, and what it means.
struct Declared {
  Function *Of;
  std::string Signature;
};

std::vector<Declared> declaredIn(Module &M) {
  std::vector<Declared> Found;
  for (Function &F : M)
    if (F.isDeclaration() && !baseName(F.getName()).empty())
      Found.push_back({&F, meaning(F.getName())});
  return Found;
}

/// The library's functions that may be meant, by signature.
StringMap<const Function *> findOffered(ArrayRef<Declared> Meant,
                                        const Module &Library) {
  StringSet<> Wanted;
  for (const Declared &Each : Meant)
    Wanted.insert(StringRef(Each.Signature).split('(').first);
  StringMap<const Function *> Offered;
  for (const Function &F : Library)
    if (!F.isDeclaration() && Wanted.contains(baseName(F.getName())))
      Offered.try_emplace(signature(F.getName()), &F);
  return Offered;
}

/// A variable of the caller.
AllocaInst *makeVariable(Function &Caller, Type *T) {
  BasicBlock &Entry = Caller.getEntryBlock();
  IRBuilder<> Builder(&Entry, Entry.getFirstInsertionPt());
  return Builder.CreateAlloca(T);
}

uint64_t bitsOf(const Type *T) { return T->getPrimitiveSizeInBits(); }

/// \p V, which is a number or a vector, as the integer type \p To and back:
/// clang hands small vectors over so. A vector of three leaves bits over.
Value *asInteger(IRBuilder<> &Builder, Value *V, Type *To) {
  Type *Own = Builder.getIntNTy(static_cast<unsigned>(bitsOf(V->getType())));
  return Builder.CreateZExtOrTrunc(Builder.CreateBitCast(V, Own), To);
}

Value *fromInteger(IRBuilder<> &Builder, Value *V, Type *To) {
  Type *Own = Builder.getIntNTy(static_cast<unsigned>(bitsOf(To)));
  return Builder.CreateBitCast(Builder.CreateZExtOrTrunc(V, Own), To);
}

bool isSmall(const Type *T) {
  return (T->isIntegerTy() || isa<FixedVectorType>(T)) && bitsOf(T) != 0;
}

/// \p V as a function of the library takes it, in a parameter of type \p To, or
/// nothing if it does not fit.
Value *handOver(IRBuilder<> &Builder, Value *V, Type *To) {
  if (V->getType() == To)
    return V;
  if (To->isPointerTy() && isa<FixedVectorType>(V->getType())) {
    AllocaInst *Variable =
        makeVariable(*Builder.GetInsertBlock()->getParent(), V->getType());
    Builder.CreateStore(V, Variable);
    return Variable;
  }
  if (To->isIntegerTy() && isSmall(V->getType()))
    return asInteger(Builder, V, To);
  return nullptr;
}

/// Replaces \p Call by one of \p Callee. Whether their types fit.
bool replaceCall(CallInst &Call, Function &Callee) {
  IRBuilder<> Builder(&Call);
  Type *Wanted = Call.getType();
  SmallVector<Value *, 8> Arguments;
  AllocaInst *Result = nullptr;
  if (Callee.hasStructRetAttr()) {
    if (Callee.getParamStructRetType(0) != Wanted)
      return false;
    Result = makeVariable(*Call.getFunction(), Wanted);
    Arguments.push_back(Result);
  }
  if (Arguments.size() + Call.arg_size() != Callee.arg_size())
    return false;
  for (Value *Argument : Call.args()) {
    Argument =
        handOver(Builder, Argument, Callee.getArg(Arguments.size())->getType());
    if (!Argument)
      return false;
    Arguments.push_back(Argument);
  }
  CallInst *New = Builder.CreateCall(&Callee, Arguments);
  const AttributeList Attributes = Callee.getAttributes();
  SmallVector<AttributeSet, 8> OfParameters;
  for (unsigned I = 0; I < Arguments.size(); ++I)
    OfParameters.push_back(Attributes.getParamAttrs(I));
  // What the old call says of memory is not true of the new one, which may
  // return through it.
  New->setAttributes(
      AttributeList::get(Call.getContext(),
                         Call.getAttributes().getFnAttrs().removeAttribute(
                             Call.getContext(), Attribute::Memory),
                         Attributes.getRetAttrs(), OfParameters));
  New->setDebugLoc(Call.getDebugLoc());
  Value *Value = New;
  if (Result)
    Value = Builder.CreateLoad(Wanted, Result);
  else if (New->getType() != Wanted) {
    if (!New->getType()->isIntegerTy() || !isSmall(Wanted))
      return false;
    Value = fromInteger(Builder, New, Wanted);
  }
  Call.replaceAllUsesWith(Value);
  Call.eraseFromParent();
  return true;
}

/// Makes all calls of \p F ones of the library's function \p Own.
bool replaceCalls(Function &F, const Function &Own) {
  F.setName("");
  auto *Callee = cast<Function>(
      F.getParent()
          ->getOrInsertFunction(Own.getName(), Own.getFunctionType())
          .getCallee());
  Callee->setAttributes(Own.getAttributes());
  for (User *U : make_early_inc_range(F.users())) {
    auto *Call = dyn_cast<CallInst>(U);
    if (!Call || !replaceCall(*Call, *Callee))
      return false;
  }
  F.eraseFromParent();
  return true;
}

/// What a function with a variable number of arguments is given as: vectors as
/// clang gives them, in an integer of one or two registers or by their place.
Value *handOverVariable(IRBuilder<> &Builder, Value *V) {
  // A program without doubles prints floats as they are; C promotes them.
  if (V->getType()->isFloatTy() || V->getType()->isHalfTy())
    return Builder.CreateFPExt(V, Builder.getDoubleTy());
  if (!isa<FixedVectorType>(V->getType()))
    return V;
  const uint64_t Bits = bitsOf(V->getType());
  return handOver(Builder, V,
                  Bits <= 32   ? Builder.getInt32Ty()
                  : Bits <= 64 ? static_cast<Type *>(Builder.getInt64Ty())
                               : Builder.getPtrTy());
}

void adaptPrints(Function &Print) {
  for (User *U : Print.users())
    if (auto *Call = dyn_cast<CallInst>(U)) {
      IRBuilder<> Builder(Call);
      for (unsigned I = 1; I < Call->arg_size(); ++I)
        Call->setArgOperand(I,
                            handOverVariable(Builder, Call->getArgOperand(I)));
    }
}

} // namespace

std::string callLibrary(Module &M, const Module &Library) {
  if (Function *Print = M.getFunction("printf"))
    adaptPrints(*Print);
  const std::vector<Declared> Meant = declaredIn(M);
  const StringMap<const Function *> Offered = findOffered(Meant, Library);
  for (auto [F, Signature] : Meant) {
    const Function *Own = Offered.lookup(Signature);
    if (!Own) {
      // SPIR-V wants some pointers generic that OpenCL C 1.2 has private. All
      // memory is read in the same way.
      replaceAll(Signature, " AS4", "");
      Own = Offered.lookup(Signature);
    }
    if (Own && !replaceCalls(*F, *Own))
      return "the built-in function " + Signature +
             " is called with other types than it has\n";
  }
  return {};
}

std::string findMismatchedCall(const Module &M) {
  for (const Function &F : M)
    for (const User *U : F.users())
      if (const auto *Call = dyn_cast<CallBase>(U);
          Call && Call->getCalledOperand() == &F &&
          Call->getFunctionType() != F.getFunctionType())
        return "the function " + F.getName().str() +
               " is called with other types than it has\n";
  return {};
}

} // namespace pocl
