#include "core/Effects.h"
#include "testing/CheckedRun.h"
#include "testing/Instructions.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr unsigned Address = 8, Undefined = 6;

/// x8 becomes the address of local memory, which nothing has written, and x6
/// what is read from there.
std::vector<uint32_t> readOfNothing() {
  std::vector<uint32_t> Words;
  loadConstant(Words, Address, VX_LOCAL_BASE);
  Words.push_back(lw(Undefined, 0, Address));
  return Words;
}

/// What the checker says of \p Word with x6 undefined.
std::string reportOf(uint32_t Word) {
  std::vector<uint32_t> Words = readOfNothing();
  Words.push_back(Word);
  std::string All;
  for (const std::string &Report : reportsOf("uninit", Words))
    All += Report + "\n";
  return All;
}

} // namespace

TEST(UninitCheck, EveryDeclaredUseIsReported) {
  for (unsigned N = 0; N != NumOps; ++N) {
    const Op O = static_cast<Op>(N);
    for (const OperandUse &U : effectsOf(O).Uses) {
      if (U.Which == UsedOperand::None)
        break;
      const bool First = U.Which == UsedOperand::Rs1;
      const std::string Report =
          reportOf(encode(O, {.Rd = 10,
                              .Rs1 = First ? Undefined : Address,
                              .Rs2 = First ? 0U : Undefined,
                              .Csr = CSR_FFLAGS}));
      EXPECT_NE(Report.find(std::string(": ") + U.What +
                            " from uninitialized memory"),
                std::string::npos)
          << InsnTable[N].Mnemonic << ": " << Report;
    }
  }
}

TEST(UninitCheck, VotesAndShufflesDifferInWhatOneUndefinedLaneDoes) {
  for (const Op O : {Op::VX_VOTE_ANY, Op::VX_SHFL_IDX}) {
    std::vector<uint32_t> Words = readOfNothing();
    // Defined in all lanes but lane 0.
    Words.insert(Words.end(),
                 {encode(Op::RV_CSRRS, {.Rd = 5, .Csr = CSR_THREAD_ID}),
                  encode(Op::RV_CZERO_NEZ, {.Rd = 7, .Rs1 = 6, .Rs2 = 5}),
                  encode(O, {.Rd = 7, .Rs1 = 7}), bne(7, 0, 4)});
    EXPECT_EQ(reportsOf("uninit", Words).size(), O == Op::VX_VOTE_ANY ? 1U : 0U)
        << InsnTable[static_cast<unsigned>(O)].Mnemonic;
  }
}
