#include "testing/CheckedRun.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// Each lane loads a word from its number times \p Stride, in global memory.
std::vector<uint32_t> loads(int32_t Stride) {
  return {encode(Op::RV_CSRRS, {.Rd = 6, .Rs1 = 0, .Csr = CSR_THREAD_ID}),
          encode(Op::RV_ADDI, {.Rd = 7, .Rs1 = 0, .Imm = Stride}),
          encode(Op::RV_MUL, {.Rd = 6, .Rs1 = 6, .Rs2 = 7}),
          encode(Op::RV_LUI, {.Rd = 7, .Imm = VX_GLOBAL_BASE >> 12}),
          encode(Op::RV_ADD, {.Rd = 6, .Rs1 = 6, .Rs2 = 7}),
          encode(Op::RV_LW, {.Rd = 8, .Rs1 = 6, .Imm = 0})};
}

TEST(AlignCheck, NamesTheFirstLaneThatIsMisaligned) {
  const std::vector<std::string> Reports = reportsOf("align", loads(2));
  ASSERT_FALSE(Reports.empty());
  EXPECT_NE(Reports[0].find("misaligned load of 4 bytes"), std::string::npos);
  EXPECT_NE(Reports[0].find("lane 1,"), std::string::npos);
}

TEST(AlignCheck, AlignedAccessesAreNoFinding) {
  EXPECT_TRUE(reportsOf("align", loads(4)).empty());
}

} // namespace
