/// The numeric sanitizer's part in the cores: a double beside every fp32 value
/// in registers and memory.
#pragma once

#include "observe/numerics/ShadowMath.h"
#include "observe/numerics/ShadowMemory.h"
#include "vorion/isasim/MemoryMap.h"

namespace vorion::isasim {

/// When a result is worth a report.
struct NumericLimits {
  double Relative = 1e-3; ///< errors above it are
  unsigned CancelBits = 8;
};

/// Follows each lane of each instruction with the same operation in double on
/// the shadows of its operands. A value without a shadow counts as exact. Bits
/// that are moved unchanged keep their shadow wherever they go: through integer
/// registers, memory, shuffles, atomics, selections by masks; so do changes
/// of the sign bit and of the exponent alone. All else that integer
/// instructions make of a float is exact as it is. Program flow is that of the
/// fp32 values.
class CoreShadow : public Observer {
public:
  CoreShadow(NumericSites &SitesIn, ShadowMemory &MemoryIn,
             const NumericLimits &LimitsIn)
      : Sites(SitesIn), Memory(MemoryIn), Limits(LimitsIn) {}
  void runBegins(const RunStart &R) override;
  /// All registers of a machine of \p Shape that will run \p Program are
  /// without shadows.
  void begin(const Config &Shape, const std::shared_ptr<const Image> &Program);
  void fetch(const Step &S) override;
  void commit(const Commit &C) override;

private:
  /// Shadows of a register, by lane.
  struct Values {
    LaneDoubles Value;
    LaneFloats Error; ///< relative, at most 1
    LaneWords From;
  };
  /// A source register before the instruction executes.
  struct Operand {
    LaneWords Words;
    uint32_t Followed = 0; ///< lanes with a shadow; others say nothing below
    Values Shadow;
    uint32_t DifferingLanes =
        0; ///< lanes whose integer the shadow would have otherwise
    LaneWords ShadowValues;
  };
  struct Warp {
    std::array<uint32_t, 64> Followed{}; ///< lanes; x0 to x31, f0 to f31
    std::array<Values, 64> Shadow{};
    std::array<uint32_t, 32> DifferingLanes{}; ///< likewise of x0 to x31
    std::array<LaneWords, 32> ShadowValues{};
    std::array<Operand, 3> In{};
    bool Waits = false; ///< the operands are those of the present instruction
    uint32_t SplitEnd = 0; ///< where a split's own branch follows it
  };
  struct Outcome;

  Warp &warpOf(const Step &S) {
    return Warps[size_t{S.Core} * WarpsPerCore + S.Warp];
  }
  void take(const Step &S, Warp &W, unsigned N, int Register);
  void setShadow(Warp &W, int Register, uint32_t Lanes, const Values &V);
  void drop(Warp &W, int Register, uint32_t Lanes);

  // Rounded operations.
  void commitFloat(const Commit &C, Warp &W);
  void judge(const Commit &C, Warp &W, const Outcome &Out);
  void judgeLane(const Commit &C, const Warp &W, const Outcome &Out, unsigned L,
                 Values &Result);
  uint32_t worstOrigin(const Commit &C, const Warp &W, const Outcome &Out,
                       unsigned L) const;
  bool usesResidue(const Warp &W, const Outcome &Out, unsigned L) const;
  void judgeNotFinite(const Commit &C, const Warp &W, const Outcome &Out,
                      unsigned L, Values &Result);
  NumericSample sample(const Commit &C, const Warp &W, const Outcome &Out,
                       unsigned Lane) const;

  // Everything else (Moves.cpp).
  void commitSign(const Commit &C, Warp &W);
  void commitMinMax(const Commit &C, Warp &W);
  void commitCompare(const Commit &C, Warp &W);
  void commitToInt(const Commit &C, Warp &W);
  void commitInteger(const Commit &C, Warp &W);
  void commitShuffle(const Commit &C, Warp &W);
  void commitLoad(const Commit &C, Warp &W);
  void commitStore(const Commit &C, Warp &W);
  void commitAtomic(const Commit &C, Warp &W);
  void decide(const Step &S, Warp &W);
  /// The present instruction's integer result is \p ShadowValues in the shadow.
  void setShadowValues(const Commit &C, Warp &W, const LaneWords &ShadowValues,
                       bool IsDecision);
  /// If lane \p L of \p From is off, that has come to where it shows.
  void reach(const Operand &From, unsigned L);
  bool loadLane(const Commit &C, unsigned L, uint32_t Address, Values &To);
  void storeLane(const Commit &C, unsigned L, const Operand &From);

  NumericSites &Sites;
  ShadowMemory &Memory;
  const NumericLimits &Limits;
  std::vector<Warp> Warps;
  unsigned WarpsPerCore = 1;
  AddressRange HighGlobal; ///< of globalRanges()
};

} // namespace vorion::isasim
