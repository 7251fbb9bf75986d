#include "KernelModule.h"

#include "ProgramVariables.h"
#include "SharedVariables.h"
#include "SimtWorkitems.h"
#include "pocl_llvm_api.h"

#include <vorion/runtime.h>
#include <vorion_abi.h>

#include <llvm/Bitcode/BitcodeWriter.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/raw_ostream.h>
#include <llvm/Transforms/Utils/ModuleUtils.h>

using namespace llvm;

namespace vorion {

namespace {

/// Hidden parameters that PoCL appends: the launch block and the group's
/// number.
constexpr unsigned HiddenParameters = 4;

class Finisher {
public:
  Finisher(Module &M, const KernelDescription &Kernel)
      : M(M), Kernel(Kernel), I32(Type::getInt32Ty(M.getContext())) {}

  std::string run() {
    Function *Entry = M.getFunction(Kernel.Name + "_workgroup_argbuffer");
    Function *Body = M.getFunction("_pocl_kernel_" + Kernel.Name);
    if (!Entry || !Body)
      return "the work-group function of " + Kernel.Name + " is missing";
    if (Body->arg_size() != Kernel.Arguments.size() + HiddenParameters)
      return Kernel.Name + " has " +
             std::to_string(Body->arg_size() - HiddenParameters) +
             " parameters, expected " + std::to_string(Kernel.Arguments.size());

    unsigned long Failure = 0;
    getModuleIntMetadata(M, pocl::SimtFailure, Failure);
    if (Failure)
      return "its barriers cannot be mapped to loops over work-items: expected "
             "that all work-items of a group reach each";

    // The target, its features and frames are the compiler's to choose. The
    // library's functions are compiled as freestanding ("no-builtins"), which
    // alone keeps them from being inlined into kernels, that are not.
    for (Function &F : M) {
      for (const char *Attribute :
           {"target-cpu", "target-features", "tune-cpu", "stackrealign",
            "frame-pointer", "no-builtins"})
        F.removeFnAttr(Attribute);
      if (!F.isDeclaration())
        F.setLinkage(GlobalValue::InternalLinkage);
    }
    // An image has a copy of a table for each kernel that uses it.
    for (GlobalVariable &G : M.globals())
      if (G.isConstant() && G.hasInitializer())
        G.setLinkage(GlobalValue::InternalLinkage);

    // Seen from the entry, arguments and group numbers are the same for all
    // lanes; as parameters of another function they might not be.
    Body->removeFnAttr(Attribute::NoInline);
    Body->removeFnAttr(Attribute::OptimizeNone);
    Body->addFnAttr(Attribute::AlwaysInline);
    Entry->removeFnAttr(Attribute::AlwaysInline);
    Entry->addFnAttr("vorion-kernel");
    // Inlined, a structure becomes a copy of no known alignment, whose words
    // would be read byte by byte.
    Entry->addParamAttr(0, Attribute::getWithAlignment(
                               M.getContext(), Align(VX_MEM_ALIGNMENT)));
    Entry->setName(Kernel.Name);
    keepLines(*Entry, *Body);

    llvm::vorion::forgetSharedVariables(M);
    const uint64_t LocalBytes = placeLocals();
    constexpr uint64_t MostBytes = UINT32_MAX - VX_LOCAL_BASE;
    if (LocalBytes > MostBytes)
      return "it uses " + std::to_string(LocalBytes) +
             " bytes of static local memory, expected at most " +
             std::to_string(MostBytes);
    addRecord(*Entry, *Body, LocalBytes);
    addVariables(*Entry);
    if (GlobalVariable *Context = M.getGlobalVariable(pocl::SimtContextGlobal))
      if (Context->use_empty())
        Context->eraseFromParent();
    return {};
  }

private:
  /// The entry becomes the function that the source's lines belong to: in one
  /// without a description of its own they would be lost. PoCL gave \p Body a
  /// copy of the kernel's with another name.
  void keepLines(Function &Entry, Function &Body) {
    DISubprogram *Lines = Body.getSubprogram();
    if (!Lines)
      return;
    constexpr unsigned Name = 2;
    Lines->replaceOperandWith(Name, MDString::get(M.getContext(), Kernel.Name));
    // Its call bears no place, so that the inlined code keeps its own.
    Body.setSubprogram(nullptr);
    Entry.setSubprogram(Lines);
  }

  /// Variables of program scope are elsewhere by now. What is left belongs to a
  /// group, which has the core's local memory to itself.
  uint64_t placeLocals() {
    uint64_t Used = placeScratch();
    for (GlobalVariable &G : M.globals()) {
      if (G.isConstant() || !G.hasInitializer() || !G.hasLocalLinkage() ||
          G.use_empty())
        continue;
      const DataLayout &Layout = M.getDataLayout();
      Used = alignTo(Used, std::max(G.getAlign().valueOrOne(),
                                    Layout.getPreferredAlign(&G)));
      G.replaceAllUsesWith(ConstantExpr::getIntToPtr(
          ConstantInt::get(I32, VX_LOCAL_BASE + Used), G.getType()));
      nameForDebuggers(G, VX_LOCAL_BASE + Used);
      Used += Layout.getTypeAllocSize(G.getValueType());
    }
    return Used;
  }

