/// Reading a scene and comparing it with what was encoded, within bounds that
/// follow from the format.
#pragma once

#include "scene/Activation.h"
#include "scene/SceneFile.h"
#include "scene/SceneWriter.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vorion::splat::testing {

/// The scene that \p Content holds, which must be read as of \p Format.
inline SceneFile parsedAs(SceneFormat Format, const std::string &Content) {
  auto Read = parseScene("s", std::as_bytes(std::span(Content)));
  EXPECT_TRUE(Read) << Read.error().Where << Read.error().What;
  if (!Read)
    return {};
  EXPECT_EQ(Read->Format, Format);
  return std::move(*Read);
}

/// differenceOf() of scenes that must have the same size and degree.
inline SceneDifference differencesOf(const Scene &A, const Scene &B) {
  EXPECT_EQ(A.size(), B.size());
  EXPECT_EQ(A.ShDegree, B.ShDegree);
  if (A.size() != B.size() || A.ShDegree != B.ShDegree)
    return {};
  return differenceOf(A, B);
}

} // namespace vorion::splat::testing
