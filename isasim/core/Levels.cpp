#include "core/Exec.h"

namespace vorion::isasim {

// Exec.cpp, once for each.
namespace baseline {
extern const ExecTable Table;
}
namespace observed {
extern const ExecTable Table;
}
#if defined(__x86_64__)
namespace avx2 {
extern const ExecTable Table;
}
#endif

ExecLevels hostLevels() {
  ExecLevels L;
#if defined(__x86_64__)
  // The x86-64-v3 level of the psABI, which Exec.cpp is compiled for.
  if (__builtin_cpu_supports("x86-64-v3"))
    L.Tables[L.Count++] = &avx2::Table;
#endif
  L.Tables[L.Count++] = &baseline::Table;
  return L;
}

const ExecTable &execTable(bool Observed) {
  static const ExecLevels Levels = hostLevels();
  return Observed ? observed::Table : *Levels.Tables[0];
}

} // namespace vorion::isasim
