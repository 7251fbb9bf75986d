/// Checker of uses of memory that nothing was written to.
#pragma once

#include "observe/check/Check.h"
#include "observe/check/ShadowBits.h"

#include <vector>

namespace vorion::isasim {

/// Follows, for each byte of memory and of each lane of each register, whether
/// its value comes from something that was written. Copying and computing with
/// what was not is no finding; deciding (a branch, split or vote), addressing,
/// writing a CSR, an atomic, and storing to a buffer are. One byte of a word
/// that was not written spoils results of the word, except where an and, or or
/// conditional zero with a constant hides it. But a copy of the word is stored
/// as it is, and is a finding only if none of its bytes was written: structures
/// are copied with the bytes between their members.
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
  /// Of a word in each lane: a bit for each lane, by byte, that is known to be
  /// good.
  struct Word {
    std::array<uint32_t, 4> Bytes{};

    static Word wholeIn(uint32_t Lanes) {
      return {{Lanes, Lanes, Lanes, Lanes}};
    }
    /// Lanes in which all bytes are good.
    uint32_t whole() const { return Bytes[0] & Bytes[1] & Bytes[2] & Bytes[3]; }
    void set(uint32_t Lanes, const Word &To) {
      for (size_t N = 0; N != Bytes.size(); ++N)
        Bytes[N] = (Bytes[N] & ~Lanes) | (To.Bytes[N] & Lanes);
    }
  };
  struct Warp {
    std::array<Word, 64> Good{}; ///< x0 to x31, f0 to f31
    Word Result; ///< what the present instruction's result will be
    std::array<uint32_t, 16> StackPointer{}; ///< before it
  };

  uint32_t goodSource(const Step &S, const Warp &W) const;
  uint32_t maskedSource(const Step &S, const Warp &W) const;
  void use(const Step &S, Warp &W, unsigned Register, uint32_t Lanes,
           const char *What);
  void checkUses(const Step &S, Warp &W);
  void checkStore(const Step &S, Warp &W);
  Word load(const Step &S);
  Word resultOfOwn(const Step &S, const Warp &W) const;
  Word resultOf(const Step &S, const Warp &W);
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
