//===- Intrinsics.h - the table of our intrinsics ---------------*- C++ -*-===//
//
// The table itself is generated from intrinsics/*.td. An intrinsic is a call of
// a declaration whose name starts with "vorion.".
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_INTRINSICS_H
#define VORION_LLVM_BACKEND_INTRINSICS_H

#include "llvm/ADT/StringRef.h"
#include "llvm/IR/Module.h"
#include "llvm/Target/TargetIntrinsicInfo.h"

namespace llvm::vorion {

inline constexpr StringLiteral IntrinsicPrefix = "vorion.";

/// How the lanes of a warp see a result.
enum class Divergence { None, Source, Uniform, Operands };

struct IntrinsicRecord {
  StringLiteral Name; ///< without the prefix
  unsigned Opcode;    ///< COPY for what needs no instruction
  int CSR;            ///< its number, or -1
  unsigned Inputs;
  bool HasResult;
  Divergence Result;
  bool NeedsXVorion;
};

/// The intrinsic of that full name, or null.
const IntrinsicRecord *findIntrinsic(StringRef FullName);

/// The intrinsic that \p V calls, or null.
const IntrinsicRecord *findIntrinsic(const Value *V);

/// The declaration of the intrinsic of that short name, with the attributes
/// that keep calls of it in place.
Function *declareIntrinsic(Module &M, StringRef Name);

/// Kind of the metadata that marks an instruction as a source of divergence
/// (DivergenceAnalysis.cpp says when).
unsigned divergentMarker(LLVMContext &Context);

/// Kind of the metadata that says that lanes agree in an instruction's result.
unsigned uniformMarker(LLVMContext &Context);

} // namespace llvm::vorion

#endif
