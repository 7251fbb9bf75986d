/// With AVX2 all guest registers lie in memory. What the vectors for one
/// instruction have of them when it has been done is used by the next ones.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace vorion::isasim::translate {

class HeldVectors {
public:
  static constexpr int Count = 5; ///< those of two registers of the host

  /// The vector that holds \p Register, or -1.
  int find(uint16_t Register) const {
    for (int N = 0; N != Count; ++N)
      if (All[N].Register == Register)
        return N;
    return -1;
  }

  /// What \p N holds.
  std::optional<uint16_t> registerOf(int N) const {
    return All[N].Register == Nothing ? std::nullopt
                                      : std::optional(All[N].Register);
  }

  /// The present instruction has \p N to itself.
  void use(int N) {
    All[N].IsUsed = true;
    All[N].LastUse = ++Time;
  }

  /// The one that nobody wanted for longest, of those that the present
  /// instruction does not use yet, and \p OnlyEmpty of those that hold nothing.
  /// It holds nothing afterwards. -1 if there is none.
  int take(bool OnlyEmpty) {
    int Oldest = -1;
    for (int N = 0; N != Count; ++N)
      if (!All[N].IsUsed && (!OnlyEmpty || All[N].Register == Nothing) &&
          (Oldest < 0 || All[N].LastUse < All[Oldest].LastUse))
        Oldest = N;
    if (Oldest >= 0) {
      All[Oldest].Register = Nothing;
      use(Oldest);
    }
    return Oldest;
  }

  /// \p N, if it is one of these vectors, has what \p Register has in memory.
  void hold(int N, uint16_t Register) {
    if (N < Count)
      All[N].Register = Register;
  }

  void endInstruction() {
    for (One &Each : All)
      Each.IsUsed = false;
  }
  void forget() { All = {}; }
  /// Of those that the present instruction does not use.
  void forgetOthers() {
    for (One &Each : All)
      if (!Each.IsUsed)
        Each.Register = Nothing;
  }

private:
  static constexpr uint16_t Nothing = UINT16_MAX;
  struct One {
    uint16_t Register = Nothing;
    bool IsUsed = false;
    unsigned LastUse = 0;
  };
  std::array<One, Count> All;
  unsigned Time = 0;
};

} // namespace vorion::isasim::translate
