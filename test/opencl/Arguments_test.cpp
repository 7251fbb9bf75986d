/// What a program must not pass to OpenCL functions: an error with the
/// standard's code, never a crash, and nothing cut off. Found by random call
/// sequences (fuzz/ApiSequences.cpp).

#include "TestDevice.h"

#include <array>
#include <cstdint>
#include <vector>

using vorion::test::TestDevice;

namespace {

constexpr const char *Source =
    "kernel void fine(global int *p) { p[get_global_id(0)] = 42; }";

class Arguments : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    Program = Device.build(Source);
    Data = Device.upload(std::vector<int32_t>(1024, 7));
    Fine = cl::Kernel(Program, "fine");
    EXPECT_EQ(Fine.setArg(0, Data), CL_SUCCESS);
  }
  cl_int start(std::size_t Global, std::size_t Local, std::size_t Offset = 0) {
    return clEnqueueNDRangeKernel(Device.queue()(), Fine(), 1, &Offset, &Global,
                                  &Local, 0, nullptr, nullptr);
  }
  std::string logOf(const cl::Program &P) {
    return P.getBuildInfo<CL_PROGRAM_BUILD_LOG>(
        Device.context().getInfo<CL_CONTEXT_DEVICES>()[0]);
  }

  const TestDevice Device;
  cl::Program Program;
  cl::Buffer Data;
  cl::Kernel Fine;
};

TEST_F(Arguments, GroupsOfNothingAreRefused) {
  EXPECT_EQ(start(16, 0), CL_INVALID_WORK_GROUP_SIZE);
  const std::size_t Global[] = {16, 16}, Local[] = {16, 0};
  EXPECT_EQ(clEnqueueNDRangeKernel(Device.queue()(), Fine(), 2, nullptr, Global,
                                   Local, 0, nullptr, nullptr),
            CL_INVALID_WORK_GROUP_SIZE);
  const std::size_t Huge[] = {std::size_t{1} << 32, std::size_t{1} << 32};
  EXPECT_NE(clEnqueueNDRangeKernel(Device.queue()(), Fine(), 2, nullptr, Global,
                                   Huge, 0, nullptr, nullptr),
            CL_SUCCESS)
      << "a product that overflows";
}

/// 2^32 + 16 work-items were 16.
TEST_F(Arguments, GridsThatTheDeviceCannotCountAreRefused) {
  EXPECT_EQ(start((std::size_t{1} << 32) + 16, 16),
            CL_INVALID_GLOBAL_WORK_SIZE);
  EXPECT_EQ(start(16, 16, (std::size_t{1} << 32) - 8),
            CL_INVALID_GLOBAL_OFFSET);
}

/// OpenCL 2.1 made an error of it a command that does nothing.
TEST_F(Arguments, GridsOfNothingDoNothing) {
  EXPECT_EQ(start(0, 16), CL_SUCCESS);
  EXPECT_EQ(clEnqueueNDRangeKernel(Device.queue()(), Fine(), 1, nullptr,
                                   nullptr, nullptr, 0, nullptr, nullptr),
            CL_SUCCESS);
  EXPECT_EQ(Device.queue().finish(), CL_SUCCESS);
}

TEST_F(Arguments, NullHandlesAreNamed) {
  const std::size_t Items = 16;
  EXPECT_EQ(clEnqueueNDRangeKernel(Device.queue()(), nullptr, 1, nullptr,
                                   &Items, &Items, 0, nullptr, nullptr),
            CL_INVALID_KERNEL);
  const std::array<std::size_t, 3> Origin{0, 0, 0}, Region{4, 1, 1};
  EXPECT_EQ(clEnqueueCopyBufferRect(Device.queue()(), nullptr, Data(),
                                    Origin.data(), Origin.data(), Region.data(),
                                    0, 0, 0, 0, 0, nullptr, nullptr),
            CL_INVALID_MEM_OBJECT);
  cl_int Status = CL_SUCCESS;
  const cl_program Input = nullptr;
  EXPECT_EQ(clLinkProgram(Device.context()(), 0, nullptr, nullptr, 1, &Input,
                          nullptr, nullptr, &Status),
            nullptr);
  EXPECT_EQ(Status, CL_INVALID_PROGRAM);
  EXPECT_EQ(clCreateProgramWithSource(Device.context()(), 1, nullptr, nullptr,
                                      &Status),
            nullptr);
  EXPECT_EQ(Status, CL_INVALID_VALUE);
}

