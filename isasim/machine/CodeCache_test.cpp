/// Programs that are loaded again find their code again.

#include "machine/CodeCache.h"

#include "testing/ElfBuilder.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

const ExecTable &exec() { return execTable(false); }

/// Word 0x13 is a nop.
std::shared_ptr<const Image> program(uint32_t Last) {
  return codeImage({0x13, Last});
}

TEST(CodeCache, FindsProgramsThatAreLoadedAgain) {
  CodeCache Cache;
  const auto A = program(1), B = program(2);
  const CachedCode *OfA = &Cache.get(A, exec(), false);
  const CachedCode *OfB = &Cache.get(B, exec(), false);
  EXPECT_NE(OfA, OfB);
  EXPECT_EQ(&Cache.get(A, exec(), false), OfA);
  EXPECT_EQ(&Cache.get(B, exec(), false), OfB);
  EXPECT_EQ(&Cache.get(program(1), exec(), false), OfA) << "the same bytes";
}

TEST(CodeCache, KeepsWhatIsExecutedOtherwiseApart) {
  CodeCache Cache;
  const auto A = program(1);
  const CachedCode *Plain = &Cache.get(A, exec(), false);
  const CachedCode *Observed = &Cache.get(A, execTable(true), false);
  EXPECT_NE(Plain, Observed);
  EXPECT_EQ(Observed->Exec, &execTable(true));
  if (Translator::isThere()) {
    const CachedCode *Translated = &Cache.get(A, exec(), true);
    EXPECT_NE(Translated, Plain);
    EXPECT_NE(Translated->Translated, nullptr);
  }
}

TEST(CodeCache, ForgetsWhatWasNotWantedForLongest) {
  CodeCache Cache;
  const auto First = program(1);
  std::weak_ptr<const Image> Forgotten;
  Cache.get(First, exec(), false);
  {
    const auto Third = program(2);
    Forgotten = Third;
    Cache.get(Third, exec(), false);
  }
  const CachedCode *OfFirst = &Cache.get(First, exec(), false);
  for (uint32_t N = 3; N != 34; ++N)
    Cache.get(program(N), exec(), false);
  EXPECT_EQ(&Cache.get(First, exec(), false), OfFirst);
  EXPECT_TRUE(Forgotten.expired());
}

} // namespace