  /// Nothing refers to \p G any more, but a debugger finds variables by their
  /// symbols: where it has lines, it becomes a name of \p Address.
  void nameForDebuggers(GlobalVariable &G, uint64_t Address) {
    if (!G.hasMetadata(LLVMContext::MD_dbg))
      return;
    SmallVector<DIGlobalVariableExpression *, 1> Places;
    G.getDebugInfo(Places);
    // LLVM 19 would leave it to a copy of the kernel that has no addresses.
    constexpr unsigned Scope = 0;
    for (const DIGlobalVariableExpression *P : Places)
      P->getVariable()->replaceOperandWith(Scope, P->getVariable()->getFile());
    G.setInitializer(nullptr);
    G.setLinkage(GlobalValue::ExternalLinkage);
    M.appendModuleInlineAsm(".set \"" + G.getName().str() + "\", " +
                            std::to_string(Address));
    appendToCompilerUsed(M, {&G}); // passes drop what nobody uses
  }

  /// The memory of functions that a group calls together, 8 bytes for each
  /// subgroup (libdevice/opencl/workgroup.cl). Its size.
  uint64_t placeScratch() {
    GlobalVariable *Scratch = M.getGlobalVariable("vorion_scratch");
    if (!Scratch || Scratch->use_empty())
      return 0;
    Scratch->replaceAllUsesWith(ConstantExpr::getIntToPtr(
        ConstantInt::get(I32, VX_LOCAL_BASE), Scratch->getType()));
    return uint64_t{8} * divideCeil(Kernel.MaxItems, pocl::simtLanes(M));
  }

  Constant *number(uint64_t N) { return ConstantInt::get(I32, N); }

  Constant *text(const std::string &Value) {
    Constant *Bytes = ConstantDataArray::getString(M.getContext(), Value);
    auto *G = new GlobalVariable(M, Bytes->getType(), true,
                                 GlobalValue::PrivateLinkage, Bytes);
    G->setUnnamedAddr(GlobalValue::UnnamedAddr::Global);
    G->setAlignment(Align(1));
    return G;
  }

  /// What vorion-sim's --arg is compared with.
  static uint32_t valueKind(const Type &T) {
    if (T.isIntegerTy())
      return VX_ARG_INTEGER;
    return T.isFloatTy() ? VX_ARG_FLOAT : VX_ARG_VALUE;
  }

  /// Arguments lie as PoCL's launcher reads them: each at a multiple of its
  /// size rounded up to a power of two.
  void addRecord(Function &Entry, Function &Body, uint64_t LocalBytes) {
    const DataLayout &Layout = M.getDataLayout();
    std::vector<Constant *> Arguments;
    uint64_t End = 0;
    for (size_t I = 0; I < Kernel.Arguments.size(); ++I) {
      const Argument &A = *Body.getArg(I);
      const uint64_t Size = Layout.getTypeStoreSize(
          A.hasByValAttr() ? A.getParamByValType() : A.getType());
      const uint64_t Offset = alignTo(End, PowerOf2Ceil(Size));
      End = Offset + Size;
      const KernelArgument &Known = Kernel.Arguments[I];
      const uint32_t Kind =
          Known.Kind == VX_ARG_VALUE ? valueKind(*A.getType()) : Known.Kind;
      Arguments.push_back(ConstantStruct::getAnon(
          {text(Known.Name), number(Kind), number(Offset), number(Size)}));
    }

    Constant *Table =
        Constant::getNullValue(PointerType::get(M.getContext(), 0));
    if (!Arguments.empty()) {
      Constant *Rows = ConstantArray::get(
          ArrayType::get(Arguments[0]->getType(), Arguments.size()), Arguments);
      Table = new GlobalVariable(M, Rows->getType(), true,
                                 GlobalValue::PrivateLinkage, Rows);
    }

    unsigned long ContextBytes = 0;
    getModuleIntMetadata(M, pocl::SimtContextBytes, ContextBytes);
    Constant *Record = ConstantStruct::getAnon(
        {text(Kernel.Name), &Entry, Table, number(Arguments.size()),
         number(End), number(ContextBytes), number(LocalBytes),
         number(Kernel.LocalSize[0]), number(Kernel.LocalSize[1]),
         number(Kernel.LocalSize[2]), number(pocl::simtLanes(M)),
         number(0)}); // its stack, which vorion-link knows
    addRow(Record, "vorion_kernel", "vorion_kernels");
  }

  /// A row of a table of the image.
  void addRow(Constant *Row, const std::string &Name, const char *Section) {
    auto *G = new GlobalVariable(M, Row->getType(), true,
                                 GlobalValue::InternalLinkage, Row,
                                 Name + "." + Kernel.Name);
    G->setSection(Section);
    G->setAlignment(Align(4));
    appendToUsed(M, {G});
  }

  /// Says which variables of program scope the kernel uses.
  void addVariables(Function &Entry) {
    GlobalVariable *Known = M.getGlobalVariable(pocl::VariablesRecord, true);
    if (!Known)
      return;
    std::vector<Constant *> Fields = {&Entry};
    for (const Use &Field : Known->getInitializer()->operands())
      Fields.push_back(cast<Constant>(Field));
    addRow(ConstantStruct::getAnon(Fields), "vorion_variables",
           "vorion_variables");
    Known->eraseFromParent();
  }

  Module &M;
  const KernelDescription &Kernel;
  Type *I32;
};

} // namespace

std::string finishKernelModule(void *ModulePointer,
                               const KernelDescription &Kernel,
                               std::string &Bitcode) {
  Module &M = *static_cast<Module *>(ModulePointer);
  if (std::string Problem = Finisher(M, Kernel).run(); !Problem.empty())
    return Problem;
  raw_string_ostream Out(Bitcode);
  WriteBitcodeToFile(M, Out);
  return {};
}

} // namespace vorion
