#include "RangeParts.h"

namespace vorion {

namespace {

bool isUniform(const _cl_command_run &Run, unsigned Dimension) {
  return Run.last_local_size[Dimension] == Run.pc.local_size[Dimension];
}

/// \p Parts, each divided where the last group along \p Dimension begins.
std::vector<RangePart> divide(const std::vector<RangePart> &Parts,
                              const _cl_command_run &Run, unsigned Dimension) {
  std::vector<RangePart> Divided;
  for (RangePart Part : Parts) {
    const size_t Full = Part.NumGroups[Dimension] - 1;
    Part.NumGroups[Dimension] = Full;
    if (Full)
      Divided.push_back(Part);
    Part.NumGroups[Dimension] = 1;
    Part.LocalSize[Dimension] = Run.last_local_size[Dimension];
    Part.GroupsBefore[Dimension] = Full;
    Divided.push_back(Part);
  }
  return Divided;
}

} // namespace

std::vector<RangePart> partsOf(const _cl_command_run &Run) {
  std::vector<RangePart> Parts = {
      {std::to_array(Run.pc.num_groups), std::to_array(Run.pc.local_size), {}}};
  for (unsigned I = 0; I < 3; ++I)
    if (!isUniform(Run, I))
      Parts = divide(Parts, Run, I);
  return Parts;
}

PartGuard::PartGuard(_cl_command_run &Run, const RangePart &Part)
    : Run(Run), Whole(Run.pc) {
  for (unsigned I = 0; I < 3; ++I) {
    Run.is_range_part |= !isUniform(Run, I);
    Range.enqueued_size[I] = Whole.local_size[I];
    Range.groups_before[I] = Part.GroupsBefore[I];
    Range.all_groups[I] = Whole.num_groups[I];
    Range.global_size[I] = (Whole.num_groups[I] - 1) * Whole.local_size[I] +
                           Run.last_local_size[I];
  }
  for (unsigned I = 0; I < 3; ++I) {
    Run.pc.num_groups[I] = Part.NumGroups[I];
    Run.pc.local_size[I] = Part.LocalSize[I];
    Run.pc.global_offset[I] += Part.GroupsBefore[I] * Whole.local_size[I];
  }
}

PartGuard::~PartGuard() {
  Run.pc = Whole;
  Run.is_range_part = 0;
}

} // namespace vorion
