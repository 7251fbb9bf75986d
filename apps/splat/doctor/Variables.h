/// The variables of the environment that programs of ours read.
#pragma once

#include "doctor/Diagnosis.h"

#include <span>
#include <string>

namespace vorion::splat {

struct KnownVariable {
  const char *Name;
  const char *Effect; ///< "writes a timeline for Perfetto"
  /// Watches runs, and may write files or wait for a debugger.
  bool Watches;
};

std::span<const KnownVariable> knownVariables();

/// A note for each variable VORION_* of \p Environment ("NAME=TEXT") that has
/// an effect, and a fault for each that has none.
Diagnoses examineVariables(std::span<const std::string> Environment);

} // namespace vorion::splat
