//===- Exec.cpp - the instructions, compiled once for each vector level ---===//
//
// Every instruction is a function that ends in a tail call of the next one
// ("threaded code"), so the host's branch predictor sees a jump for each guest
// instruction and the compiler keeps nothing alive in between. An instruction
// has two forms: all 16 lanes active, or some of them.
//
// VORION_LEVEL names the level. VORION_OBSERVED builds the other instantiation
// of the core, which reports every instruction. VORION_TIMED builds the ones
// that write the clock's trace.
//
//===----------------------------------------------------------------------===//

#include "core/Exec.h"

#include "core/Atomics.h"
#include "core/Csr.h"
#include "core/LaneMemory.h"
#include "core/Level.h"
#include "core/Observing.h"
#include "core/Rounding.h"
#include "core/SoftFloat.h"
#include "core/Warps.h"
#include "timing/trace/TraceRecords.h"
#include "vorion/isasim/TrapCause.h"

#ifdef VORION_OBSERVED
#define VORION_REPORT(S, I) outside<observeCommit>(S, I)
#else
#define VORION_REPORT(S, I) ((void)0)
#endif
#ifdef VORION_TIMED
// For the clock (timing/trace/TraceWriter.h).
#define VORION_TRACE_RUN(S, START, END)                                        \
  ((S)->Trace ? outside<traceRun>(S, START, END) : (void)0)
#define VORION_TRACE_ACCESS(S, ADDRESSES, BYTES, IS_STORE, IS_ATOMIC)          \
  ((S)->Trace ? outside<traceAccess>(S, ADDRESSES, BYTES, IS_STORE, IS_ATOMIC) \
              : (void)0)
#else
#define VORION_TRACE_RUN(S, START, END) ((void)0)
#define VORION_TRACE_ACCESS(S, ADDRESSES, BYTES, IS_STORE, IS_ATOMIC) ((void)0)
#endif
#define VORION_TAIL [[clang::musttail]] return
#define VORION_NEXT                                                            \
  do {                                                                         \
    VORION_REPORT(S, I);                                                       \
    VORION_TAIL I[1].Run[Full](S, I + 1, Start);                               \
  } while (false)
/// After the active lanes may have changed, or everything has been counted.
#define VORION_RESUME(T)                                                       \
  do {                                                                         \
    const Insn *To = (T);                                                      \
    VORION_TAIL To->Run[S->Full](S, To, To);                                   \
  } while (false)
#define VORION_RARE(C) __builtin_expect(!!(C), 0)

namespace vorion::isasim::VORION_LEVEL {

namespace {

#include "core/insns/Common.inc"
#include "core/insns/Control.inc"
#include "core/insns/Float.inc"
#include "core/insns/Integer.inc"
#include "core/insns/Memory.inc"
#include "core/insns/Simt.inc"

#ifdef VORION_OBSERVED
template <typename Body> struct Watched {
  static void run(WarpState *S, const Insn *I, const Insn *Start) {
    outside<observeFetch>(S, I, Start);
    if (VORION_RARE(S->Moved)) {
      S->Moved = false;
      return;
    }
    VORION_TAIL Body::run(S, I, Start);
  }
};
#else
template <typename Body> using Watched = Body;
#endif

constexpr Handler Handlers[NumOps][2] = {
#define VORION_HANDLER(O)                                                      \
  {Watched<Exec<Op::O, false>>::run, Watched<Exec<Op::O, true>>::run},
    VORION_FOR_EACH_OP(VORION_HANDLER)
#undef VORION_HANDLER
};

void enter(WarpState *S) {
  S->Next->Run[S->Full](S, S->Next, S->Next);
#if defined(__AVX__)
  // The instructions leave the upper halves dirty (-mno-vzeroupper).
  _mm256_zeroupper();
#endif
}

} // namespace

#define VORION_STRING(X) #X
#define VORION_NAME(X) VORION_STRING(X)
extern const ExecTable Table;
const ExecTable Table = {VORION_NAME(VORION_LEVEL),
                         Handlers,
                         {illegal<false>, illegal<true>},
                         {noFetch<false>, noFetch<true>},
                         enter};

} // namespace vorion::isasim::VORION_LEVEL
