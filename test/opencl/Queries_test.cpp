/// What a device, a kernel, a queue and an event say of themselves.

#include "TestDevice.h"

#include <array>
#include <iterator>
#include <set>
#include <sstream>

using vorion::test::TestDevice;

// Of OpenCL 2.0, which the header declares to programs for it only.
extern "C" cl_command_queue clCreateCommandQueueWithProperties(cl_context,
                                                               cl_device_id,
                                                               const cl_ulong *,
                                                               cl_int *);

namespace {

class Queries : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  cl::Kernel kernel(const char *Source, const char *Name) const {
    const cl::Program Program = Device.build(Source);
    return {Program, Name};
  }
  cl::Device device() const {
    return Device.queue().getInfo<CL_QUEUE_DEVICE>();
  }
  cl_int enqueue(const cl::Kernel &Kernel, std::size_t Items) const {
    return Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange,
                                               cl::NDRange(Items));
  }

  const TestDevice Device;
};

constexpr const char *Locals = R"(
kernel void locals(global uint *out, local uint *t, local float *u) {
  local uint kept[100];
  uint l = get_local_id(0);
  kept[l % 100] = l;
  barrier(CLK_LOCAL_MEM_FENCE);
  out[l] = kept[(l + 1) % 100] + t[0] + (uint)u[0];
})";

TEST_F(Queries, LocalMemoryOfAKernelIsItsVariablesAndItsArguments) {
  cl::Kernel Kernel = kernel(Locals, "locals");
  const auto Bytes = [&] {
    return Kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device());
  };
  EXPECT_EQ(Bytes(), 400U);
  Kernel.setArg(1, cl::Local(1000));
  EXPECT_EQ(Bytes(), 1400U);
  Kernel.setArg(2, cl::Local(24));
  Kernel.setArg(1, cl::Local(4));
  EXPECT_EQ(Bytes(), 428U);
}

TEST_F(Queries, MoreLocalMemoryThanThereIsIsRefusedAtOnce) {
  cl::Kernel Kernel = kernel(Locals, "locals");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 64);
  const auto Most = device().getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
  // 400 bytes of variables, and each argument begins at a multiple of 128.
  const std::size_t Left = Most - 512;
  Kernel.setArg(0, Out);
  Kernel.setArg(1, cl::Local(Left - 128));
  Kernel.setArg(2, cl::Local(128));
  Device.run(Kernel, cl::NDRange(16), cl::NullRange);
  Kernel.setArg(2, cl::Local(132));
  EXPECT_EQ(enqueue(Kernel, 16), CL_OUT_OF_RESOURCES);
  Kernel.setArg(1, cl::Local(Left - 127));
  Kernel.setArg(2, cl::Local(4));
  EXPECT_EQ(enqueue(Kernel, 16), CL_OUT_OF_RESOURCES);
}

/// What the standard asks of a full profile.
TEST_F(Queries, ImagesAreAsLargeAsTheStandardAsks) {
  const cl::Device D = device();
  EXPECT_TRUE(D.getInfo<CL_DEVICE_IMAGE_SUPPORT>());
  EXPECT_GE(D.getInfo<CL_DEVICE_IMAGE2D_MAX_WIDTH>(), 16384U);
  EXPECT_GE(D.getInfo<CL_DEVICE_IMAGE2D_MAX_HEIGHT>(), 16384U);
  EXPECT_GE(D.getInfo<CL_DEVICE_IMAGE3D_MAX_DEPTH>(), 2048U);
  EXPECT_GE(D.getInfo<CL_DEVICE_IMAGE_MAX_BUFFER_SIZE>(), 65536U);
  EXPECT_GE(D.getInfo<CL_DEVICE_IMAGE_MAX_ARRAY_SIZE>(), 2048U);
  EXPECT_GE(D.getInfo<CL_DEVICE_MAX_READ_IMAGE_ARGS>(), 128U);
  EXPECT_GE(D.getInfo<CL_DEVICE_MAX_WRITE_IMAGE_ARGS>(), 64U);
  EXPECT_GE(D.getInfo<CL_DEVICE_MAX_SAMPLERS>(), 16U);
}

TEST_F(Queries, TheDeviceNamesItsClockAndItsExtension) {
  EXPECT_GT(device().getInfo<CL_DEVICE_MAX_CLOCK_FREQUENCY>(), 0U);
  const std::string Names = device().getInfo<CL_DEVICE_EXTENSIONS>() + " ";
  EXPECT_NE(Names.find(" cl_vorion_simulation "), std::string::npos);
}

