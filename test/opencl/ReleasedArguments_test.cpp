/// A kernel's arguments that were released before it starts.

#include "WrongHandles.h"

#include <vector>

using vorion::test::WrongHandles;

namespace {

/// The kernel does not retain them. They ended the host.
TEST_F(WrongHandles, ArgumentsReleasedBeforeTheStartAreRefused) {
  const auto Fill = [&](cl_kernel Of) {
    const auto Set = [&](cl_uint Index, void *Object) {
      EXPECT_EQ(clSetKernelArg(Of, Index, sizeof(void *),
                               static_cast<const void *>(&Object)),
                CL_SUCCESS);
    };
    Set(0, Data());
    Set(1, Data());
    Set(2, Picture());
    Set(3, Reading());
    EXPECT_EQ(clSetKernelArg(Of, 4, 64, nullptr), CL_SUCCESS);
  };
  const auto Start = [&](cl_kernel Of) {
    const size_t Items = 16;
    return clEnqueueNDRangeKernel(Open.queue()(), Of, 1, nullptr, &Items,
                                  nullptr, 0, nullptr, nullptr);
  };
  const auto Short = [&] {
    return cl::Buffer(Open.context(), CL_MEM_READ_WRITE, 64);
  };
  Fill(K());
  EXPECT_EQ(K.setArg(0, Short()), CL_SUCCESS);
  EXPECT_EQ(Start(K()), CL_INVALID_KERNEL_ARGS) << "the buffer";
  cl_int Status = CL_SUCCESS;
  const cl_kernel Clone = clCloneKernel(K(), &Status);
  EXPECT_EQ(Start(Clone), CL_INVALID_KERNEL_ARGS) << "of the kernel's clone";
  clReleaseKernel(Clone);
  // Other buffers take the memory of those that were released long ago.
  for (int I = 0; I < 3000; ++I)
    Short();
  std::vector<cl::Buffer> Others;
  Others.reserve(1500);
  for (int I = 0; I < 1500; ++I)
    Others.push_back(Short());
  EXPECT_EQ(Start(K()), CL_INVALID_KERNEL_ARGS) << "another buffer is none";
  Fill(K());
  EXPECT_EQ(K.setArg(2, cl::Image2D(Open.context(), CL_MEM_READ_WRITE,
                                    {CL_RGBA, CL_UNSIGNED_INT8}, 4, 4)),
            CL_SUCCESS);
  EXPECT_EQ(Start(K()), CL_INVALID_KERNEL_ARGS) << "the image";
  Fill(K());
  EXPECT_EQ(K.setArg(3, cl::Sampler(Open.context(), CL_FALSE, CL_ADDRESS_CLAMP,
                                    CL_FILTER_NEAREST)),
            CL_SUCCESS);
  EXPECT_EQ(Start(K()), CL_INVALID_KERNEL_ARGS) << "the sampler";
  Fill(K());
  EXPECT_EQ(Start(K()), CL_SUCCESS);
  EXPECT_EQ(Open.queue().finish(), CL_SUCCESS);
}

} // namespace
