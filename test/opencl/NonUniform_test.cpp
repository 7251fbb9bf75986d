/// Ranges whose last groups are smaller than the others.

#include "TestDevice.h"

#include <algorithm>
#include <array>
#include <cstdint>

using vorion::test::TestDevice;

namespace {

// Of OpenCL 3.0, which the header names to programs for it only.
constexpr cl_device_info NonUniformSupport = 0x1065;

class NonUniform : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  cl::Kernel kernel(const char *Source, const char *Name,
                    const char *Options = "-cl-std=CL3.0") const {
    const cl::Program Program = Device.build(Source, Options);
    return {Program, Name};
  }

  const TestDevice Device;
};

constexpr const char *Ids = R"(
kernel void ids(global uint *out) {
  global uint *o = out + 21 * get_global_linear_id();
  for (uint d = 0; d < 3; ++d) {
    *o++ = get_global_id(d);
    *o++ = get_local_id(d);
    *o++ = get_group_id(d);
    *o++ = get_local_size(d);
    *o++ = get_enqueued_local_size(d);
    *o++ = get_num_groups(d);
    *o++ = get_global_size(d) + 1000 * get_global_offset(d);
  }
})";

using Sizes = std::array<std::size_t, 3>;

/// What the kernel says of one dimension.
std::array<uint32_t, 7> expected(std::size_t At, std::size_t Global,
                                 std::size_t Local, std::size_t Offset) {
  const std::size_t Group = At / Local, Groups = (Global + Local - 1) / Local;
  const std::size_t Own = std::min(Local, Global - Group * Local);
  std::array<uint32_t, 7> Words{};
  std::ranges::transform(
      std::array{At + Offset, At % Local, Group, Own, Local, Groups,
                 Global + 1000 * Offset},
      Words.begin(), [](std::size_t N) { return static_cast<uint32_t>(N); });
  return Words;
}

TEST_F(NonUniform, WorkItemsKnowTheirPlaceInTheWholeRange) {
  cl::Kernel Kernel = kernel(Ids, "ids");
  struct Range {
    Sizes Global, Local, Offset;
  };
  for (const auto &[Global, Local, Offset] :
       {Range{{10, 1, 1}, {4, 1, 1}, {0, 0, 0}},
        Range{{5, 1, 1}, {8, 1, 1}, {3, 0, 0}},
        Range{{8, 7, 1}, {4, 3, 1}, {0, 2, 0}},
        Range{{35, 3, 5}, {16, 2, 3}, {1, 0, 4}}}) {
    const std::size_t Items = Global[0] * Global[1] * Global[2];
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                         21 * Items * sizeof(uint32_t));
    Kernel.setArg(0, Out);
    ASSERT_EQ(Device.queue().enqueueNDRangeKernel(
                  Kernel, cl::NDRange(Offset[0], Offset[1], Offset[2]),
                  cl::NDRange(Global[0], Global[1], Global[2]),
                  cl::NDRange(Local[0], Local[1], Local[2])),
              CL_SUCCESS);
    std::vector<uint32_t> Wanted;
    for (std::size_t Z = 0; Z < Global[2]; ++Z)
      for (std::size_t Y = 0; Y < Global[1]; ++Y)
        for (std::size_t X = 0; X < Global[0]; ++X)
          for (std::size_t D = 0; D < 3; ++D)
            for (const uint32_t Word : expected(std::array{X, Y, Z}[D],
                                                Global[D], Local[D], Offset[D]))
              Wanted.push_back(Word);
    EXPECT_EQ(Device.download<uint32_t>(Out, 21 * Items), Wanted)
        << Global[0] << " of " << Local[0];
  }
}

TEST_F(NonUniform, DimensionsThatNoRangeHasAreOfSizeOne) {
  cl::Kernel Kernel = kernel(R"(
uint places(uint d) {
  return get_global_size(d) + 10 * get_local_size(d) +
         100 * get_enqueued_local_size(d) + 1000 * get_num_groups(d) +
         10000 * (get_global_id(d) + get_local_id(d) + get_group_id(d) +
                  get_global_offset(d));
}
kernel void ask(global uint *out, uint d) {
  out[get_global_id(0)] = places(d) + 100000 * places(3);
})",
                             "ask");
  for (const std::size_t Global : {8, 10})
    for (const cl_uint Dimension : {3U, 4U, ~0U}) {
      const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                           (Global + 1) * sizeof(uint32_t));
      Kernel.setArg(0, Out);
      Kernel.setArg(1, Dimension);
      ASSERT_EQ(Device.queue().enqueueNDRangeKernel(Kernel, cl::NDRange(1),
                                                    cl::NDRange(Global),
                                                    cl::NDRange(4)),
                CL_SUCCESS);
      std::vector<uint32_t> Values = Device.download<uint32_t>(Out, Global + 1);
      Values.erase(Values.begin());
      EXPECT_EQ(Values, std::vector<uint32_t>(Global, 111101111))
          << Global << " in dimension " << Dimension;
    }
}