TEST_F(Arguments, RegionsThatOverflowAreOutside) {
  constexpr std::size_t Most = SIZE_MAX;
  std::array<uint8_t, 4096> Host{};
  const std::array<std::size_t, 3> Zero{0, 0, 0};
  const auto Read = [&](std::array<std::size_t, 3> Origin,
                        std::array<std::size_t, 3> Region, std::size_t Row) {
    return clEnqueueReadBufferRect(
        Device.queue()(), Data(), CL_TRUE, Origin.data(), Zero.data(),
        Region.data(), Row, 0, 0, 0, Host.data(), 0, nullptr, nullptr);
  };
  EXPECT_EQ(Read({0, 0, 0}, {0, 1, 1}, 0), CL_INVALID_VALUE);
  EXPECT_EQ(Read({Most, 0, 0}, {1, 1, 1}, 0), CL_INVALID_VALUE);
  EXPECT_EQ(Read({1, 0, 0}, {Most, 1, 1}, 0), CL_INVALID_VALUE);
  EXPECT_EQ(Read({0, 1, 0}, {1, 1, 1}, Most), CL_INVALID_VALUE);
  EXPECT_EQ(Read({0, 0, 0}, {1, Most / 2 + 1, 2}, 2), CL_INVALID_VALUE);
  EXPECT_EQ(Read({0, 0, 0}, {16, 4, 2}, 0), CL_SUCCESS);
  EXPECT_EQ(clEnqueueReadBuffer(Device.queue()(), Data(), CL_TRUE, 16, Most - 8,
                                Host.data(), 0, nullptr, nullptr),
            CL_INVALID_VALUE);
}

TEST_F(Arguments, PartsOfABufferAreCopiedAsRectangles) {
  cl_buffer_region First{0, 128}, Second{1024, 128};
  cl_int Status = CL_SUCCESS;
  cl::Buffer From =
      Data.createSubBuffer(0, CL_BUFFER_CREATE_TYPE_REGION, &First, &Status);
  cl::Buffer To =
      Data.createSubBuffer(0, CL_BUFFER_CREATE_TYPE_REGION, &Second, &Status);
  const std::vector<int32_t> Values = {1, 2, 3, 4};
  EXPECT_EQ(
      Device.queue().enqueueWriteBuffer(From, CL_TRUE, 0, 16, Values.data()),
      CL_SUCCESS);
  EXPECT_EQ(Device.queue().enqueueCopyBufferRect(From, To, {0, 0, 0}, {4, 0, 0},
                                                 {8, 1, 1}, 0, 0, 0, 0),
            CL_SUCCESS);
  std::vector<int32_t> Got(4);
  EXPECT_EQ(
      Device.queue().enqueueReadBuffer(Data, CL_TRUE, 1024, 16, Got.data()),
      CL_SUCCESS);
  EXPECT_EQ(Got, (std::vector<int32_t>{7, 1, 2, 7}));
}

