#include "accuracy/Thumbnail.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

constexpr std::string_view Begin = "data:image/png;base64,iVBORw0KGgo";

TEST(Thumbnail, IsAPngInText) {
  ExactImage I{40, 20, std::vector<double>(40 * 20 * 3, 0.25), {}};
  for (const unsigned Width : {7U, 40U, 100U}) {
    const auto Uri = thumbnail(I, Width);
    ASSERT_TRUE(Uri);
    EXPECT_TRUE(Uri->starts_with(Begin));
    EXPECT_EQ((Uri->size() - 22) % 4, 0U);
  }
}

TEST(Thumbnail, ADifferenceShows) {
  const ExactImage A{8, 8, std::vector<double>(8 * 8 * 3, 0.5), {}};
  ExactImage B = A;
  const auto Same = differenceThumbnail(A, A, 4);
  B.Render[100] = 0.6;
  const auto Other = differenceThumbnail(A, B, 4);
  ASSERT_TRUE(Same && Other);
  EXPECT_NE(*Same, *Other);
}

} // namespace
