#include "core/Watch.h"

#include "core/Atomics.h"
#include "core/Core.h"
#include "core/Observing.h"

#include <algorithm>

namespace vorion::isasim {

bool describeAccess(const Decoded &D, MemoryAccess &A) {
  switch (D.Opcode) {
#define LOAD(OP, T)                                                            \
  case Op::OP:                                                                 \
    A.What = MemoryAccess::Load;                                               \
    A.Bytes = sizeof(T);                                                       \
    return true;
#define STORE(OP, T)                                                           \
  case Op::OP:                                                                 \
    A.What = MemoryAccess::Store;                                              \
    A.Bytes = sizeof(T);                                                       \
    return true;
#define AMO(OP, KIND)                                                          \
  case Op::OP:                                                                 \
    A.What = MemoryAccess::Atomic;                                             \
    A.Bytes = bytesOf(Amo::KIND);                                              \
    return true;
#include "core/insns/memory.def"
  default:
    return false;
  }
}

void Watch::prepare(const CodeTable &Code, unsigned WarpsPerCoreIn,
                    unsigned Cores) {
  WarpsPerCore = WarpsPerCoreIn;
  Warps.assign(size_t{WarpsPerCore} * Cores, Pending());
  Insns.assign(Code.count() + 1, Decoded());
  for (uint32_t N = 0; N != Code.count(); ++N)
    if (const std::optional<Decoded> D = decode(Code.begin()[N].Word))
      Insns[N] = *D;
}

Watch::Pending &Watch::pendingOf(const WarpState *S) {
  return Warps[size_t{S->Owner->id()} * WarpsPerCore + S->WarpId];
}

void Watch::fetch(WarpState *S, const Insn *I, uint64_t Retired) {
  Pending P;
  const Decoded &D = Insns[static_cast<size_t>(I - S->Code)];
  P.HasAccess = describeAccess(D, P.Access);
  if (P.HasAccess) {
    // An atomic has no offset, and Imm is 0.
    const uint32_t *Base = S->lanes(I->Rs1);
    for (unsigned L = 0; L != MaxLanes; ++L)
      P.Access.Addresses[L] = Base[L] + static_cast<uint32_t>(I->Imm);
  }
  P.LaneMask = S->Mask;
  P.Retired = Retired;
  P.DivergentSplits = S->Count.DivergentSplits;
  const Step What{S->Owner->id(),
                  S->WarpId,
                  S->pcOf(I),
                  I->Word,
                  P.LaneMask,
                  P.Retired,
                  D,
                  P.HasAccess ? &P.Access : nullptr,
                  *S};
  tell([&](Observer &O) { O.fetch(What); });
  // Last: the debugger may have let the warp execute others in between.
  pendingOf(S) = P;
}

void Watch::commit(WarpState *S, const Insn *I) {
  constexpr unsigned SinkOffset = SinkRegister * sizeof(LaneWords);
  const Pending &P = pendingOf(S);
  const Decoded &D = Insns[static_cast<size_t>(I - S->Code)];
  const bool HasResult = I->Rd != SinkOffset;
  const auto Result = [&](bool Has, unsigned Offset) {
    return Has ? std::span<const uint32_t>(S->lanes(Offset), MaxLanes)
               : std::span<const uint32_t>();
  };
  const Commit What{
      {S->Owner->id(), S->WarpId, S->pcOf(I), I->Word, P.LaneMask, P.Retired, D,
       P.HasAccess ? &P.Access : nullptr, *S},
      Result(HasResult, I->Rd),
      Result(HasResult && D.info().Pairs, I->Rd + sizeof(LaneWords)),
      S->Count.DivergentSplits != P.DivergentSplits};
  tell([&](Observer &O) { O.commit(What); });
}

void observeFetch(WarpState *S, const Insn *I, const Insn *Start) {
  // So that an observer finds every warp's place alike.
  S->Next = I;
  S->Watcher->fetch(
      S, I, S->Count.WarpInstructions + static_cast<uint64_t>(I - Start));
}

void observeCommit(WarpState *S, const Insn *I) { S->Watcher->commit(S, I); }

} // namespace vorion::isasim