/// The pointer was one into a copy that went with the buffer's first use.
TEST_F(Arguments, AMappingOutlivesTheCopyToTheDevice) {
  std::vector<int32_t> Values(1024, 5);
  const cl::Buffer Copied(Device.context(), cl_mem_flags{CL_MEM_COPY_HOST_PTR},
                          std::size_t{4096}, Values.data());
  cl::UserEvent Gate(Device.context());
  const cl::CommandQueue Queue(Device.context(),
                               cl::QueueProperties::OutOfOrder);
  const std::vector<cl::Event> After = {Gate};
  cl::Event Mapped;
  cl_int Status = CL_SUCCESS;
  auto *Pointer = static_cast<int32_t *>(
      Queue.enqueueMapBuffer(Copied, CL_FALSE, CL_MAP_READ | CL_MAP_WRITE, 64,
                             256, &After, &Mapped, &Status));
  ASSERT_EQ(Status, CL_SUCCESS);
  EXPECT_EQ(Gate.setStatus(CL_COMPLETE), CL_SUCCESS);
  EXPECT_EQ(Mapped.wait(), CL_SUCCESS);
  EXPECT_EQ(Pointer[0], 5);
  Pointer[0] = 9;
  EXPECT_EQ(Queue.enqueueUnmapMemObject(Copied, Pointer), CL_SUCCESS);
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  EXPECT_EQ(Device.download<int32_t>(Copied, 18)[16], 9);
  EXPECT_EQ(Device.download<int32_t>(Copied, 18)[17], 5);
}

TEST_F(Arguments, FlagsThatMeanNothingAreRefused) {
  cl_int Status = CL_SUCCESS;
  for (const cl_mem_flags Flag :
       {cl_mem_flags{1} << 6, cl_mem_flags{1} << 30, cl_mem_flags{1} << 31}) {
    clCreateBuffer(Device.context()(), Flag, 64, nullptr, &Status);
    EXPECT_EQ(Status, CL_INVALID_VALUE) << Flag;
  }
  const cl::Image2D Image(Device.context(), CL_MEM_READ_WRITE,
                          {CL_RGBA, CL_UNSIGNED_INT8}, 16, 16);
  const std::array<std::size_t, 3> Zero{0, 0, 0}, Four{4, 4, 1};
  std::size_t Row = 0;
  for (const cl_map_flags Flags :
       {cl_map_flags{0xff0},
        cl_map_flags{CL_MAP_READ | CL_MAP_WRITE_INVALIDATE_REGION},
        cl_map_flags{CL_MAP_WRITE | CL_MAP_WRITE_INVALIDATE_REGION}}) {
    clEnqueueMapBuffer(Device.queue()(), Data(), CL_TRUE, Flags, 0, 4, 0,
                       nullptr, nullptr, &Status);
    EXPECT_EQ(Status, CL_INVALID_VALUE) << Flags;
    clEnqueueMapImage(Device.queue()(), Image(), CL_TRUE, Flags, Zero.data(),
                      Four.data(), &Row, nullptr, 0, nullptr, nullptr, &Status);
    EXPECT_EQ(Status, CL_INVALID_VALUE) << Flags;
  }
  EXPECT_EQ(clGetSupportedImageFormats(
                Device.context()(), CL_MEM_READ_ONLY | CL_MEM_WRITE_ONLY,
                CL_MEM_OBJECT_IMAGE2D, 0, nullptr, nullptr),
            CL_INVALID_VALUE);
}

/// The kernel got the handle of the host for such an image, and ended it.
TEST_F(Arguments, TypesOfImagesAndSamplersMayHaveOtherNames) {
  const cl::Program P = Device.build(
      "typedef image2d_t picture;\n"
      "typedef sampler_t reading;\n"
      "kernel void f(read_only picture i, reading s, global uint4 *o) {\n"
      "  o[0] = read_imageui(i, s, (int2)(1, 1));\n"
      "}\n");
  std::vector<uint8_t> Texels(64, 9);
  const cl::Image2D Image(Device.context(),
                          CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                          {CL_RGBA, CL_UNSIGNED_INT8}, 4, 4, 0, Texels.data());
  const cl::Sampler Reading(Device.context(), CL_FALSE, CL_ADDRESS_CLAMP,
                            CL_FILTER_NEAREST);
  cl::Kernel F(P, "f");
  EXPECT_EQ(F.setArg(0, Image), CL_SUCCESS);
  EXPECT_EQ(F.setArg(1, Reading), CL_SUCCESS);
  EXPECT_EQ(F.setArg(2, Data), CL_SUCCESS);
  Device.run(F, 1, 1);
  EXPECT_EQ(Device.download<int32_t>(Data, 4), (std::vector<int32_t>(4, 9)));
}

