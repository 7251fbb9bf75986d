/// Checker of uses of memory that nothing was written to.
#pragma once

#include "observe/check/Check.h"
#include "observe/check/ShadowBits.h"

#include <vector>

namespace vorion::isasim {

/// Follows, for each byte of memory and each lane of each register, whether its
/// value comes from something that was written. Copying and computing with what
/// was not is no finding; deciding (a branch, split or vote), addressing,
/// writing a CSR, an atomic, and storing to a buffer are. A word counts as a
/// whole: one byte of it that was not written spoils results of the word,
/// except where an and, or or conditional zero with a constant hides it.
class UninitCheck : public Check {
public:
  UninitCheck(Reporter Out, const Places &Where) : Out(Out), Where(Where) {}

  void allocated(uint32_t Address, uint64_t Bytes,
                 const std::string &) override {
    Global.set(Address, Bytes, false);
  }
  void hostWrote(uint32_t Address, uint64_t Bytes) override {
    Global.set(Address, Bytes, true);
  }

  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void commit(const Commit &C) override;
  void rasterCommand(const raster::CommandWork &W) override;

private:
  struct Warp {
    /// A bit for each lane whose value is known to be good; x0 to x31, f0 to
    /// f31.
    std::array<uint32_t, 64> Good{};
    uint32_t Result = 0; ///< what the present instruction's result will be
    std::array<uint32_t, 16> StackPointer{}; ///< before it
  };

  uint32_t goodSource(const Step &S, const Warp &W) const;
  uint32_t maskedSource(const Step &S, const Warp &W) const;
  void use(const Step &S, Warp &W, unsigned Register, uint32_t Lanes,
           const char *What);
  void checkUses(const Step &S, Warp &W);
  void checkStore(const Step &S, Warp &W);
  uint32_t load(const Step &S);
  ShadowBits *shadowOf(uint32_t Address, const Step &S);
  void moveStack(const Commit &C, Warp &W);

  Reporter Out;
  const Places &Where;
  ShadowBits Global, Stacks;
  std::vector<ShadowBits> Locals; ///< by core
  std::vector<Warp> Warps;
  unsigned WarpsPerCore = 1;
};

} // namespace vorion::isasim
