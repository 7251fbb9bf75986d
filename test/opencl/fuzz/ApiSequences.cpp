/// Random sequences of OpenCL calls, valid and invalid, each in a process of
/// its own: no crash, no hang, and no code that the standard does not list for
/// the function. After each sequence a kernel must still run.
///
/// Handles that were released are used again, too. The standard leaves that
/// undefined; here the code must be one that it lists for a wrong handle.

#include "Watched.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <random>
#include <string>
#include <tuple>
#include <vector>

using namespace vorion::test;

namespace {

constexpr const char *Sources[] = {
    "kernel void add(global int *p, int x) { p[get_global_id(0)] += x; }\n"
    "kernel void turn(global const int *p, global int *q, local int *t) {\n"
    "  size_t l = get_local_id(0);\n  t[l] = p[get_global_id(0)];\n"
    "  barrier(CLK_LOCAL_MEM_FENCE);\n"
    "  q[get_global_id(0)] = t[get_local_size(0) - 1 - l];\n}\n",
    "kernel void fault(global int *p) { *(global int *)8 = 1; }\n"
    "kernel void only(void) { barrier(CLK_LOCAL_MEM_FENCE); }\n",
    "__attribute__((reqd_work_group_size(4, 2, 1)))\n"
    "kernel void fixed(global float *p, float4 v, constant float *c) {\n"
    "  p[get_global_id(0)] = v.y + c[0];\n}\n",
    "kernel void broken(global int *p) { p[0] = nowhere; }\n",
    "int helper(int x) { return x + 1; }\n",
    "",
    "not even C"};
constexpr const char *Options[] = {nullptr,
                                   "",
                                   "-cl-opt-disable",
                                   "-DX=1 -w",
                                   "-Werror -g",
                                   "-cl-std=CL1.2",
                                   "-cl-std=CL3.0",
                                   "-cl-nothing",
                                   "-D",
                                   "-I",
                                   "-I ",
                                   "-x",
                                   "-x spir",
                                   "\"",
                                   "-create-library",
                                   "-cl-denorms-are-zero",
                                   "nonsense"};

/// One sequence.
class Sequence {
public:
  explicit Sequence(uint64_t Seed) : Random(Seed) {}

