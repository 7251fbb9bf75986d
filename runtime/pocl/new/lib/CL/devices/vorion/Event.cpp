#include "Event.h"

#include <CL/cl_vorion.h>

#include <cstring>
#include <vorion/EventCounters.h>

namespace vorion {

cl_int CL_API_CALL getEventInfo(cl_event Event, cl_uint Name, size_t Size,
                                void *Value, size_t *SizeRet) {
  if (!POCL_IS_OF_KIND(Event, EVENT) ||
      Event->command_type != CL_COMMAND_NDRANGE_KERNEL || !Event->queue ||
      strcmp(Event->queue->device->ops->device_name, "vorion") != 0)
    return CL_INVALID_EVENT;
  uint64_t vx_counters::*Counter = counterNamed(Name);
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

} // namespace vorion
