/// The kernels with barriers of Groups_test.cpp.
///
/// Each is told to the host a second time, step by step for the whole group;
/// unsigned arithmetic, so that wrapping around is defined.
#pragma once

#include "../WorkGroups.h"

#include <vector>

namespace vorion::test {

constexpr U Rounds = 7; ///< argument k of all kernels

/// Takes (global uint *out, local uint *t, uint k), with a word of \c out and
/// of \c t for each work-item.
struct GroupKernel {
  const char *Name;
  const char *Source; ///< for a program that begins with ItemMacros
  /// What group \p Group of \p Items work-items leaves in its part of \c out.
  Values (*Expected)(U Items, U Group);
};

std::vector<GroupKernel> straightKernels();
std::vector<GroupKernel> kernelsWithConditionals();
std::vector<GroupKernel> kernelsWithLoops();

} // namespace vorion::test
