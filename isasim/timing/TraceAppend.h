/// What instructions call to write a core's trace. Nothing of the library:
/// compiled into every timed vector level. S->Trace is not nullptr.
#pragma once

#include "core/State.h"
#include "timing/TraceRecords.h"

namespace vorion::isasim {

/// Appends the instructions from \p Start up to, not including, \p End.
void traceRun(WarpState *S, const Insn *Start, const Insn *End);
/// Appends where the active lanes' accesses of \p Bytes each go; \p Addresses
/// by lane. \p IsStore and \p IsAtomic say what the instruction is.
void traceAccess(WarpState *S, const uint32_t *Addresses, unsigned Bytes,
                 bool IsStore, bool IsAtomic);

} // namespace vorion::isasim
