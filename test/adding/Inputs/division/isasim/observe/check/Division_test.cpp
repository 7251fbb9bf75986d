#include "testing/CheckedRun.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// Each lane divides by its number plus \p More.
std::vector<uint32_t> divisions(int32_t More) {
  return {encode(Op::RV_CSRRS, {.Rd = 6, .Rs1 = 0, .Csr = CSR_THREAD_ID}),
          encode(Op::RV_ADDI, {.Rd = 6, .Rs1 = 6, .Imm = More}),
          encode(Op::RV_REMU, {.Rd = 7, .Rs1 = 6, .Rs2 = 6})};
}

TEST(DivisionCheck, NamesTheLaneThatDividesByZero) {
  const std::vector<std::string> Reports = reportsOf("division", divisions(-2));
  ASSERT_EQ(Reports.size(), 1U);
  EXPECT_NE(Reports[0].find("check: division: "), std::string::npos);
  EXPECT_NE(Reports[0].find("lane 2,"), std::string::npos);
}

TEST(DivisionCheck, OtherDivisorsAreNoFinding) {
  EXPECT_TRUE(reportsOf("division", divisions(1)).empty());
}

} // namespace