  /// What went wrong, or nothing.
  std::string run(unsigned Calls) {
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

private:
  // --- chance

  unsigned below(unsigned N) { return static_cast<unsigned>(Random() % N); }
  bool chance(unsigned Percent) { return below(100) < Percent; }
  template <typename T> T any(std::initializer_list<T> Of) {
    return *(Of.begin() + below(static_cast<unsigned>(Of.size())));
  }
  /// One of \p From, seldom (or where there is none) a null handle or one that
  /// was released.
  template <typename T> T pick(const std::vector<T> &From) {
    const std::vector<T> &Gone = std::get<std::vector<T>>(Released);
    if (!Gone.empty() && chance(From.empty() ? 50 : 3))
      return Gone[below(unsigned(Gone.size()))];
    return From.empty() || chance(3) ? T() : From[below(unsigned(From.size()))];
  }
  std::size_t size() {
    return any<std::size_t>({0, 1, 3, 4, 16, 64, 100, 128, 256, 1000, 4096,
                             std::size_t(below(5000)), SIZE_MAX, SIZE_MAX - 3,
                             std::size_t(1) << 31, std::size_t(1) << 33});
  }
  std::size_t fitting() { return chance(85) ? 4 * below(64) : size(); }
  cl_bool blocking() { return chance(50) ? CL_TRUE : CL_FALSE; }

  // --- results

  /// \p Status is a code that \p Function may give: one of \p Allowed or of
  /// those that every function may.
  bool check(const char *Function, cl_int Status,
             std::initializer_list<cl_int> Allowed) {
    if (Status == CL_SUCCESS)
      return true;
    if (Status != CL_OUT_OF_RESOURCES && Status != CL_OUT_OF_HOST_MEMORY &&
        std::find(Allowed.begin(), Allowed.end(), Status) == Allowed.end())
      Wrong = std::string(Function) + " gave " + std::to_string(Status) +
              ", which the standard does not list for it";
    return false;
  }
  template <typename T>
  void made(const char *Function, std::vector<T> &Into, T Made, cl_int Status,
            std::initializer_list<cl_int> Allowed) {
    const bool Good = check(Function, Status, Allowed);
    if (Good != (Made != nullptr))
      Wrong = std::string(Function) + " gave code " + std::to_string(Status) +
              (Made ? " with" : " without") + " an object";
    if (Made)
      Into.push_back(Made);
  }

  /// A wait list of a few events for one call.
  struct WaitList {
    std::vector<cl_event> Events;
    cl_uint Count = 0;
    const cl_event *List = nullptr;
  };
  WaitList waitList() {
    WaitList W;
    if (!Events.empty() && chance(40))
      for (unsigned I = below(3) + 1; I > 0; --I)
        W.Events.push_back(pick(Events));
    W.Count = cl_uint(W.Events.size());
    if (chance(2))
      W.Count = W.Events.empty() ? 1 : 0;
    W.List = W.Events.empty() ? nullptr : W.Events.data();
    // A blocking call would wait for a user event that nobody sets.
    return W;
  }
  cl_bool blockingUnless(const WaitList &W) {
    return W.List || Pending > 0 ? CL_FALSE : blocking();
  }
  void enqueued(const char *Function, cl_int Status, cl_event Event,
                std::initializer_list<cl_int> Allowed) {
    if (check(Function, Status, Allowed) && Event)
      Events.push_back(Event);
  }
  cl_event *wanted(cl_event &Event) { return chance(60) ? &Event : nullptr; }

#define VORION_TRANSFER_CODES                                                  \
  {CL_INVALID_COMMAND_QUEUE,                                                   \
   CL_INVALID_CONTEXT,                                                         \
   CL_INVALID_MEM_OBJECT,                                                      \
   CL_INVALID_VALUE,                                                           \
   CL_INVALID_EVENT_WAIT_LIST,                                                 \
   CL_MISALIGNED_SUB_BUFFER_OFFSET,                                            \
   CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,                               \
   CL_MEM_OBJECT_ALLOCATION_FAILURE,                                           \
   CL_MEM_COPY_OVERLAP,                                                        \
   CL_INVALID_OPERATION}

  // --- calls

  void newContext() {
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

  void newQueue() {
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

  void newBuffer() {
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

  void newSubBuffer() {
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

  void readOrWrite() {
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
               Event, VORION_TRANSFER_CODES);
    else
      enqueued("clEnqueueWriteBuffer",
               clEnqueueWriteBuffer(Q, B, blockingUnless(W), Offset, Bytes,
                                    Pointer, W.Count, W.List, wanted(Event)),
               Event, VORION_TRANSFER_CODES);
  }

  void rectangle() {
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
               Event, VORION_TRANSFER_CODES);
      break;
    case 1:
      enqueued("clEnqueueWriteBufferRect",
               clEnqueueWriteBufferRect(Q, B, blockingUnless(W), From, InHost,
                                        Region, Row, Slice, Row, Slice, Pointer,
                                        W.Count, W.List, wanted(Event)),
               Event, VORION_TRANSFER_CODES);
      break;
    default:
      enqueued("clEnqueueCopyBufferRect",
               clEnqueueCopyBufferRect(Q, B, pick(Buffers), From, To, Region,
                                       Row, Slice, Row, Slice, W.Count, W.List,
                                       wanted(Event)),
               Event, VORION_TRANSFER_CODES);
    }
  }

  void copyOrFill() {
    const WaitList W = waitList();
    cl_event Event = nullptr;
    if (chance(50)) {
      enqueued("clEnqueueCopyBuffer",
               clEnqueueCopyBuffer(pick(Queues), pick(Buffers), pick(Buffers),
                                   fitting(), fitting(), fitting(), W.Count,
                                   W.List, wanted(Event)),
               Event, VORION_TRANSFER_CODES);
      return;
    }
    const auto Pattern = any<std::size_t>({1, 2, 4, 8, 16, 128, 0, 3, 256});
    enqueued("clEnqueueFillBuffer",
             clEnqueueFillBuffer(pick(Queues), pick(Buffers),
                                 chance(97) ? Host.data() : nullptr, Pattern,
                                 chance(80) ? Pattern * below(8) : fitting(),
                                 chance(80) ? Pattern * below(32) : fitting(),
                                 W.Count, W.List, wanted(Event)),
             Event, VORION_TRANSFER_CODES);
  }

  struct Mapping {
    cl_command_queue Queue;
    cl_mem Buffer;
    void *Pointer;
  };
  void map() {
    const WaitList W = waitList();
    cl_event Event = nullptr;
    cl_int Status = CL_SUCCESS;
    const cl_command_queue Q = pick(Queues);
    const cl_mem B = pick(Buffers);
    void *Pointer = clEnqueueMapBuffer(
        Q, B, blockingUnless(W),
        any<cl_map_flags>({CL_MAP_READ, CL_MAP_WRITE,
                           CL_MAP_READ | CL_MAP_WRITE,
                           CL_MAP_WRITE_INVALIDATE_REGION, 0, 1 << 20}),
        fitting(), fitting(), W.Count, W.List, wanted(Event), &Status);
    if ((Status == CL_SUCCESS) != (Pointer != nullptr))
      Wrong = "clEnqueueMapBuffer gave code " + std::to_string(Status) +
              (Pointer ? " with" : " without") + " a pointer";
    if (Pointer)
      Mappings.push_back({Q, B, Pointer});
    enqueued("clEnqueueMapBuffer", Status, Event,
             {CL_INVALID_COMMAND_QUEUE, CL_INVALID_CONTEXT,
              CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE,
              CL_INVALID_EVENT_WAIT_LIST, CL_MISALIGNED_SUB_BUFFER_OFFSET,
              CL_MAP_FAILURE, CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST,
              CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_INVALID_OPERATION});
  }
  void unmap() {
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

  void newProgram() {
    cl_int Status = CL_SUCCESS;
    const cl_context C = pick(Contexts);
    if (chance(75)) {
      const char *Texts[] = {
          Sources[below(unsigned(std::size(Sources)))],
          chance(97) ? Sources[below(unsigned(std::size(Sources)))] : nullptr};
      const std::size_t Lengths[] = {chance(90) ? 0 : std::strlen(Texts[0]), 0};
      const cl_program Made =
          clCreateProgramWithSource(C, chance(97) ? 1 : any<cl_uint>({0, 2}),
                                    chance(98) ? Texts : nullptr,
                                    chance(50) ? Lengths : nullptr, &Status);
      made("clCreateProgramWithSource", Programs, Made, Status,
           {CL_INVALID_CONTEXT, CL_INVALID_VALUE});
      return;
    }
    std::vector<unsigned char> Binary = binaryOf(pick(Programs));
    if (Binary.empty())
      return;
    if (chance(60))
      for (unsigned I = below(4) + 1; I > 0; --I)
        Binary[below(unsigned(Binary.size()))] ^= 1U << below(8);
    if (chance(20))
      Binary.resize(below(unsigned(Binary.size())) + 1);
    const unsigned char *Pointer = Binary.data();
    const std::size_t Bytes = Binary.size();
    cl_int Each = CL_SUCCESS;
    const cl_program Made = clCreateProgramWithBinary(
        C, chance(97) ? 1 : 0, chance(97) ? &Device : nullptr, &Bytes, &Pointer,
        chance(50) ? &Each : nullptr, &Status);
    made("clCreateProgramWithBinary", Programs, Made, Status,
         {CL_INVALID_CONTEXT, CL_INVALID_VALUE, CL_INVALID_DEVICE,
          CL_INVALID_BINARY});
  }
  static std::vector<unsigned char> binaryOf(cl_program P) {
    std::size_t Bytes = 0;
    if (!P || clGetProgramInfo(P, CL_PROGRAM_BINARY_SIZES, sizeof(Bytes),
                               &Bytes, nullptr) != CL_SUCCESS)
      return {};
    std::vector<unsigned char> Binary(Bytes);
    unsigned char *Pointer = Binary.data();
    if (Bytes == 0 ||
        clGetProgramInfo(P, CL_PROGRAM_BINARIES, sizeof(Pointer),
                         static_cast<void *>(&Pointer), nullptr) != CL_SUCCESS)
      return {};
    return Binary;
  }

  void build() {
    const cl_program P = pick(Programs);
    const char *Option =
        Options[chance(70) ? below(5) : below(unsigned(std::size(Options)))];
    const cl_uint Count = chance(90) ? 0 : 1;
    const cl_device_id *List =
        Count != (chance(3) ? 1U : 0U) ? &Device : nullptr;
    switch (below(8)) {
    case 0:
      check("clCompileProgram",
            clCompileProgram(P, Count, List, Option, 0, nullptr, nullptr,
                             nullptr, nullptr),
            {CL_INVALID_PROGRAM, CL_INVALID_VALUE, CL_INVALID_DEVICE,
             CL_INVALID_COMPILER_OPTIONS, CL_INVALID_OPERATION,
             CL_COMPILER_NOT_AVAILABLE, CL_COMPILE_PROGRAM_FAILURE});
      break;
    case 1: {
      cl_int Status = CL_SUCCESS;
      const cl_program Inputs[] = {P, pick(Programs)};
      const cl_program Made = clLinkProgram(
          pick(Contexts), Count, List,
          chance(70) ? nullptr : Options[below(unsigned(std::size(Options)))],
          chance(95) ? 1 + below(2) : 0, Inputs, nullptr, nullptr, &Status);
      // An unsuccessful link may give a program, for its log.
      if (Made)
        Programs.push_back(Made);
      check("clLinkProgram", Status,
            {CL_INVALID_CONTEXT, CL_INVALID_VALUE, CL_INVALID_PROGRAM,
             CL_INVALID_DEVICE, CL_INVALID_LINKER_OPTIONS, CL_INVALID_OPERATION,
             CL_LINKER_NOT_AVAILABLE, CL_LINK_PROGRAM_FAILURE});
      break;
    }
    default:
      check("clBuildProgram",
            clBuildProgram(P, Count, List, Option, nullptr, nullptr),
            {CL_INVALID_PROGRAM, CL_INVALID_VALUE, CL_INVALID_DEVICE,
             CL_INVALID_BINARY, CL_INVALID_BUILD_OPTIONS, CL_INVALID_OPERATION,
             CL_COMPILER_NOT_AVAILABLE, CL_BUILD_PROGRAM_FAILURE});
    }
  }

  void newKernel() {
    cl_int Status = CL_SUCCESS;
    if (chance(10)) {
      std::array<cl_kernel, 4> Made{};
      cl_uint Count = 0;
      Status = clCreateKernelsInProgram(pick(Programs), below(5), Made.data(),
                                        &Count);
      if (check("clCreateKernelsInProgram", Status,
                {CL_INVALID_PROGRAM, CL_INVALID_PROGRAM_EXECUTABLE,
                 CL_INVALID_VALUE}))
        for (const cl_kernel K : Made)
          if (K)
            Kernels.push_back(K);
      return;
    }
    const cl_kernel Made =
        clCreateKernel(pick(Programs),
                       any({"add", "turn", "fault", "only", "fixed", "helper",
                            "", "nowhere", static_cast<const char *>(nullptr)}),
                       &Status);
    made("clCreateKernel", Kernels, Made, Status,
         {CL_INVALID_PROGRAM, CL_INVALID_PROGRAM_EXECUTABLE,
          CL_INVALID_KERNEL_NAME, CL_INVALID_KERNEL_DEFINITION,
          CL_INVALID_VALUE});
  }

  void setArgument() {
    const cl_mem B = pick(Buffers);
    const cl_uint Index = chance(95) ? below(3) : below(100000);
    const cl_kernel K = pick(Kernels);
    cl_int Status = CL_SUCCESS;
    switch (below(4)) {
    case 0:
      Status = clSetKernelArg(K, Index, any<std::size_t>({4, 16, 1, 8, 0}),
                              Host.data());
      break;
    case 1: // local memory, sometimes more than there is
      Status = clSetKernelArg(
          K, Index,
          any<std::size_t>({64, 1024, 1 << 20, 0, std::size_t(1) << 33}),
          nullptr);
      break;
    default:
      Status =
          clSetKernelArg(K, Index, sizeof(cl_mem),
                         chance(97) ? static_cast<const void *>(&B) : nullptr);
    }
    check("clSetKernelArg", Status,
          {CL_INVALID_KERNEL, CL_INVALID_ARG_INDEX, CL_INVALID_ARG_VALUE,
           CL_INVALID_MEM_OBJECT, CL_INVALID_SAMPLER, CL_INVALID_ARG_SIZE});
  }

  void start() {
    const WaitList W = waitList();
    cl_event Event = nullptr;
    const auto Extent = [&] {
      return chance(95) ? any<std::size_t>({1, 4, 8, 16, 32, 64, 17}) : size();
    };
    const std::size_t Global[] = {Extent(), chance(80) ? 1 : Extent(),
                                  chance(80) ? 1 : Extent()};
    std::size_t Local[] = {1, 1, 1};
    for (int D = 0; D < 3; ++D)
      Local[D] = chance(70) && Global[D] % 4 == 0 ? 4 : Extent();
    const std::size_t Offset[] = {chance(95) ? 0 : size(), 0, 0};
    // So large a grid would run for ever.
    for (const std::size_t Items : Global)
      if (Items > 5000 && Items < (std::size_t(1) << 40))
        return;
    enqueued("clEnqueueNDRangeKernel",
             clEnqueueNDRangeKernel(
                 pick(Queues), pick(Kernels), chance(95) ? 1 : below(5),
                 chance(30) ? Offset : nullptr, chance(98) ? Global : nullptr,
                 chance(70) ? Local : nullptr, W.Count, W.List, wanted(Event)),
             Event,
             {CL_INVALID_PROGRAM_EXECUTABLE, CL_INVALID_COMMAND_QUEUE,
              CL_INVALID_KERNEL, CL_INVALID_CONTEXT, CL_INVALID_KERNEL_ARGS,
              CL_INVALID_WORK_DIMENSION, CL_INVALID_GLOBAL_WORK_SIZE,
              CL_INVALID_GLOBAL_OFFSET, CL_INVALID_WORK_GROUP_SIZE,
              CL_INVALID_WORK_ITEM_SIZE, CL_MISALIGNED_SUB_BUFFER_OFFSET,
              CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_INVALID_EVENT_WAIT_LIST});
  }

  void synchronize() {
    const WaitList W = waitList();
    cl_event Event = nullptr;
    const cl_command_queue Q = pick(Queues);
    const std::initializer_list<cl_int> Codes = {CL_INVALID_COMMAND_QUEUE,
                                                 CL_INVALID_CONTEXT,
                                                 CL_INVALID_EVENT_WAIT_LIST};
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
               Event, VORION_TRANSFER_CODES);
    }
    }
  }