TEST_F(Queries, EveryExtensionHasAVersion) {
  // CL_DEVICE_EXTENSIONS_WITH_VERSION and cl_name_version of OpenCL 3.0.
  struct NameVersion {
    cl_uint Version;
    char Name[64];
  };
  std::size_t Bytes = 0;
  ASSERT_EQ(clGetDeviceInfo(device()(), 0x1060, 0, nullptr, &Bytes),
            CL_SUCCESS);
  std::vector<NameVersion> Versions(Bytes / sizeof(NameVersion));
  ASSERT_EQ(
      clGetDeviceInfo(device()(), 0x1060, Bytes, Versions.data(), nullptr),
      CL_SUCCESS);
  std::set<std::string> Names;
  for (const NameVersion &V : Versions) {
    Names.insert(V.Name);
    EXPECT_NE(V.Version, 0U) << V.Name;
  }
  std::istringstream List(device().getInfo<CL_DEVICE_EXTENSIONS>());
  EXPECT_EQ(Names, std::set<std::string>(
                       std::istream_iterator<std::string>(List), {}));
}

/// The platform listed two that no device has.
/// A program that names no version of OpenCL C has the functions of the
/// extensions, too.
TEST_F(Queries, DotProductsOfBytesAreOfferedAndThere) {
  cl_bitfield Inputs = 0;
  ASSERT_EQ(
      device().getInfo(CL_DEVICE_INTEGER_DOT_PRODUCT_CAPABILITIES_KHR, &Inputs),
      CL_SUCCESS);
  EXPECT_EQ(Inputs, CL_DEVICE_INTEGER_DOT_PRODUCT_INPUT_4x8BIT_PACKED_KHR |
                        CL_DEVICE_INTEGER_DOT_PRODUCT_INPUT_4x8BIT_KHR);
  cl_device_integer_dot_product_acceleration_properties_khr Fast;
  ASSERT_EQ(device().getInfo(
                CL_DEVICE_INTEGER_DOT_PRODUCT_ACCELERATION_PROPERTIES_8BIT_KHR,
                &Fast),
            CL_SUCCESS);
  EXPECT_FALSE(Fast.signed_accelerated);
  cl_bool Small = 0;
  EXPECT_EQ(
      clGetDeviceInfo(
          device()(),
          CL_DEVICE_INTEGER_DOT_PRODUCT_ACCELERATION_PROPERTIES_4x8BIT_PACKED_KHR,
          sizeof(Small), &Small, nullptr),
      CL_INVALID_VALUE);

  const cl::Kernel Kernel = kernel(R"(
kernel void dots(global int *out) {
#if defined(cl_khr_integer_dot_product) && defined(cl_khr_extended_bit_ops) && \
    defined(cl_khr_expect_assume)
  int i = get_global_id(0);
  __builtin_assume(i < 4);
  out[i] = dot_acc_sat((char4)(-i), (uchar4)(255), 10) +
           dot_4x8packed_uu_uint(0x01020304u, 0x01010101u * i) +
           bitfield_extract_signed(0x70, 4, 3);
#endif
})",
                                   "dots");
  cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 16);
  cl::Kernel Called = Kernel;
  Called.setArg(0, Out);
  ASSERT_EQ(enqueue(Called, 4), CL_SUCCESS);
  std::array<cl_int, 4> Got{};
  ASSERT_EQ(Device.queue().enqueueReadBuffer(Out, CL_TRUE, 0, 16, Got.data()),
            CL_SUCCESS);
  for (int I = 0; I != 4; ++I)
    EXPECT_EQ(Got[I], -1020 * I + 10 + 10 * I - 1);
}

TEST_F(Queries, ThePlatformListsNothingThatTheDeviceLacks) {
  const cl::Platform Platform(device().getInfo<CL_DEVICE_PLATFORM>());
  std::istringstream List(Platform.getInfo<CL_PLATFORM_EXTENSIONS>());
  const std::set<std::string> Names(std::istream_iterator<std::string>(List),
                                    {});
  // They are the platform's own.
  EXPECT_EQ(Names, (std::set<std::string>{"cl_khr_icd", "cl_khr_priority_hints",
                                          "cl_khr_throttle_hints"}));
}

