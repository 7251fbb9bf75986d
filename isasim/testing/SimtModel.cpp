#include "testing/SimtModel.h"

#include <algorithm>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// rd of each active lane becomes F(lane); sources are read before.
void eachLane(SimtModel &M, unsigned Rd,
              const std::function<uint32_t(unsigned)> &F) {
  std::array<uint32_t, MaxLanes> Results{};
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (M.active(L))
      Results[L] = F(L);
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (M.active(L) && Rd != 0)
      M.X[Rd][L] = Results[L];
}

Step vote(
    const std::function<uint32_t(const std::vector<uint32_t> &)> &Result) {
  return [Result](SimtModel &M, Operands O) {
    std::vector<uint32_t> Values;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (M.active(L))
        Values.push_back(M.X[O.Rs1][L]);
    const uint32_t All = Result(Values);
    eachLane(M, O.Rd, [&](unsigned) { return All; });
  };
}

/// From gives the source lane, or nothing where it lies outside the segment.
Step shuffle(const std::function<std::optional<int>(
                 int Lane, int B, int Lo, int Hi, int Segment)> &From) {
  return [From](SimtModel &M, Operands O) {
    eachLane(M, O.Rd, [&](unsigned L) {
      const uint32_t Control = M.X[O.Rs2][L];
      const int Lane = static_cast<int>(L);
      const int B = Control & 63, C = Control >> 6 & 63,
                Segment = Control >> 12 & 63;
      const int Lo = Lane & Segment, Hi = Lo | (C & ~Segment);
      const std::optional<int> Source = From(Lane, B, Lo, Hi, Segment);
      const bool Takes = Source && *Source >= 0 &&
                         *Source < static_cast<int>(MaxLanes) &&
                         M.active(static_cast<unsigned>(*Source));
      return M.X[O.Rs1][Takes ? static_cast<unsigned>(*Source) : L];
    });
  };
}

Step split(bool Negated) {
  return [Negated](SimtModel &M, Operands O) {
    uint32_t Then = 0, Else = 0;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (M.active(L))
        ((M.X[O.Rs1][L] & 1) != Negated ? Then : Else) |= 1U << L;
    const auto Depth = static_cast<uint32_t>(M.Stack.size());
    const bool Divergent = Then && Else;
    if (Divergent && Depth == SimtModel::StackLimit)
      return M.trap(TrapCause::DivergenceOverflow, M.first());
    eachLane(M, O.Rd, [&](unsigned) { return Depth; });
    if (!Divergent)
      return;
    M.Stack.push_back({M.Mask, Else, M.Pc + 1});
    M.Mask = Then;
  };
}

void join(SimtModel &M, Operands O) {
  if (M.X[O.Rs1][M.last()] == M.Stack.size())
    return;
  if (M.Stack.empty())
    return M.trap(TrapCause::DivergenceUnderflow, M.first());
  SimtModel::StackEntry &Top = M.Stack.back();
  if (Top.Other != 0) {
    M.Mask = Top.Other;
    Top.Other = 0;
    M.Pc = Top.Pc - 1; // one is added to it
    return;
  }
  M.Mask = Top.Mask;
  M.Stack.pop_back();
}

Step pred(bool Negated) {
  return [Negated](SimtModel &M, Operands O) {
    uint32_t Mask = 0;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (M.active(L) && (M.X[O.Rs1][L] & 1) != Negated)
        Mask |= 1U << L;
    if (Mask == 0)
      Mask = M.X[O.Rs2][M.last()] & 0xFFFF;
    if (Mask == 0)
      return M.trap(TrapCause::EmptyMask, M.first());
    M.Mask = Mask;
  };
}

void barrier(SimtModel &M, Operands O) {
  const uint32_t Id = M.X[O.Rs1][M.last()], Count = M.X[O.Rs2][M.last()];
  if (M.Mask != M.Whole)
    return M.trap(TrapCause::DivergentBarrier, M.last());
  if ((Id & 0x7FFFFFFF) >= SimtModel::NumBarriers)
    return M.trap(TrapCause::BadBarrier, M.last());
  if (Count > 1)
    M.Why = Id >> 31 ? Stop::GlobalBarrier : Stop::LocalBarrier;
}

/// Read, modify and write, one lane after the other.
Step amo(const std::function<uint32_t(uint32_t Old, uint32_t Operand,
                                      uint32_t Rd)> &New) {
  return [New](SimtModel &M, Operands O) {
    std::array<uint32_t, MaxLanes> Olds{};
    for (unsigned L = 0; L != MaxLanes; ++L) {
      if (!M.active(L))
        continue;
      const uint32_t Address = M.X[O.Rs1][L];
      if (Address % 4 != 0)
        return M.trap(TrapCause::MisalignedStore, L);
      const unsigned N = SimtModel::wordAt(Address);
      if (N == SimtModel::Words)
        return M.trap(TrapCause::StoreFault, L);
      Olds[L] = M.Memory[N];
      M.Memory[N] = New(Olds[L], M.X[O.Rs2][L], M.X[O.Rd][L]);
    }
    eachLane(M, O.Rd, [&](unsigned L) { return Olds[L]; });
  };
}