  void userEvent() {
    cl_int Status = CL_SUCCESS;
    if (Unset.empty() || chance(40)) {
      const cl_event Made = clCreateUserEvent(pick(Contexts), &Status);
      if (check("clCreateUserEvent", Status, {CL_INVALID_CONTEXT}) && Made) {
        Events.push_back(Made);
        Unset.push_back(Made);
        ++Pending;
      }
      return;
    }
    const std::size_t I = below(unsigned(Unset.size()));
    const cl_int Value = any<cl_int>({CL_COMPLETE, CL_COMPLETE, -1, -5000, 1});
    Status = clSetUserEventStatus(Unset[I], Value);
    check("clSetUserEventStatus", Status,
          {CL_INVALID_EVENT, CL_INVALID_VALUE, CL_INVALID_OPERATION});
    if (Status == CL_SUCCESS) {
      Unset.erase(Unset.begin() + std::ptrdiff_t(I));
      --Pending;
    }
    const cl_event Other = pick(Events);
    if (chance(10) && std::ranges::find(Unset, Other) == Unset.end())
      check("clSetUserEventStatus", clSetUserEventStatus(Other, CL_COMPLETE),
            {CL_INVALID_EVENT, CL_INVALID_VALUE, CL_INVALID_OPERATION});
  }