TEST_F(Arguments, OptionsWithoutAValueAreRefused) {
  cl::Program P(Device.context(), Source);
  for (const char *Option : {"-D", "-I", "-cl", "-cl-nothing", "-x"})
    EXPECT_NE(P.build(Option), CL_SUCCESS) << Option;
  std::string Many;
  for (int I = 0; I < 200; ++I)
    Many += "-cl-denorms-are-zero ";
  P.build(Many.c_str()); // longer once it is clang's
}

TEST_F(Arguments, WhatIsSaidOfOptionsHidesNoErrors) {
  cl::Program P(Device.context(), "kernel void f(void) { nowhere(); }");
  EXPECT_EQ(P.build("-cl-no-subgroup-ifp"), CL_BUILD_PROGRAM_FAILURE);
  EXPECT_NE(logOf(P).find("-cl-no-subgroup-ifp"), std::string::npos);
  EXPECT_NE(logOf(P).find(":1:23: error:"), std::string::npos) << logOf(P);
}

/// Only values of types with names that PoCL knows were held against sizes.
TEST_F(Arguments, SizesOfStructuresAndVectorsAreCompared) {
  const cl::Program P = Device.build(
      "typedef struct { int a; char b; float4 c; } pose;\n"
      "typedef struct { uchar part[3]; } three;\n"
      "typedef float2 pair;\n"
      "kernel void f(global float *o, pose p, three t, pair q, int4 v,\n"
      "              float3 w, char c) {\n"
      "  o[0] = p.a + p.b + p.c.w + t.part[2] + q.y + v.w + w.z + c;\n"
      "}\n");
  const cl::Kernel F(P, "f");
  const std::array<char, 64> Zeros{};
  struct {
    cl_uint Argument;
    std::vector<std::size_t> Right, Wrong;
  } const Cases[] = {
      {1, {32}, {0, 4, 24, 31, 33, 64}}, {2, {3}, {1, 2, 4, 8}},
      {3, {8}, {4, 6, 12, 16}},          {4, {16}, {4, 12, 15, 32}},
      {5, {12, 16}, {4, 8, 13, 32}},     {6, {1}, {0, 2, 3, 4}}};
  for (const auto &C : Cases) {
    for (const std::size_t Size : C.Wrong)
      EXPECT_EQ(clSetKernelArg(F(), C.Argument, Size, Zeros.data()),
                CL_INVALID_ARG_SIZE)
          << "argument " << C.Argument << ", " << Size << " bytes";
    for (const std::size_t Size : C.Right)
      EXPECT_EQ(clSetKernelArg(F(), C.Argument, Size, Zeros.data()), CL_SUCCESS)
          << "argument " << C.Argument << ", " << Size << " bytes";
  }
}

TEST_F(Arguments, DamagedBinariesAreInvalid) {
  const auto Binaries = Program.getInfo<CL_PROGRAM_BINARIES>();
  ASSERT_EQ(Binaries.size(), 1U);
  const std::vector<cl::Device> Devices =
      Device.context().getInfo<CL_CONTEXT_DEVICES>();
  cl_int Status = CL_SUCCESS;
  const cl::Program Whole(Device.context(), Devices, Binaries, nullptr,
                          &Status);
  EXPECT_EQ(Status, CL_SUCCESS);
  for (const std::size_t At :
       {std::size_t{9}, std::size_t{40}, Binaries[0].size() / 2,
        Binaries[0].size() - 1}) {
    auto Damaged = Binaries;
    Damaged[0][At] ^= 0x10;
    const cl::Program Bad(Device.context(), Devices, Damaged, nullptr, &Status);
    EXPECT_EQ(Status, CL_INVALID_BINARY) << At;
  }
  auto Cut = Binaries;
  Cut[0].resize(Cut[0].size() / 3);
  const cl::Program Bad(Device.context(), Devices, Cut, nullptr, &Status);
  EXPECT_EQ(Status, CL_INVALID_BINARY);
}

} // namespace
