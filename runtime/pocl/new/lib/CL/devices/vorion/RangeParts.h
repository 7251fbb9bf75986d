/// A range whose last groups are smaller than the others, as launches with
/// groups of one size.
#pragma once

#include "vorion.h"

#include <vorion/runtime.h>

#include <array>
#include <vector>

namespace vorion {

/// Groups of one size, in each dimension.
struct RangePart {
  std::array<size_t, 3> NumGroups, LocalSize, GroupsBefore;
};

/// The parts of a command's range, of which there is one if all groups have one
/// size.
std::vector<RangePart> partsOf(const _cl_command_run &Run);

/// Makes a command of its whole range one of a part of it, until destroyed.
class PartGuard {
public:
  PartGuard(_cl_command_run &Run, const RangePart &Part);
  ~PartGuard();
  PartGuard(const PartGuard &) = delete;
  PartGuard &operator=(const PartGuard &) = delete;

  /// For vx_launch_params; null if the part is all.
  const vx_whole_range *whole() const {
    return Run.is_range_part ? &Range : nullptr;
  }

private:
  _cl_command_run &Run;
  const pocl_context Whole;
  vx_whole_range Range{};
};

} // namespace vorion
