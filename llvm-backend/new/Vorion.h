//===- Vorion.h - what LLVM's RISC-V target calls of ours -------*- C++ -*-===//
//
// patches/ puts one call to each of these into upstream's files; nothing else
// of ours is in them.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_VORION_H
#define VORION_LLVM_BACKEND_VORION_H

#include <string>
#include <vector>

namespace llvm {
class AtomicRMWInst;
class Function;
class FunctionPass;
class Instruction;
class MachineFunction;
class MachineInstr;
class Pass;
class PassBuilder;
class RISCVSubtarget;
class RISCVTargetMachine;
class SDNode;
class SDValue;
class SelectionDAG;
class Value;
template <typename T> class SmallVectorImpl;

namespace vorion {

/// Selects the instruction of one of our intrinsics (Intrinsics.cpp). False if
/// \p Node is not one.
bool selectIntrinsic(SDNode *Node, SelectionDAG &DAG,
                     const RISCVSubtarget &Subtarget);

/// Whether every float constant is an instruction (FloatConstants.cpp).
bool hasFloatConstants(const RISCVSubtarget &Subtarget);

/// Selects that instruction. False if \p Node is no constant of 32 bits or the
/// machine is not ours.
bool selectFloatConstant(SDNode *Node, SelectionDAG &DAG,
                         const RISCVSubtarget &Subtarget);

/// Whether no register may be free at one of them in \p MF, once registers are
/// given. Then the frame must be there in the whole function: the slot below
/// may be needed where prologues that come later have not yet made it.
bool mayLackRegister(const MachineFunction &MF);

/// Expands all of them in \p MF, once registers are given and before its frame
/// is laid out. Says whether the frame needs a slot in which a register can be
/// saved, because none is free at one of them.
bool expandFloatConstants(MachineFunction &MF);

/// Whether lanes may differ in \p V although they agree in its operands.
bool isSourceOfDivergence(const Value *V);

/// Whether all active lanes agree in \p V whatever its operands are.
bool isAlwaysUniform(const Value *V);

/// Turns a select of floats into one of integers, which has no branch
/// (Branchless.cpp). A null value if \p Select is not one or the machine is not
/// ours.
SDValue lowerFloatSelect(SDValue Select, SelectionDAG &DAG,
                         const RISCVSubtarget &Subtarget);

/// Expands the pseudo instructions that upstream expands into branches into
/// straight code, in place. False if \p MI is not one or the machine is not
/// ours.
bool expandWithoutBranch(MachineInstr &MI, const RISCVSubtarget &Subtarget);

/// Whether \p Operation becomes a loop around compare-and-swap in IR: all that
/// amo*.w cannot do, so that selection never makes LR/SC.
bool expandsToCompareExchange(const AtomicRMWInst &Operation,
                              const RISCVSubtarget &Subtarget);

/// Whether there are atomics of 64 bits (WideAtomics.cpp): a compare-and-swap
/// of a pair of registers, and loops around it.
bool hasWideAtomics(const RISCVSubtarget &Subtarget);

/// Whether \p Access, a load or store, is of that size.
bool isWideAtomic(const Instruction &Access, const RISCVSubtarget &Subtarget);

/// Replaces a compare-and-swap of 64 bits with its instruction. False if
/// \p Node is something else.
bool replaceWideCompareExchange(SDNode *Node, SmallVectorImpl<SDValue> &Results,
                                SelectionDAG &DAG);

/// A module compiled for our machine is so in all its functions: bitcode from
/// another front end (PoCL's) carries feature lists that do not know it. Puts
/// the module's CPU and features in place of a function's.
void preferModuleTarget(const std::string &ModuleCPU,
                        const std::string &ModuleFeatures, std::string &CPU,
                        std::string &TuneCPU, std::string &Features);

/// Puts what must be known of a module for our machine before anything else in
/// its optimisation (SharedVariables.cpp), and gives our steps over IR names.
void registerFirstPasses(PassBuilder &PB, const RISCVTargetMachine &TM);

/// The names that -passes= has for our steps over functions (Steps.cpp).
void registerSteps(PassBuilder &PB, const RISCVTargetMachine &TM);

/// The passes that lower divergence, in order; last before selection. Each does
/// nothing to functions that are not for our machine.
std::vector<Pass *> createDivergencePasses();

/// Right after selection: refuses branches that selection made.
FunctionPass *createRefuseBranchesPass();

/// Before registers are given: puts constants where registers are left for them
/// (PlaceConstants.cpp).
FunctionPass *createPlaceConstantsPass();

/// Before emission: refuses functions whose splits and joins do not pair.
FunctionPass *createVerifySplitsPass();

} // namespace vorion
} // namespace llvm

#endif
