/// Kernels with one guard removed or one rounding lost, which the catalogue's
/// cases must notice.
#pragma once

#include "vorion/support/Expected.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "picture/Options.h"
#include "render/Backward.h"

namespace vorion::test {

/// Replaces \c Guard, which stands once in kernels/\c File, by \c Instead.
struct KernelEdit {
  std::string_view File, Guard, Instead;
};

struct BrokenKernel {
  std::string_view Name;
  /// The path that notices; both where not given.
  std::optional<splat::Path> Only;
  std::vector<KernelEdit> Edits;
  /// Of the cores, the ways to add up pixels that notice; all where not given.
  std::vector<splat::SimtSums> Sums{};
};

const std::vector<BrokenKernel> &brokenKernels();

/// The one called \p Name, which must exist.
const BrokenKernel &brokenKernel(std::string_view Name);

/// Puts all kernel sources into \p Folder, with the edits of \p B; an error
/// names an edit whose guard does not stand in its file once.
Expected<Success> writeKernels(const std::string &Folder,
                               const BrokenKernel &B);

} // namespace vorion::test
