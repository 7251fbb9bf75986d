#include "scene/UpDirection.h"

#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

using Vector = std::array<double, 3>;

std::optional<Vector> of(const std::string &Comment) {
  return upOfComments(std::array{std::string("made by a test"), Comment});
}

TEST(UpDirection, CommentsNameAnAxisOrAVector) {
  EXPECT_EQ(of("Vertical Axis: z"), (Vector{0, 0, 1}));
  EXPECT_EQ(of("Vertical axis: y"), (Vector{0, -1, 0}));
  EXPECT_EQ(of("vertical axis:+Y"), (Vector{0, 1, 0}));
  EXPECT_EQ(of("Vertical axis: -x"), (Vector{-1, 0, 0}));
  EXPECT_EQ(of("Vertical axis: z (x east, metres)"), (Vector{0, 0, 1}));
  EXPECT_EQ(of("Vertical axis: 0 2 0"), (Vector{0, 1, 0}));
  EXPECT_EQ(of("Vertical axis: [0, 0, -1]"), (Vector{0, 0, -1}));
  for (const char *Other :
       {"Vertical axis:", "Vertical axis: up", "Vertical axis: 0 0 0",
        "Vertical axis: 1 nan 0", "vertical lines are straight"})
    EXPECT_EQ(of(Other), std::nullopt) << Other;
}

TEST(UpDirection, AxesStateIt) {
  EXPECT_EQ(upOfAxes("rub"), (Vector{0, 1, 0}));
  EXPECT_EQ(upOfAxes("rdf"), (Vector{0, -1, 0}));
  EXPECT_EQ(upOfAxes(""), std::nullopt);
}

} // namespace
