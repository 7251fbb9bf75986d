/// Every instruction does what its record declares of effects (intrinsics/
/// Effects.td), found by executing it on random operands.

#include "core/Effects.h"
#include "testing/Operations.h"
#include "testing/WarpRunner.h"

#include <gtest/gtest.h>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr unsigned Tries = 60, Own = 9;

/// One instruction, whose operands in lane Own and whose own-lane activity stay
/// while those of the other lanes change.
class Executed {
public:
  explicit Executed(Op OIn)
      : O(OIn),
        R(execTable(true),
          {encode(
              OIn,
              {.Rd = 5, .Rs1 = 6, .Rs2 = 7, .Rs3 = 8, .Imm = 12, .Rm = 0})}) {}

  /// The result of lane Own. \p Seed chooses its operands, \p Others those of
  /// the other lanes, which are its own half of the time, and which of them are
  /// active.
  uint32_t run(unsigned Seed, unsigned Others) {
    R.reset();
    std::mt19937 OwnValues(Seed), OtherValues(Others + 1);
    const bool Alike = Others % 2;
    for (unsigned N = 5; N != 9; ++N) {
      Lanes16 V = all(value(OwnValues));
      for (unsigned L = 0; L != MaxLanes; ++L)
        if (!Alike && L != Own)
          V[L] = value(OtherValues);
      R.setX(N, V);
      R.setF(N, V);
    }
    Before = (static_cast<uint32_t>(OtherValues()) & 0xFFFF) | 1U << Own;
    R.setActive(Before);
    R.run();
    const bool IsFloat = InsnTable[static_cast<unsigned>(O)].Rd == File::F;
    return IsFloat ? R.getF(5)[Own] : R.getX(5)[Own];
  }
  bool changedMask() {
    return R.warp().Mask != Before || R.warp().StackDepth != 0;
  }
  bool ranToEnd() { return R.ranToEnd(); }

private:
  /// Small numbers, so that shuffles and votes find something, or any word.
  static uint32_t value(std::mt19937 &Random) {
    return static_cast<uint32_t>(Random() % 2 ? Random() : Random() % 3);
  }

  Op O;
  WarpRunner R;
  uint32_t Before = 0;
};

/// Whether the result of a lane is another one with other operands in the other
/// lanes.
bool readsOtherLanes(Op O) {
  Executed E(O);
  for (unsigned Try = 0; Try != Tries; ++Try)
    if (E.run(Try / 4, 2 * Try) != E.run(Try / 4, 2 * Try + 1))
      return true;
  return false;
}

bool changesMask(Op O) {
  Executed E(O);
  for (unsigned Try = 0; Try != Tries; ++Try) {
    E.run(Try, Try);
    if (E.changedMask())
      return true;
  }
  return false;
}

} // namespace

TEST(Effects, ReadingOtherLanesIsDeclared) {
  for (const Op O : computations())
    EXPECT_EQ(readsOtherLanes(O), effectsOf(O).ReadsLanes)
        << InsnTable[static_cast<unsigned>(O)].Mnemonic;
}

TEST(Effects, ChangingTheMaskIsDeclared) {
  for (const Op O :
       opsOf({EffectClass::LaneWise, EffectClass::Vote, EffectClass::Shuffle,
              EffectClass::Split, EffectClass::Predicate, EffectClass::SetMask,
              EffectClass::Fence}))
    EXPECT_EQ(changesMask(O), effectsOf(O).ChangesMask)
        << InsnTable[static_cast<unsigned>(O)].Mnemonic;
}

TEST(Effects, ComputationsNeitherTrapNorJump) {
  for (const Op O : computations()) {
    Executed E(O);
    E.run(1, 2);
    EXPECT_TRUE(E.ranToEnd()) << InsnTable[static_cast<unsigned>(O)].Mnemonic;
  }
}

// The lists of meanings and the classes of effects name the same instructions.
TEST(Effects, ListsOfMeaningsAgree) {
  const std::vector<Op> Shuffles = {
#define SHUFFLE(OP, SOURCE, VALID) Op::OP,
#include "core/insns/shuffle.def"
  };
  EXPECT_EQ(Shuffles, opsOf({EffectClass::Shuffle}));
  const std::vector<Op> Branches = {
#define BRANCH(OP, CONDITION) Op::OP,
#include "core/insns/branch.def"
  };
  EXPECT_EQ(Branches, opsOf({EffectClass::Branch}));
  std::vector<Op> Accesses = {
#define LOAD(OP, T) Op::OP,
#define STORE(OP, T) Op::OP,
#define AMO(OP, KIND) Op::OP,
#include "core/insns/memory.def"
  };
  std::ranges::sort(Accesses);
  EXPECT_EQ(Accesses, accesses());
}