  static void CL_CALLBACK nothing(cl_event /*E*/, cl_int /*S*/, void * /*D*/) {}
  static void CL_CALLBACK gone(cl_mem /*Buffer*/, void * /*Data*/) {}
  void callback() {
    if (chance(70))
      check("clSetEventCallback",
            clSetEventCallback(pick(Events),
                               any<cl_int>({CL_COMPLETE, CL_RUNNING,
                                            CL_SUBMITTED, CL_QUEUED, -1}),
                               chance(95) ? nothing : nullptr, nullptr),
            {CL_INVALID_EVENT, CL_INVALID_VALUE});
    else
      check("clSetMemObjectDestructorCallback",
            clSetMemObjectDestructorCallback(
                pick(Buffers), chance(95) ? gone : nullptr, nullptr),
            {CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE});
  }

  void query() {
    std::array<unsigned char, 4096> Value{};
    std::size_t Got = 0;
    const auto Bytes = any<std::size_t>({0, 1, 4, 8, 16, 4096, 4096, 4096});
    void *To = chance(90) ? Value.data() : nullptr;
    std::size_t *Size = chance(80) ? &Got : nullptr;
    const cl_uint Near = below(24);
    const cl_kernel K = pick(Kernels);
    switch (below(12)) {
    case 0:
      check("clGetDeviceInfo",
            clGetDeviceInfo(chance(97) ? Device : nullptr, 0x1000 + below(0x70),
                            Bytes, To, Size),
            {CL_INVALID_DEVICE, CL_INVALID_VALUE});
      break;
    case 1:
      check("clGetPlatformInfo",
            clGetPlatformInfo(Platform, 0x0900 + below(8), Bytes, To, Size),
            {CL_INVALID_PLATFORM, CL_INVALID_VALUE});
      break;
    case 2:
      check(
          "clGetContextInfo",
          clGetContextInfo(pick(Contexts), 0x1080 + below(6), Bytes, To, Size),
          {CL_INVALID_CONTEXT, CL_INVALID_VALUE});
      break;
    case 3:
      check("clGetCommandQueueInfo",
            clGetCommandQueueInfo(pick(Queues), 0x1090 + below(6), Bytes, To,
                                  Size),
            {CL_INVALID_COMMAND_QUEUE, CL_INVALID_VALUE});
      break;
    case 4:
      check("clGetMemObjectInfo",
            clGetMemObjectInfo(pick(Buffers), 0x1100 + below(12), Bytes, To,
                               Size),
            {CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE});
      break;
    case 5: {
      // Sizes and binaries are asked for with room for one device alone.
      const cl_program P = pick(Programs);
      const cl_uint Name = 0x1160 + below(12);
      if (Name != CL_PROGRAM_BINARIES)
        check("clGetProgramInfo", clGetProgramInfo(P, Name, Bytes, To, Size),
              {CL_INVALID_PROGRAM, CL_INVALID_VALUE,
               CL_INVALID_PROGRAM_EXECUTABLE});
      break;
    }
    case 6:
      check("clGetProgramBuildInfo",
            clGetProgramBuildInfo(pick(Programs), chance(97) ? Device : nullptr,
                                  0x1180 + below(8), Bytes, To, Size),
            {CL_INVALID_PROGRAM, CL_INVALID_VALUE, CL_INVALID_DEVICE});
      break;
    case 7:
      check("clGetKernelInfo",
            clGetKernelInfo(K, 0x1190 + below(8), Bytes, To, Size),
            {CL_INVALID_KERNEL, CL_INVALID_VALUE});
      break;
    case 8:
      check("clGetKernelArgInfo",
            clGetKernelArgInfo(K, below(4), 0x1195 + below(8), Bytes, To, Size),
            {CL_INVALID_KERNEL, CL_INVALID_VALUE, CL_INVALID_ARG_INDEX,
             CL_KERNEL_ARG_INFO_NOT_AVAILABLE});
      break;
    case 9:
      check("clGetKernelWorkGroupInfo",
            clGetKernelWorkGroupInfo(K, chance(80) ? Device : nullptr,
                                     0x11B0 + below(8), Bytes, To, Size),
            {CL_INVALID_KERNEL, CL_INVALID_VALUE, CL_INVALID_DEVICE});
      break;
    case 10:
      check("clGetEventInfo",
            clGetEventInfo(pick(Events), 0x11D0 + Near % 6, Bytes, To, Size),
            {CL_INVALID_EVENT, CL_INVALID_VALUE});
      break;
    default:
      check("clGetEventProfilingInfo",
            clGetEventProfilingInfo(pick(Events), 0x1280 + Near % 6, Bytes, To,
                                    Size),
            {CL_INVALID_EVENT, CL_INVALID_VALUE,
             CL_PROFILING_INFO_NOT_AVAILABLE});
    }
  }

