#include "doctor/Finding.h"

namespace vorion::splat {

const char *name(FindingState State) {
  switch (State) {
  case FindingState::Well:
    return "ok";
  case FindingState::Note:
    return "note";
  case FindingState::Fault:
    return "fault";
  }
  return "";
}

} // namespace vorion::splat
