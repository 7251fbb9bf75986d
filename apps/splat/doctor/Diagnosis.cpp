#include "doctor/Diagnosis.h"

namespace vorion::splat {

const char *name(DiagnosisState State) {
  switch (State) {
  case DiagnosisState::Well:
    return "ok";
  case DiagnosisState::Note:
    return "note";
  case DiagnosisState::Fault:
    return "fault";
  }
  return "";
}

} // namespace vorion::splat
