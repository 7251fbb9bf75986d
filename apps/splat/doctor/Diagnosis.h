/// What `splat doctor` says.
#pragma once

#include <string>
#include <vector>

namespace vorion::splat {

enum class DiagnosisState {
  Well,
  Note, ///< changes what programs do, or how fast; nothing has to be mended
  Fault,
};

/// The state's name in tables and JSON.
const char *name(DiagnosisState State);

/// One thing that was looked at.
struct Diagnosis {
  DiagnosisState State = DiagnosisState::Well;
  std::string Subject; ///< "device"
  std::string Text;    ///< what is so: a sentence without its full stop
  std::string Fix;     ///< what to do about it; of a fault never empty
};

using Diagnoses = std::vector<Diagnosis>;

} // namespace vorion::splat
