/// What objects are asked for.

#include "Sequence.h"

#include <array>

namespace vorion::test {

void Sequence::query() {
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
    check("clGetContextInfo",
          clGetContextInfo(pick(Contexts), 0x1080 + below(6), Bytes, To, Size),
          {CL_INVALID_CONTEXT, CL_INVALID_VALUE});
    break;
  case 3:
    check(
        "clGetCommandQueueInfo",
        clGetCommandQueueInfo(pick(Queues), 0x1090 + below(6), Bytes, To, Size),
        {CL_INVALID_COMMAND_QUEUE, CL_INVALID_VALUE});
    break;
  case 4:
    check(
        "clGetMemObjectInfo",
        clGetMemObjectInfo(pick(Buffers), 0x1100 + below(12), Bytes, To, Size),
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
    check(
        "clGetEventProfilingInfo",
        clGetEventProfilingInfo(pick(Events), 0x1280 + Near % 6, Bytes, To,
                                Size),
        {CL_INVALID_EVENT, CL_INVALID_VALUE, CL_PROFILING_INFO_NOT_AVAILABLE});
  }
}

} // namespace vorion::test