TEST_F(Queries, AllMemoryThatIsReportedCanBeUsedByAKernel) {
  // Four buffers take all of it; a launch still has room, and a fifth has none.
  const auto Most = device().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  const auto Largest = device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  ASSERT_GE(Largest, Most / 4);
  cl_int Status = CL_SUCCESS;
  const std::size_t Bytes = Most / 4 - 4096;
  std::vector<cl::Buffer> Quarters;
  Quarters.reserve(4);
  for (int I = 0; I < 4; ++I)
    Quarters.emplace_back(Device.context(), CL_MEM_READ_WRITE, Bytes);
  cl::Kernel Kernel = kernel(R"(
kernel void ends(global uint *a, global uint *b, global uint *c,
                 global uint *d, ulong n) {
  uint kept[64];
  for (uint i = 0; i < 64; i++)
    kept[i] = i * get_local_id(0);
  barrier(CLK_GLOBAL_MEM_FENCE);
  a[n] = b[n] = c[n] = d[n] = kept[get_local_id(0) % 64];
})",
                             "ends");
  for (cl_uint I = 0; I < 4; ++I)
    Kernel.setArg(I, Quarters[I]);
  Kernel.setArg(4, cl_ulong{Bytes / 4 - 1});
  Device.run(Kernel, 1024, cl::NullRange);
  cl_uint Value = 0;
  for (const cl::Buffer &Quarter : Quarters)
    EXPECT_EQ(Device.queue().enqueueReadBuffer(Quarter, CL_TRUE, Bytes - 4, 4,
                                               &Value),
              CL_SUCCESS);

  const cl::Buffer Third(Device.context(), CL_MEM_READ_WRITE, 1 << 20, nullptr,
                         &Status);
  cl::Kernel Touch =
      kernel("kernel void touch(global uint *p) { p[0] = 1; }", "touch");
  Touch.setArg(0, Third);
  EXPECT_EQ(Status, CL_SUCCESS);
  EXPECT_EQ(enqueue(Touch, 1), CL_MEM_OBJECT_ALLOCATION_FAILURE);
}

TEST_F(Queries, TheSourcesGroupSizeIsTakenWhereNoneIsGiven) {
  cl::Kernel Kernel = kernel(R"(
kernel __attribute__((reqd_work_group_size(4, 3, 1)))
void size(global uint *out) {
  if (get_global_id(0) == 0 && get_global_id(1) == 0)
    out[0] = get_local_size(0) * 100 + get_local_size(1);
})",
                             "size");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4);
  Kernel.setArg(0, Out);
  EXPECT_EQ(Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange,
                                                cl::NDRange(8, 6)),
            CL_SUCCESS);
  EXPECT_EQ(Device.download<cl_uint>(Out, 1)[0], 403U);
  EXPECT_EQ(Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange,
                                                cl::NDRange(8, 4)),
            CL_INVALID_WORK_GROUP_SIZE);
}

TEST_F(Queries, AnOutOfOrderQueueDoesNotWaitForWhatCannotRun) {
  const cl::CommandQueue Queue(Device.context(), device(),
                               CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  ASSERT_TRUE(Queue.getInfo<CL_QUEUE_PROPERTIES>() &
              CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  cl::UserEvent Gate(Device.context());
  const cl::Buffer Buffer(Device.context(), CL_MEM_READ_WRITE, 8);
  const std::vector<cl::Event> Waits{Gate};
  cl::Event First, Second, Barrier, Last;
  Queue.enqueueFillBuffer(Buffer, cl_uint{1}, 0, 4, &Waits, &First);
  Queue.enqueueFillBuffer(Buffer, cl_uint{2}, 4, 4, nullptr, &Second);
  EXPECT_EQ(Second.wait(), CL_SUCCESS);
  EXPECT_GT(First.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(), CL_COMPLETE);

  // A barrier holds back what follows, in this queue, too.
  Queue.enqueueBarrierWithWaitList(nullptr, &Barrier);
  Queue.enqueueFillBuffer(Buffer, cl_uint{3}, 0, 4, nullptr, &Last);
  Queue.flush();
  EXPECT_GT(Last.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(), CL_COMPLETE);
  Gate.setStatus(CL_COMPLETE);
  EXPECT_EQ(Queue.finish(), CL_SUCCESS);
  EXPECT_EQ(Device.download<cl_uint>(Buffer, 2), (std::vector<cl_uint>{3, 2}));
}

TEST_F(Queries, AttributesOfAKernelAreThoseInsideTheParentheses) {
  const cl::Kernel Kernel = kernel(
      "__attribute__((reqd_work_group_size(8, 2, 1)))\n"
      "__attribute__((vec_type_hint(float4)))\n"
      "kernel void sized(global int *out) { out[get_global_id(0)] = 1; }",
      "sized");
  EXPECT_EQ(Kernel.getInfo<CL_KERNEL_ATTRIBUTES>(),
            "reqd_work_group_size(8,2,1) vec_type_hint(float4)");
}

TEST_F(Queries, AQueueOnTheDeviceIsRefused) {
  constexpr cl_ulong OnDevice = 1 << 2; // CL_QUEUE_ON_DEVICE of OpenCL 2.0
  for (const cl_ulong Asked :
       {CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE | OnDevice, cl_ulong{1} << 20}) {
    const cl_ulong Properties[] = {CL_QUEUE_PROPERTIES, Asked, 0};
    cl_int Error = CL_SUCCESS;
    EXPECT_EQ(clCreateCommandQueueWithProperties(Device.context()(), device()(),
                                                 Properties, &Error),
              nullptr);
    EXPECT_NE(Error, CL_SUCCESS);
  }
}

} // namespace