/// amocas.d: registers of two words, of which x0 is none.
void swapPair(SimtModel &M, Operands O) {
  std::array<std::array<uint32_t, MaxLanes>, 2> Olds{};
  const auto Word = [&](unsigned Register, unsigned Half, unsigned L) {
    return Register == 0 ? 0 : M.X[Register + Half][L];
  };
  for (unsigned L = 0; L != MaxLanes; ++L) {
    if (!M.active(L))
      continue;
    const uint32_t Address = M.X[O.Rs1][L];
    if (Address % 8 != 0)
      return M.trap(TrapCause::MisalignedStore, L);
    const unsigned N = SimtModel::wordAt(Address);
    if (N == SimtModel::Words)
      return M.trap(TrapCause::StoreFault, L);
    bool Same = true;
    for (unsigned Half = 0; Half != 2; ++Half) {
      Olds[Half][L] = M.Memory[N + Half];
      Same &= Olds[Half][L] == Word(O.Rd, Half, L);
    }
    for (unsigned Half = 0; Same && Half != 2; ++Half)
      M.Memory[N + Half] = Word(O.Rs2, Half, L);
  }
  for (unsigned Half = 0; O.Rd != 0 && Half != 2; ++Half)
    eachLane(M, O.Rd + Half, [&](unsigned L) { return Olds[Half][L]; });
}

int32_t s(uint32_t V) { return static_cast<int32_t>(V); }

} // namespace

const std::map<Op, Step> &vorion::isasim::testing::simtSteps() {
  using Values = const std::vector<uint32_t> &;
  static const std::map<Op, Step> Table = {
      {Op::VX_TMC,
       [](SimtModel &M, Operands O) {
         M.Mask = M.Whole = M.X[O.Rs1][M.last()] & 0xFFFF;
         if (M.Mask == 0)
           M.Why = Stop::Ended;
       }},
      // A machine of one warp has none to start.
      {Op::VX_WSPAWN, [](SimtModel &, Operands) {}},
      {Op::VX_SPLIT, split(false)},
      {Op::VX_SPLIT_N, split(true)},
      {Op::VX_JOIN, join},
      {Op::VX_BAR, barrier},
      {Op::VX_PRED, pred(false)},
      {Op::VX_PRED_N, pred(true)},
      {Op::VX_VOTE_ALL,
       vote([](Values V) { return std::ranges::count(V, 0U) == 0 ? 1U : 0U; })},
      {Op::VX_VOTE_ANY, vote([](Values V) {
         return std::ranges::count(V, 0U) != std::ssize(V) ? 1U : 0U;
       })},
      {Op::VX_VOTE_UNI, vote([](Values V) {
         return std::ranges::count(V, V[0]) == std::ssize(V) ? 1U : 0U;
       })},
      {Op::VX_VOTE_BALLOT,
       [](SimtModel &M, Operands O) {
         uint32_t Ballot = 0;
         for (unsigned L = 0; L != MaxLanes; ++L)
           if (M.active(L) && M.X[O.Rs1][L] != 0)
             Ballot |= 1U << L;
         eachLane(M, O.Rd, [&](unsigned) { return Ballot; });
       }},
      {Op::VX_SHFL_UP, shuffle([](int Lane, int B, int Lo, int, int) {
         return Lane - B >= Lo ? std::optional(Lane - B) : std::nullopt;
       })},
      {Op::VX_SHFL_DOWN, shuffle([](int Lane, int B, int, int Hi, int) {
         return Lane + B <= Hi ? std::optional(Lane + B) : std::nullopt;
       })},
      {Op::VX_SHFL_BFLY, shuffle([](int Lane, int B, int, int Hi, int) {
         return (Lane ^ B) <= Hi ? std::optional(Lane ^ B) : std::nullopt;
       })},
      {Op::VX_SHFL_IDX, shuffle([](int, int B, int Lo, int Hi, int Segment) {
         const int From = Lo | (B & ~Segment);
         return From <= Hi ? std::optional(From) : std::nullopt;
       })},
      {Op::RV_CZERO_EQZ,
       [](SimtModel &M, Operands O) {
         eachLane(M, O.Rd, [&](unsigned L) {
           return M.X[O.Rs2][L] == 0 ? 0 : M.X[O.Rs1][L];
         });
       }},
      {Op::RV_CZERO_NEZ,
       [](SimtModel &M, Operands O) {
         eachLane(M, O.Rd, [&](unsigned L) {
           return M.X[O.Rs2][L] != 0 ? 0 : M.X[O.Rs1][L];
         });
       }},
      {Op::RV_AMOADD_W, amo([](auto Old, auto V, auto) { return Old + V; })},
      {Op::RV_AMOSWAP_W, amo([](auto, auto V, auto) { return V; })},
      {Op::RV_AMOXOR_W, amo([](auto Old, auto V, auto) { return Old ^ V; })},
      {Op::RV_AMOAND_W, amo([](auto Old, auto V, auto) { return Old & V; })},
      {Op::RV_AMOOR_W, amo([](auto Old, auto V, auto) { return Old | V; })},
      {Op::RV_AMOMIN_W,
       amo([](auto Old, auto V, auto) { return s(V) < s(Old) ? V : Old; })},
      {Op::RV_AMOMAX_W,
       amo([](auto Old, auto V, auto) { return s(V) > s(Old) ? V : Old; })},
      {Op::RV_AMOMINU_W,
       amo([](auto Old, auto V, auto) { return V < Old ? V : Old; })},
      {Op::RV_AMOMAXU_W,
       amo([](auto Old, auto V, auto) { return V > Old ? V : Old; })},
      {Op::RV_AMOCAS_W,
       amo([](auto Old, auto V, auto Rd) { return Old == Rd ? V : Old; })},
      {Op::RV_AMOCAS_D, swapPair},
  };
  return Table;
}
