/// Causes of traps. A separate header because code that is compiled for several
/// vector levels includes it, and nothing else of the library.
#pragma once

namespace vorion::isasim {

enum class TrapCause {
  IllegalInstruction,
  FetchFault,      ///< pc outside the executable segments
  MisalignedFetch, ///< jump target not a multiple of 4
  LoadFault,       ///< no memory there
  StoreFault,      ///< no memory there, or read-only
  MisalignedLoad,  ///< also of an atomic
  MisalignedStore, ///< also of an atomic
  Breakpoint,      ///< ebreak
  EnvironmentCall, ///< ecall
  DivergentBranch, ///< active lanes disagree at a branch that no split guards
  DivergentJump,   ///< active lanes disagree about the target of jalr
  DivergenceOverflow,  ///< Config::DivergenceDepth
  DivergenceUnderflow, ///< vx_join on an empty stack
  EmptyMask,           ///< vx_pred left no lane active
  BadBarrier,          ///< vx_bar of a barrier that the machine does not have
  StackOverflow,       ///< an access left the lane's own stack
  DivergentBarrier,    ///< vx_bar on a path that only some lanes have taken
};

} // namespace vorion::isasim
