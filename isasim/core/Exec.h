/// The instructions as code, one set for each vector level of the host.
#pragma once

#include "core/IsaTables.h"
#include "core/State.h"

namespace vorion::isasim {

struct ExecTable {
  const char *Level;            ///< "avx2", "baseline", "observed"
  const Handler (*Handlers)[2]; ///< [Op][WarpState::Full]
  Handler Illegal[2];           ///< a word that does not decode
  Handler NoFetch[2];           ///< no code here
  /// Runs \p S from S->Next until it stops.
  void (*Enter)(WarpState *S);
};

/// The best level that the host has; \p Observed: the one that reports every
/// instruction to S->Watcher.
const ExecTable &execTable(bool Observed);

/// The best level that the host has of those that write the clock's trace.
/// The observed one does that too.
const ExecTable &timedExecTable();

/// All levels that this host can run, best first (for tests).
struct ExecLevels {
  const ExecTable *Tables[2] = {};
  unsigned Count = 0;
};
ExecLevels hostLevels();

} // namespace vorion::isasim
