#include "Sequence.h"

#include <algorithm>
#include <utility>

namespace vorion::test {

std::string Sequence::run(unsigned Calls) {
  if (clGetPlatformIDs(1, &Platform, nullptr) != CL_SUCCESS ||
      clGetDeviceIDs(Platform, CL_DEVICE_TYPE_ALL, 1, &Device, nullptr) !=
          CL_SUCCESS)
    return "no device";
  Host.resize(1 << 16);
  newContext();
  newQueue();
  for (unsigned I = 0; I < Calls && Wrong.empty(); ++I)
    call();
  finish();
  return Wrong;
}

bool Sequence::check(const char *Function, cl_int Status,
                     std::initializer_list<cl_int> Allowed) {
  if (Status == CL_SUCCESS)
    return true;
  if (Status != CL_OUT_OF_RESOURCES && Status != CL_OUT_OF_HOST_MEMORY &&
      std::find(Allowed.begin(), Allowed.end(), Status) == Allowed.end())
    Wrong = std::string(Function) + " gave " + std::to_string(Status) +
            ", which the standard does not list for it";
  return false;
}

cl_bool Sequence::blockingUnless(const WaitList &W) {
  return W.List || Pending > 0 ? CL_FALSE : blocking();
}

void Sequence::enqueued(const char *Function, cl_int Status, cl_event Event,
                        std::initializer_list<cl_int> Allowed) {
  if (check(Function, Status, Allowed) && Event)
    Events.push_back(Event);
}

void Sequence::release() {
  // While a user event is open, releasing other objects is undefined.
  if (Pending > 0)
    return;
  switch (below(4)) {
  case 0:
    if (Mappings.empty())
      drop("clReleaseMemObject", Buffers, clReleaseMemObject,
           CL_INVALID_MEM_OBJECT);
    break;
  case 1:
    drop("clReleaseKernel", Kernels, clReleaseKernel, CL_INVALID_KERNEL);
    break;
  case 2:
    drop("clReleaseProgram", Programs, clReleaseProgram, CL_INVALID_PROGRAM);
    break;
  default:
    drop("clReleaseEvent", Events, clReleaseEvent, CL_INVALID_EVENT);
  }
}

void Sequence::call() {
  using Call = void (Sequence::*)();
  static constexpr std::pair<Call, unsigned> Calls[] = {
      {&Sequence::newContext, 1},   {&Sequence::newQueue, 2},
      {&Sequence::newBuffer, 8},    {&Sequence::newSubBuffer, 4},
      {&Sequence::readOrWrite, 12}, {&Sequence::rectangle, 8},
      {&Sequence::copyOrFill, 10},  {&Sequence::map, 5},
      {&Sequence::unmap, 5},        {&Sequence::newProgram, 4},
      {&Sequence::build, 4},        {&Sequence::newKernel, 6},
      {&Sequence::setArgument, 14}, {&Sequence::start, 10},
      {&Sequence::synchronize, 8},  {&Sequence::userEvent, 3},
      {&Sequence::callback, 3},     {&Sequence::query, 12},
      {&Sequence::release, 4}};
  unsigned All = 0;
  for (const auto &[Function, Weight] : Calls)
    All += Weight;
  unsigned Chosen = below(All);
  for (const auto &[Function, Weight] : Calls) {
    if (Chosen < Weight) {
      (this->*Function)();
      return;
    }
    Chosen -= Weight;
  }
}

void Sequence::finish() {
  for (const cl_event E : Unset)
    clSetUserEventStatus(E, CL_COMPLETE);
  Pending = 0;
  for (const cl_command_queue Q : Queues)
    clFinish(Q);
  for (const cl_event E : Events) {
    cl_int Status = CL_QUEUED;
    clGetEventInfo(E, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof(Status),
                   &Status, nullptr);
    if (Status > CL_COMPLETE && Wrong.empty())
      Wrong = "an event has not ended after clFinish";
    clReleaseEvent(E);
  }
  for (const cl_kernel K : Kernels)
    clReleaseKernel(K);
  for (const cl_program P : Programs)
    clReleaseProgram(P);
  for (const cl_mem B : Buffers)
    clReleaseMemObject(B);
  for (const cl_command_queue Q : Queues)
    clReleaseCommandQueue(Q);
  for (const cl_context C : Contexts)
    clReleaseContext(C);
  if (Wrong.empty() && !hasRightSum())
    Wrong = "afterwards a kernel does not run";
}

} // namespace vorion::test
