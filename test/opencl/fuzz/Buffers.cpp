/// Buffers, their parts, and what reads, writes and maps them.

#include "Sequence.h"

#include <algorithm>

namespace vorion::test {

void Sequence::newBuffer() {
  cl_int Status = CL_SUCCESS;
  const auto Flags = any<cl_mem_flags>(
      {CL_MEM_READ_WRITE, CL_MEM_READ_WRITE, CL_MEM_READ_ONLY,
       CL_MEM_WRITE_ONLY, CL_MEM_COPY_HOST_PTR, CL_MEM_USE_HOST_PTR,
       CL_MEM_ALLOC_HOST_PTR, CL_MEM_ALLOC_HOST_PTR | CL_MEM_COPY_HOST_PTR,
       CL_MEM_USE_HOST_PTR | CL_MEM_COPY_HOST_PTR,
       CL_MEM_READ_ONLY | CL_MEM_WRITE_ONLY, CL_MEM_HOST_NO_ACCESS,
       CL_MEM_HOST_READ_ONLY, CL_MEM_HOST_WRITE_ONLY, 0, 1 << 30});
  const bool Given =
      (Flags & (CL_MEM_COPY_HOST_PTR | CL_MEM_USE_HOST_PTR)) != 0;
  std::size_t Bytes = chance(90) ? 4 * (1 + below(1024)) : size();
  if (Given && Bytes > 4096) // what the program promises must be there
    Bytes = 4096;
  // Memory that is used in place must outlive the buffer.
  const cl_mem Made =
      clCreateBuffer(pick(Contexts), Flags, Bytes,
                     Given != chance(3) ? Host.data() : nullptr, &Status);
  made("clCreateBuffer", Buffers, Made, Status,
       {CL_INVALID_CONTEXT, CL_INVALID_VALUE, CL_INVALID_BUFFER_SIZE,
        CL_INVALID_HOST_PTR, CL_MEM_OBJECT_ALLOCATION_FAILURE});
}

void Sequence::newSubBuffer() {
  cl_int Status = CL_SUCCESS;
  const cl_buffer_region Region = {chance(80) ? 128 * below(8) : fitting(),
                                   fitting()};
  const cl_mem Made = clCreateSubBuffer(
      pick(Buffers),
      any<cl_mem_flags>({0, 0, CL_MEM_READ_ONLY, CL_MEM_READ_WRITE,
                         CL_MEM_USE_HOST_PTR, 1 << 29}),
      chance(97) ? CL_BUFFER_CREATE_TYPE_REGION : 0,
      chance(97) ? &Region : nullptr, &Status);
  made("clCreateSubBuffer", Buffers, Made, Status,
       {CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE, CL_INVALID_BUFFER_SIZE,
        CL_MISALIGNED_SUB_BUFFER_OFFSET, CL_MEM_OBJECT_ALLOCATION_FAILURE});
}

void Sequence::readOrWrite() {
  const WaitList W = waitList();
  cl_event Event = nullptr;
  const cl_command_queue Q = pick(Queues);
  const cl_mem B = pick(Buffers);
  const std::size_t Offset = fitting();
  const std::size_t Bytes = std::min<std::size_t>(fitting(), 1 << 15);
  void *Pointer = chance(98) ? Host.data() + 1024 : nullptr;
  if (chance(50))
    enqueued("clEnqueueReadBuffer",
             clEnqueueReadBuffer(Q, B, blockingUnless(W), Offset, Bytes,
                                 Pointer, W.Count, W.List, wanted(Event)),
             Event, TransferCodes);
  else
    enqueued("clEnqueueWriteBuffer",
             clEnqueueWriteBuffer(Q, B, blockingUnless(W), Offset, Bytes,
                                  Pointer, W.Count, W.List, wanted(Event)),
             Event, TransferCodes);
}

void Sequence::rectangle() {
  const WaitList W = waitList();
  cl_event Event = nullptr;
  const auto Small = [&] {
    return chance(97) ? std::size_t(below(6)) : SIZE_MAX - below(4);
  };
  const std::size_t From[] = {Small(), Small(), Small()};
  // In the program's memory nobody but the program can know a place as wrong.
  const std::size_t InHost[] = {below(6), below(6), below(6)};
  const std::size_t To[] = {Small(), Small(), Small()};
  const std::size_t Region[] = {Small(), Small(), chance(80) ? 1 : Small()};
  const auto Row = any<std::size_t>({0, 0, 8, 16, 3});
  const auto Slice = any<std::size_t>({0, 0, 64, 48, 7});
  void *Pointer = chance(98) ? Host.data() + 1024 : nullptr;
  const cl_command_queue Q = pick(Queues);
  const cl_mem B = pick(Buffers);
  switch (below(3)) {
  case 0:
    enqueued("clEnqueueReadBufferRect",
             clEnqueueReadBufferRect(Q, B, blockingUnless(W), From, InHost,
                                     Region, Row, Slice, Row, Slice, Pointer,
                                     W.Count, W.List, wanted(Event)),
             Event, TransferCodes);
    break;
  case 1:
    enqueued("clEnqueueWriteBufferRect",
             clEnqueueWriteBufferRect(Q, B, blockingUnless(W), From, InHost,
                                      Region, Row, Slice, Row, Slice, Pointer,
                                      W.Count, W.List, wanted(Event)),
             Event, TransferCodes);
    break;
  default:
    enqueued("clEnqueueCopyBufferRect",
             clEnqueueCopyBufferRect(Q, B, pick(Buffers), From, To, Region, Row,
                                     Slice, Row, Slice, W.Count, W.List,
                                     wanted(Event)),
             Event, TransferCodes);
  }
}

void Sequence::copyOrFill() {
  const WaitList W = waitList();
  cl_event Event = nullptr;
  if (chance(50)) {
    enqueued("clEnqueueCopyBuffer",
             clEnqueueCopyBuffer(pick(Queues), pick(Buffers), pick(Buffers),
                                 fitting(), fitting(), fitting(), W.Count,
                                 W.List, wanted(Event)),
             Event, TransferCodes);
    return;
  }
  const auto Pattern = any<std::size_t>({1, 2, 4, 8, 16, 128, 0, 3, 256});
  enqueued("clEnqueueFillBuffer",
           clEnqueueFillBuffer(pick(Queues), pick(Buffers),
                               chance(97) ? Host.data() : nullptr, Pattern,
                               chance(80) ? Pattern * below(8) : fitting(),
                               chance(80) ? Pattern * below(32) : fitting(),
                               W.Count, W.List, wanted(Event)),
           Event, TransferCodes);
}

void Sequence::map() {
  const WaitList W = waitList();
  cl_event Event = nullptr;
  cl_int Status = CL_SUCCESS;
  const cl_command_queue Q = pick(Queues);
  const cl_mem B = pick(Buffers);
  void *Pointer = clEnqueueMapBuffer(
      Q, B, blockingUnless(W),
      any<cl_map_flags>({CL_MAP_READ, CL_MAP_WRITE, CL_MAP_READ | CL_MAP_WRITE,
                         CL_MAP_WRITE_INVALIDATE_REGION, 0, 1 << 20}),
      fitting(), fitting(), W.Count, W.List, wanted(Event), &Status);
  if ((Status == CL_SUCCESS) != (Pointer != nullptr))
    Wrong = "clEnqueueMapBuffer gave code " + std::to_string(Status) +
            (Pointer ? " with" : " without") + " a pointer";
  if (Pointer)
    Mappings.push_back({Q, B, Pointer});
  enqueued("clEnqueueMapBuffer", Status, Event,
           {CL_INVALID_COMMAND_QUEUE, CL_INVALID_CONTEXT, CL_INVALID_MEM_OBJECT,
            CL_INVALID_VALUE, CL_INVALID_EVENT_WAIT_LIST,
            CL_MISALIGNED_SUB_BUFFER_OFFSET, CL_MAP_FAILURE,
            CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
            CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_INVALID_OPERATION});
}

void Sequence::unmap() {
  // What is not mapped yet must not be unmapped.
  if (Mappings.empty() || Pending > 0)
    return;
  for (const cl_command_queue Q : Queues)
    clFinish(Q);
  const WaitList W = waitList();
  cl_event Event = nullptr;
  const std::size_t I = below(unsigned(Mappings.size()));
  const Mapping M = Mappings[I];
  const cl_int Status = clEnqueueUnmapMemObject(
      chance(95) ? M.Queue : pick(Queues),
      chance(95) ? M.Buffer : pick(Buffers),
      chance(95) ? M.Pointer : Host.data(), W.Count, W.List, wanted(Event));
  if (Status == CL_SUCCESS)
    Mappings.erase(Mappings.begin() + std::ptrdiff_t(I));
  enqueued("clEnqueueUnmapMemObject", Status, Event,
           {CL_INVALID_COMMAND_QUEUE, CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE,
            CL_INVALID_EVENT_WAIT_LIST, CL_INVALID_CONTEXT});
}

} // namespace vorion::test
