/// The results of `splat doctor`.
#pragma once

#include <string>
#include <vector>

namespace vorion::splat {

enum class DiagnosisState {
  Well,
  Note, ///< affects behaviour or speed; nothing to fix
  Fault,
};

/// The state's name in tables and JSON.
const char *name(DiagnosisState State);

/// The result of one check.
struct Diagnosis {
  DiagnosisState State = DiagnosisState::Well;
  std::string Subject; ///< "device"
  std::string Text;    ///< the finding: a sentence without its period
  std::string Fix;     ///< how to fix it; never empty for a fault
};

using Diagnoses = std::vector<Diagnosis>;

} // namespace vorion::splat
