/// Programs and kernels: made, built, given arguments and started.

#include "Sequence.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace vorion::test {

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

std::vector<unsigned char> binaryOf(cl_program P) {
  std::size_t Bytes = 0;
  if (!P || clGetProgramInfo(P, CL_PROGRAM_BINARY_SIZES, sizeof(Bytes), &Bytes,
                             nullptr) != CL_SUCCESS)
    return {};
  std::vector<unsigned char> Binary(Bytes);
  unsigned char *Pointer = Binary.data();
  if (Bytes == 0 ||
      clGetProgramInfo(P, CL_PROGRAM_BINARIES, sizeof(Pointer),
                       static_cast<void *>(&Pointer), nullptr) != CL_SUCCESS)
    return {};
  return Binary;
}

} // namespace

void Sequence::newProgram() {
  cl_int Status = CL_SUCCESS;
  const cl_context C = pick(Contexts);
  if (chance(75)) {
    const char *Texts[] = {
        Sources[below(unsigned(std::size(Sources)))],
        chance(97) ? Sources[below(unsigned(std::size(Sources)))] : nullptr};
    const std::size_t Lengths[] = {chance(90) ? 0 : std::strlen(Texts[0]), 0};
    const cl_program Made = clCreateProgramWithSource(
        C, chance(97) ? 1 : any<cl_uint>({0, 2}), chance(98) ? Texts : nullptr,
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

void Sequence::build() {
  const cl_program P = pick(Programs);
  const char *Option =
      Options[chance(70) ? below(5) : below(unsigned(std::size(Options)))];
  const cl_uint Count = chance(90) ? 0 : 1;
  const cl_device_id *List = Count != (chance(3) ? 1U : 0U) ? &Device : nullptr;
  switch (below(8)) {
  case 0:
    check("clCompileProgram",
          clCompileProgram(P, Count, List, Option, 0, nullptr, nullptr, nullptr,
                           nullptr),
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

void Sequence::newKernel() {
  cl_int Status = CL_SUCCESS;
  if (chance(10)) {
    std::array<cl_kernel, 4> Made{};
    cl_uint Count = 0;
    Status =
        clCreateKernelsInProgram(pick(Programs), below(5), Made.data(), &Count);
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
                     any({"add", "turn", "fault", "only", "fixed", "helper", "",
                          "nowhere", static_cast<const char *>(nullptr)}),
                     &Status);
  made("clCreateKernel", Kernels, Made, Status,
       {CL_INVALID_PROGRAM, CL_INVALID_PROGRAM_EXECUTABLE,
        CL_INVALID_KERNEL_NAME, CL_INVALID_KERNEL_DEFINITION,
        CL_INVALID_VALUE});
}

void Sequence::setArgument() {
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

void Sequence::start() {
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

bool Sequence::hasRightSum() {
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
  clEnqueueNDRangeKernel(Q, K, 1, nullptr, &Items, &Items, 0, nullptr, nullptr);
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

} // namespace vorion::test
