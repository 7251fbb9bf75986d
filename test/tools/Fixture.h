/// The .npz reference results that others made (data/reference), and how their
/// names and metadata select rules.
#pragma once

#include "io/Npz.h"
#include "reference/Types.h"
#include "vorion/support/Expected.h"

#include <string>

namespace vorion::test {

/// One fixture: inputs, the rules it was made by, and all arrays by name.
struct Fixture {
  std::string Name; ///< of the file, without its ending
  splat::Npz Arrays;
  reference::Gaussians<double> Gaussians; ///< unit quaternions
  reference::Camera<double> Camera;
  /// With the support that `f64_render` and its gradients belong to.
  reference::Options Options;

  bool has(const std::string &Array) const { return Arrays.contains(Array); }
  /// The elements of \p Array; empty if there is none.
  std::vector<double> doubles(const std::string &Array) const;
};

/// Reads \p Path. Files that begin with `inria_` follow INRIA's rules with the
/// square support, others gsplat's with the exact one; `meta` says the rest.
Expected<Fixture> readFixture(const std::string &Path);

} // namespace vorion::test