  template <typename T>
  void drop(const char *Function, std::vector<T> &From, cl_int (*Release)(T),
            cl_int Code) {
    if (From.empty())
      return;
    const std::size_t I = below(unsigned(From.size()));
    const T Object = From[I];
    From.erase(From.begin() + std::ptrdiff_t(I));
    check(Function, Release(Object), {Code});
    std::get<std::vector<T>>(Released).push_back(Object);
  }
  void release() {
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

  void call() {
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

  /// Sets what is open, waits for everything, releases it, and runs a kernel.
  void finish() {
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
  bool hasRightSum() {
    cl_int S = CL_SUCCESS;
    const cl_context C =
        clCreateContext(nullptr, 1, &Device, nullptr, nullptr, &S);
    const cl_command_queue Q = clCreateCommandQueue(C, Device, 0, &S);
    std::array<cl_int, 16> Data{};
    const cl_mem B =
        clCreateBuffer(C, CL_MEM_COPY_HOST_PTR, sizeof(Data), Data.data(), &S);
    const char *Text = Sources[0];
    const cl_program P = clCreateProgramWithSource(C, 1, &Text, nullptr, &S);
    clBuildProgram(P, 0, nullptr, nullptr, nullptr, nullptr);
    const cl_kernel K = clCreateKernel(P, "add", &S);
    const cl_int Addend = 5;
    const std::size_t Items = Data.size();
    clSetKernelArg(K, 0, sizeof(cl_mem), static_cast<const void *>(&B));
    clSetKernelArg(K, 1, sizeof(Addend), &Addend);
    clEnqueueNDRangeKernel(Q, K, 1, nullptr, &Items, &Items, 0, nullptr,
                           nullptr);
    S = clEnqueueReadBuffer(Q, B, CL_TRUE, 0, sizeof(Data), Data.data(), 0,
                            nullptr, nullptr);
    clReleaseKernel(K);
    clReleaseProgram(P);
    clReleaseMemObject(B);
    clReleaseCommandQueue(Q);
    clReleaseContext(C);
    return S == CL_SUCCESS &&
           std::ranges::all_of(Data, [](cl_int V) { return V == 5; });
  }

  std::mt19937_64 Random;
  cl_platform_id Platform = nullptr;
  cl_device_id Device = nullptr;
  std::vector<unsigned char> Host;
  std::vector<cl_context> Contexts;
  std::vector<cl_command_queue> Queues;
  std::vector<cl_mem> Buffers;
  std::vector<cl_program> Programs;
  std::vector<cl_kernel> Kernels;
  std::vector<cl_event> Events, Unset;
  std::tuple<std::vector<cl_context>, std::vector<cl_command_queue>,
             std::vector<cl_mem>, std::vector<cl_program>,
             std::vector<cl_kernel>, std::vector<cl_event>>
      Released;
  std::vector<Mapping> Mappings;
  unsigned Pending = 0; ///< user events that are open
  std::string Wrong;
};

} // namespace

int main(int Argc, char **Argv) {
  return runWatched(Argc, Argv, "opencl_api_sequences",
                    [](uint64_t Seed) { return Sequence(Seed).run(120); });
}
