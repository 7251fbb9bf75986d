// Pages that nobody touched are known without touching them.
#include "mem/Memory.h"
#include "mem/TouchedPages.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vorion::isasim {
namespace {

constexpr size_t Bytes = size_t{1} << 32;

TEST(TouchedPages, AreThoseThatWereWritten) {
  const auto Page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const auto M = Mapping::make(Bytes);
  ASSERT_TRUE(M) << M.error().What;
  for (const size_t P : {size_t{5}, size_t{6}, Bytes / Page - 1})
    M->data()[P * Page + 3] = std::byte{1};
  // A second look sees the same: the first has touched nothing.
  for (unsigned Look = 0; Look != 2; ++Look) {
    const auto Touched = touchedPages({M->data(), Bytes}, Page);
    ASSERT_EQ(Touched.size(), Bytes / Page);
    EXPECT_EQ(std::ranges::count(Touched, true), 3);
    EXPECT_TRUE(Touched[5] && Touched[6] && Touched.back());
  }
}

TEST(TouchedPages, OfAnotherSizeLieOnThoseOfTheHost) {
  const auto Page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  const auto M = Mapping::make(8 * Page);
  ASSERT_TRUE(M) << M.error().What;
  M->data()[3 * Page] = std::byte{1};
  EXPECT_EQ(touchedPages({M->data(), 8 * Page}, 2 * Page),
            (std::vector{false, true, false, false}));
  EXPECT_EQ(
      touchedPages({M->data(), 4 * Page - 1}, Page / 2),
      (std::vector{false, false, false, false, false, false, true, true}));
}

} // namespace
} // namespace vorion::isasim
