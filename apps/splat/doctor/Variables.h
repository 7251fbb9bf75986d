/// The environment variables of this project.
#pragma once

#include "doctor/Diagnosis.h"

#include <span>
#include <string>

namespace vorion::splat {

struct KnownVariable {
  const char *Name;
  const char *Effect; ///< "writes a timeline for Perfetto"
  /// Whether it attaches an observer, which may write files or wait for a
  /// debugger.
  bool Watches;
};

std::span<const KnownVariable> knownVariables();

/// A note for each variable VORION_* of \p Environment ("NAME=TEXT") that is
/// known, and a fault for each that is unknown.
Diagnoses examineVariables(std::span<const std::string> Environment);

} // namespace vorion::splat
