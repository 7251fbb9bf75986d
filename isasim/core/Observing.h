/// What handlers of the observed level call. Compiled once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

/// Tells the observers that \p I is about to be executed (the instructions from
/// \p Start on have not been counted yet), and that it has been.
void observeFetch(WarpState *S, const Insn *I, const Insn *Start);
void observeCommit(WarpState *S, const Insn *I);

} // namespace vorion::isasim
