/// Comparing a decoded scene with what was encoded, within bounds that follow
/// from the format.
#pragma once

#include "scene/Activation.h"
#include "scene/SceneWriter.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vorion::splat::testing {

/// differenceOf() of scenes that must have the same size and degree.
inline SceneDifference differencesOf(const Scene &A, const Scene &B) {
  EXPECT_EQ(A.size(), B.size());
  EXPECT_EQ(A.ShDegree, B.ShDegree);
  if (A.size() != B.size() || A.ShDegree != B.ShDegree)
    return {};
  return differenceOf(A, B);
}

} // namespace vorion::splat::testing
