/// Random scenes with shrinking: what must hold for any scene at all.
#pragma once

#include "Machine.h"

#include <cstdint>

namespace vorion::test {

/// How long and from where.
struct FuzzPlan {
  uint32_t Seed = 1;   ///< of the first group of scenes
  uint32_t Groups = 0; ///< at most so many; 0 for no limit
  double Minutes = 0;  ///< at most so long; 0 for no limit
  std::string RowFile; ///< groups that are known to be good are left out
};

/// A group is ten scenes of one seed. Each scene is rendered with random knobs
/// on both paths and held against the references; its weights and T must add
/// up to 1 over a background of 1; the length of a quaternion, the file's
/// order of different depths and what stands behind everything must not show.
/// Stops at the first scene that fails, shrunk and printed.
Expected<Success> fuzz(const FuzzPlan &P);

} // namespace vorion::test
