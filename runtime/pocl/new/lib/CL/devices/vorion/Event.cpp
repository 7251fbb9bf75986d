#include "Event.h"

#include <CL/cl_vorion.h>

#include <cstring>

using namespace vorion;

namespace {

/// Null for a name that is not ours.
uint64_t vx_counters::*counterNamed(cl_uint Name) {
  switch (Name) {
  case CL_EVENT_WARP_INSTRUCTIONS_VORION:
    return &vx_counters::warp_instructions;
  case CL_EVENT_LANE_INSTRUCTIONS_VORION:
    return &vx_counters::lane_instructions;
  case CL_EVENT_RASTER_COMMANDS_VORION:
    return &vx_counters::raster_commands;
  case CL_EVENT_RASTER_GAUSSIANS_VORION:
    return &vx_counters::raster_gaussians;
  case CL_EVENT_RASTER_CLIPPED_VORION:
    return &vx_counters::raster_clipped;
  case CL_EVENT_RASTER_FRAGMENTS_VORION:
    return &vx_counters::raster_fragments;
  case CL_EVENT_RASTER_BLENDS_VORION:
    return &vx_counters::raster_blends;
  case CL_EVENT_RASTER_INTERSECTING_VORION:
    return &vx_counters::raster_intersecting;
  case CL_EVENT_RASTER_TAILS_VORION:
    return &vx_counters::raster_tails;
  case CL_EVENT_RASTER_TAIL_PIXELS_VORION:
    return &vx_counters::raster_tail_pixels;
  case CL_EVENT_RASTER_TAIL_VISITS_VORION:
    return &vx_counters::raster_tail_visits;
  case CL_EVENT_RASTER_TAIL_BLENDS_VORION:
    return &vx_counters::raster_tail_blends;
  default:
    return nullptr;
  }
}

} // namespace

cl_int CL_API_CALL pocl_vorion_get_event_info(cl_event Event, cl_uint Name,
                                              size_t Size, void *Value,
                                              size_t *SizeRet) {
  if (!IS_CL_OBJECT_VALID(Event) ||
      Event->command_type != CL_COMMAND_NDRANGE_KERNEL || !Event->queue ||
      strcmp(Event->queue->device->ops->device_name, "vorion") != 0)
    return CL_INVALID_EVENT;
  auto Counter = counterNamed(Name);
  if ((!Counter && Name != CL_EVENT_TIME_REPORT_VORION) ||
      (Counter && Value && Size < sizeof(cl_ulong)))
    return CL_INVALID_VALUE;

  POCL_LOCK_OBJ(Event);
  const EventData *Data = eventData(Event);
  cl_int Status = CL_PROFILING_INFO_NOT_AVAILABLE;
  if (Event->status == CL_COMPLETE && Data && Data->Counters.has_value()) {
    const cl_ulong Count = Counter ? (*Data->Counters).*Counter : 0;
    const void *From =
        Counter ? static_cast<const void *>(&Count) : Data->TimeReport.c_str();
    const size_t Bytes = Counter ? sizeof(Count) : Data->TimeReport.size() + 1;
    Status = Value && Size < Bytes ? CL_INVALID_VALUE : CL_SUCCESS;
    if (Status == CL_SUCCESS && Value)
      memcpy(Value, From, Bytes);
    if (Status == CL_SUCCESS && SizeRet)
      *SizeRet = Bytes;
  }
  POCL_UNLOCK_OBJ(Event);
  return Status;
}
