#include "core/Exec.h"

namespace vorion::isasim {

// Exec.cpp, once for each.
namespace baseline {
extern const ExecTable Table;
}
#if VORION_OBSERVERS
namespace observed {
extern const ExecTable Table;
}
#endif
namespace timed {
extern const ExecTable Table;
}
#if defined(__x86_64__) && VORION_WIDE_VECTORS
namespace avx2 {
extern const ExecTable Table;
}
namespace timed_avx2 {
extern const ExecTable Table;
}
#endif

ExecLevels hostLevels() {
  ExecLevels L;
#if defined(__x86_64__) && VORION_WIDE_VECTORS
  // The x86-64-v3 level of the psABI, which Exec.cpp is compiled for.
  if (__builtin_cpu_supports("x86-64-v3"))
    L.Tables[L.Count++] = &avx2::Table;
#endif
  L.Tables[L.Count++] = &baseline::Table;
  return L;
}

const ExecTable &execTable([[maybe_unused]] bool Observed) {
  static const ExecLevels Levels = hostLevels();
#if VORION_OBSERVERS
  if (Observed)
    return observed::Table;
#endif
  return *Levels.Tables[0];
}

const ExecTable &timedExecTable() {
#if defined(__x86_64__) && VORION_WIDE_VECTORS
  if (__builtin_cpu_supports("x86-64-v3"))
    return timed_avx2::Table;
#endif
  return timed::Table;
}

} // namespace vorion::isasim