TEST_F(NonUniform, SmallerGroupsMeetAndReduceByThemselves) {
  cl::Kernel Kernel = kernel(R"(
kernel void meet(global uint *out, local uint *given) {
  local uint own[100];
  uint l = get_local_id(0), n = get_local_size(0);
  own[l] = given[l] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint seen = own[n - 1 - l] + given[n - 1 - l];
  if (get_group_id(0) + 1 == get_num_groups(0)) {
    barrier(CLK_LOCAL_MEM_FENCE);
    own[l] = 7;
    barrier(CLK_LOCAL_MEM_FENCE);
    seen += own[n - 1 - l] * 1000;
  }
  out[get_global_id(0)] = seen + 10000 * work_group_reduce_add(1) +
                          1000000 * get_num_sub_groups() +
                          10000000 * get_enqueued_num_sub_groups() +
                          100000000 * (get_max_sub_group_size() == 16);
})",
                             "meet");
  constexpr uint32_t Local = 40, Global = 98;
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                       Global * sizeof(uint32_t));
  Kernel.setArg(0, Out);
  Kernel.setArg(1, cl::Local(Local * sizeof(uint32_t)));
  Device.run(Kernel, Global, Local);
  std::vector<uint32_t> Wanted;
  for (uint32_t I = 0; I < Global; ++I) {
    const bool Last = I >= 80;
    const uint32_t Own = Last ? 18 : 40;
    Wanted.push_back(2 * (Own - 1 - I % Local) + (Last ? 7000 : 0) +
                     10000 * Own + 1000000 * (Last ? 2 : 3) + 130000000);
  }
  EXPECT_EQ(Device.download<uint32_t>(Out, Global), Wanted);
}

TEST_F(NonUniform, TheSourcesGroupSizeMayNotDivideTheRange) {
  cl::Kernel Kernel = kernel("kernel __attribute__((reqd_work_group_size(8, 1, "
                             "1))) void own(global uint *out) {\n"
                             "  out[get_global_id(0)] = get_local_size(0);\n"
                             "}\n",
                             "own");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                       11 * sizeof(uint32_t));
  Kernel.setArg(0, Out);
  ASSERT_EQ(Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange,
                                                cl::NDRange(11)),
            CL_SUCCESS);
  EXPECT_EQ(Device.download<uint32_t>(Out, 11),
            (std::vector<uint32_t>{8, 8, 8, 8, 8, 8, 8, 8, 3, 3, 3}));
}

TEST_F(NonUniform, ProgramsCanHaveOneSizeOnly) {
  cl_bool Support = CL_FALSE;
  EXPECT_EQ(clGetDeviceInfo(Device.queue().getInfo<CL_QUEUE_DEVICE>()(),
                            NonUniformSupport, sizeof(Support), &Support,
                            nullptr),
            CL_SUCCESS);
  EXPECT_EQ(Support, static_cast<cl_bool>(CL_TRUE));
  for (const char *Options :
       {"-cl-std=CL3.0 -cl-uniform-work-group-size", "-cl-std=CL1.2", ""}) {
    const cl::Kernel Kernel = kernel("kernel void none() {}", "none", Options);
    EXPECT_EQ(Device.queue().enqueueNDRangeKernel(
                  Kernel, cl::NullRange, cl::NDRange(10), cl::NDRange(4)),
              CL_INVALID_WORK_GROUP_SIZE)
        << Options;
  }
}

TEST_F(NonUniform, AProgramFromItsBinaryHasThem) {
  const cl::Program Source = Device.build(Ids, "-cl-std=CL3.0");
  const cl::Program Binary(Device.context(),
                           {Device.queue().getInfo<CL_QUEUE_DEVICE>()},
                           Source.getInfo<CL_PROGRAM_BINARIES>());
  ASSERT_EQ(Binary.build(), CL_SUCCESS);
  cl::Kernel Kernel(Binary, "ids");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4 * 21 * 37);
  Kernel.setArg(0, Out);
  Device.run(Kernel, 37, 16);
}

} // namespace
