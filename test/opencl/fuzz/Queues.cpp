/// Contexts, queues, and commands that move no data of the program.

#include "Sequence.h"

namespace vorion::test {

void Sequence::newContext() {
  cl_int Status = CL_SUCCESS;
  const cl_context_properties Properties[] = {
      CL_CONTEXT_PLATFORM,
      chance(95) ? cl_context_properties(Platform) : cl_context_properties(0),
      0};
  const cl_context_properties Unknown[] = {0x7777, 1, 0};
  const cl_device_id Devices[] = {Device, chance(95) ? Device : nullptr};
  const cl_context Made = clCreateContext(
      any({Properties, Properties, Properties, Unknown,
           static_cast<const cl_context_properties *>(nullptr)}),
      chance(95) ? 1 : below(3), Devices, nullptr, nullptr, &Status);
  made("clCreateContext", Contexts, Made, Status,
       {CL_INVALID_PLATFORM, CL_INVALID_PROPERTY, CL_INVALID_VALUE,
        CL_INVALID_DEVICE, CL_DEVICE_NOT_AVAILABLE});
}

void Sequence::newQueue() {
  cl_int Status = CL_SUCCESS;
  const cl_command_queue Made =
      clCreateCommandQueue(pick(Contexts), chance(97) ? Device : nullptr,
                           any<cl_command_queue_properties>(
                               {0, 0, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE,
                                CL_QUEUE_PROFILING_ENABLE, 0x4000000}),
                           &Status);
  made("clCreateCommandQueue", Queues, Made, Status,
       {CL_INVALID_CONTEXT, CL_INVALID_DEVICE, CL_INVALID_VALUE,
        CL_INVALID_QUEUE_PROPERTIES});
}

void Sequence::synchronize() {
  const WaitList W = waitList();
  cl_event Event = nullptr;
  const cl_command_queue Q = pick(Queues);
  const std::initializer_list<cl_int> Codes = {
      CL_INVALID_COMMAND_QUEUE, CL_INVALID_CONTEXT, CL_INVALID_EVENT_WAIT_LIST};
  switch (below(6)) {
  case 0:
    enqueued("clEnqueueMarkerWithWaitList",
             clEnqueueMarkerWithWaitList(Q, W.Count, W.List, wanted(Event)),
             Event, Codes);
    break;
  case 1:
    enqueued("clEnqueueBarrierWithWaitList",
             clEnqueueBarrierWithWaitList(Q, W.Count, W.List, wanted(Event)),
             Event, Codes);
    break;
  case 2:
    check("clFlush", clFlush(Q), {CL_INVALID_COMMAND_QUEUE});
    break;
  case 3:
    if (Pending == 0)
      check("clFinish", clFinish(Q), {CL_INVALID_COMMAND_QUEUE});
    break;
  case 4:
    if (Pending == 0)
      check("clWaitForEvents", clWaitForEvents(W.Count, W.List),
            {CL_INVALID_VALUE, CL_INVALID_CONTEXT, CL_INVALID_EVENT,
             CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST});
    break;
  default: {
    const cl_mem Moved[] = {pick(Buffers), pick(Buffers)};
    enqueued("clEnqueueMigrateMemObjects",
             clEnqueueMigrateMemObjects(
                 Q, below(3), chance(97) ? Moved : nullptr,
                 any<cl_mem_migration_flags>(
                     {0, CL_MIGRATE_MEM_OBJECT_HOST,
                      CL_MIGRATE_MEM_OBJECT_CONTENT_UNDEFINED, 1 << 9}),
                 W.Count, W.List, wanted(Event)),
             Event, TransferCodes);
  }
  }
}

} // namespace vorion::test
