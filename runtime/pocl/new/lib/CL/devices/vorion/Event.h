/// What the driver keeps for an OpenCL event.
#pragma once

#include "CommandOrder.h"
#include "vorion.h"

#include <vorion/runtime.h>

#include <optional>
#include <pthread.h>
#include <string>

namespace vorion {

struct EventData {
  pthread_cond_t Finished = PTHREAD_COND_INITIALIZER; ///< with the event's lock
  std::optional<vx_counters> Counters; ///< of a kernel that ran to its end
  std::string TimeReport;              ///< likewise
  double DeviceSeconds = 0;            ///< likewise; 0 without the clock
  CommandWaits Waits;
};

/// Null before the event is queued.
inline EventData *eventData(cl_event Event) {
  return static_cast<EventData *>(Event->data);
}

/// clGetEventInfoVORION of CL/cl_vorion.h.
cl_int CL_API_CALL getEventInfo(cl_event Event, cl_uint Name, size_t Size,
                                void *Value, size_t *SizeRet);

} // namespace vorion
