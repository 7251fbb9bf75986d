/// Objects of every kind, and handles of released ones, to give to functions
/// that do not take them.
#pragma once

#include "TestDevice.h"

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

// clang-format off
// OpenCL 2.0 and later; the headers of these tests are those of 1.2.
extern "C" cl_kernel clCloneKernel(cl_kernel, cl_int *);
// clang-format on

namespace vorion::test {

enum class Kind {
  Platform,
  Device,
  Context,
  Queue,
  Buffer,
  Image,
  Sampler,
  Program,
  Kernel,
  Event,
};

/// A function with all its arguments but one.
struct Use {
  std::string Name;
  std::set<Kind> Takes;
  cl_int Error; ///< for all others
  std::function<cl_int(void *)> Call;
};

template <typename T> T as(void *Object) { return static_cast<T>(Object); }

class WrongHandles : public testing::Test {
protected:
  /// Its kernel takes an object of each kind that an argument may be.
  static constexpr const char *Source =
      "kernel void k(global int *b, constant int *c, read_only image2d_t i,\n"
      "              sampler_t s, local int *l) { b[0] = c[0]; }";

  void SetUp() override {
    VORION_REQUIRE_DEVICE(Open);
    Code = Open.build(Source);
    K = cl::Kernel(Code, "k");
    Data = Open.upload(std::vector<int32_t>(1024, 7));
    Picture = cl::Image2D(Open.context(), CL_MEM_READ_WRITE,
                          {CL_RGBA, CL_UNSIGNED_INT8}, 16, 16);
    Reading = cl::Sampler(Open.context(), CL_FALSE, CL_ADDRESS_CLAMP,
                          CL_FILTER_NEAREST);
    ASSERT_EQ(
        clEnqueueMarkerWithWaitList(Open.queue()(), 0, nullptr, &Marker()),
        CL_SUCCESS);
    Device = Open.context().getInfo<CL_CONTEXT_DEVICES>()[0];
    Objects = {{Kind::Platform, Device.getInfo<CL_DEVICE_PLATFORM>()},
               {Kind::Device, Device()},
               {Kind::Context, Open.context()()},
               {Kind::Queue, Open.queue()()},
               {Kind::Buffer, Data()},
               {Kind::Image, Picture()},
               {Kind::Sampler, Reading()},
               {Kind::Program, Code()},
               {Kind::Kernel, K()},
               {Kind::Event, Marker()}};
    Released = released();
  }

  /// The handles of an object of each kind that is no more.
  std::vector<void *> released() const {
    const cl::Context C(Device);
    const cl::CommandQueue Q(C, Device);
    const cl::Buffer B(C, CL_MEM_READ_WRITE, 64);
    const cl::Image2D I(C, CL_MEM_READ_WRITE, {CL_RGBA, CL_UNSIGNED_INT8}, 4,
                        4);
    const cl::Sampler S(C, CL_FALSE, CL_ADDRESS_CLAMP, CL_FILTER_NEAREST);
    cl::Program P(C, Source);
    EXPECT_EQ(P.build(""), CL_SUCCESS);
    const cl::Kernel Last(P, "k");
    const cl::UserEvent E(C);
    return {C(), Q(), B(), I(), S(), P(), Last(), E()};
  }

  /// Calls each function with every object of a kind that it does not take, and
  /// with every object that was released.
  void refuses(const std::vector<Use> &Uses) const {
    for (const Use &U : Uses) {
      for (const auto &[Which, Object] : Objects)
        if (!U.Takes.contains(Which))
          EXPECT_EQ(U.Call(Object), U.Error)
              << U.Name << ", object " << static_cast<int>(Which);
      for (std::size_t I = 0; I < Released.size(); ++I)
        EXPECT_EQ(U.Call(Released[I]), U.Error)
            << U.Name << ", released object " << I;
    }
  }

  const TestDevice Open;
  cl::Device Device;
  cl::Program Code;
  cl::Kernel K;
  cl::Buffer Data;
  cl::Image2D Picture;
  cl::Sampler Reading;
  cl::Event Marker;
  std::map<Kind, void *> Objects;
  std::vector<void *> Released;
};

} // namespace vorion::test

/// A \c Use of CALL, which takes the object \c O.
#define VORION_USE(TAKES, ERROR, CALL)                                         \
  vorion::test::Use {                                                          \
    #CALL, TAKES, ERROR, [&](void *O) -> cl_int { return CALL; }               \
  }
/// For functions that give the error in their last argument, S.
#define VORION_MAKE(TAKES, ERROR, CALL)                                        \
  vorion::test::Use {                                                          \
    #CALL, TAKES, ERROR, [&](void *O) -> cl_int {                              \
      cl_int S = CL_SUCCESS;                                                   \
      (void)(CALL);                                                            \
      return S;                                                                \
    }                                                                          \
  }
