/// Kernels that come as SPIR-V. The modules are made when the tests are built
/// (CMakeLists.txt): by another compiler from Inputs/spirv/*.cl, and by an
/// assembler from Inputs/spirv/*.spvasm.

// For clSetProgramSpecializationConstant().
#define CL_TARGET_OPENCL_VERSION 220
#include "TestDevice.h"

#include <CL/cl_ext.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using vorion::test::TestDevice;

namespace {

using Bytes = std::vector<char>;

Bytes fileBytes(const std::string &Path) {
  std::ifstream Stream(Path, std::ios::binary);
  EXPECT_TRUE(Stream) << Path;
  return {std::istreambuf_iterator<char>(Stream), {}};
}

Bytes module(const std::string &Name) {
  return fileBytes(VORION_SPIRV_FOLDER "/" + Name + ".spv");
}

void setWord(Bytes &Module, std::size_t Index, uint32_t Value) {
  std::memcpy(Module.data() + Index * sizeof(Value), &Value, sizeof(Value));
}

class Spirv : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  cl::Device device() const {
    return Device.queue().getInfo<CL_QUEUE_DEVICE>();
  }

  cl::Program create(const Bytes &Module, cl_int &Status,
                     cl_context Context = nullptr) const {
    const cl::Platform Platform(device().getInfo<CL_DEVICE_PLATFORM>());
    const auto Create = reinterpret_cast<clCreateProgramWithILKHR_fn>(
        clGetExtensionFunctionAddressForPlatform(Platform(),
                                                 "clCreateProgramWithILKHR"));
    if (!Create) {
      Status = CL_INVALID_OPERATION;
      return {};
    }
    return cl::Program(Create(Context ? Context : Device.context()(),
                              Module.data(), Module.size(), &Status));
  }

  /// The program, built.
  cl::Program build(const Bytes &Module) const {
    cl_int Status = CL_SUCCESS;
    cl::Program Program = create(Module, Status);
    EXPECT_EQ(Status, CL_SUCCESS);
    EXPECT_EQ(Program.build("-cl-kernel-arg-info"), CL_SUCCESS) << log(Program);
    return Program;
  }

  std::string log(const cl::Program &Program) const {
    return Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device());
  }

  /// What the build of a module says that must not succeed.
  std::string refusal(const Bytes &Module) const {
    cl_int Status = CL_SUCCESS;
    cl::Program Program = create(Module, Status);
    EXPECT_EQ(Status, CL_SUCCESS);
    EXPECT_EQ(Program.build(), CL_BUILD_PROGRAM_FAILURE);
    return log(Program);
  }

  static constexpr std::size_t Items = 96;
  static constexpr std::size_t GroupItems = 32;

  /// What a kernel of kernels.cl writes.
  std::vector<cl_uint> run(const cl::Program &Program, const char *Name) const {
    std::vector<cl_uint> In(Items + 64);
    for (std::size_t I = 0; I < In.size(); ++I)
      In[I] = static_cast<cl_uint>(I * I * 2654435761U >> (I % 21));
    const cl::Buffer Input = Device.upload(In);
    const cl::Buffer Output =
        Device.upload(std::vector<cl_uint>(Items + GroupItems));
    cl::Kernel Kernel(Program, Name);
    Kernel.setArg(0, Output);
    Kernel.setArg(1, Input);
    Kernel.setArg(2, cl::Local(GroupItems * sizeof(cl_uint)));
    Device.run(Kernel, Items, GroupItems);
    return Device.download<cl_uint>(Output, Items + GroupItems);
  }

  const TestDevice Device;
};

/// A file and a kernel of it.
using FileAndKernel = std::pair<const char *, const char *>;

class SpirvKernels : public Spirv,
                     public testing::WithParamInterface<FileAndKernel> {};

TEST_P(SpirvKernels, ComputeWhatTheirSourceDoes) {
  const auto [File, Kernel] = GetParam();
  const Bytes Text =
      fileBytes(std::string(VORION_SPIRV_SOURCES "/") + File + ".cl");
  const cl::Program Source = Device.build({Text.begin(), Text.end()});
  EXPECT_EQ(run(build(module(File)), Kernel), run(Source, Kernel));
}

INSTANTIATE_TEST_SUITE_P(All, SpirvKernels,
                         testing::Values(FileAndKernel("kernels", "vectors"),
                                         FileAndKernel("kernels", "components"),
                                         FileAndKernel("kernels", "memory"),
                                         FileAndKernel("kernels", "integers"),
                                         FileAndKernel("kernels", "math"),
                                         FileAndKernel("kernels", "groups"),
                                         FileAndKernel("kernels", "flow"),
                                         FileAndKernel("bits", "bits")),
                         [](const auto &Info) { return Info.param.second; });

TEST_F(Spirv, TheDeviceSaysWhichVersionsItTakes) {
  EXPECT_NE(device().getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_il_program"),
            std::string::npos);
  std::array<char, 256> Versions{};
  ASSERT_EQ(clGetDeviceInfo(device()(), CL_DEVICE_IL_VERSION_KHR,
                            Versions.size(), Versions.data(), nullptr),
            CL_SUCCESS);
  EXPECT_NE(std::string(Versions.data()).find("SPIR-V_1.3"), std::string::npos);
}

TEST_F(Spirv, TheProgramReturnsItsModule) {
  const Bytes Module = module("kernels");
  const cl::Program Program = build(Module);
  std::size_t Size = 0;
  ASSERT_EQ(clGetProgramInfo(Program(), CL_PROGRAM_IL_KHR, 0, nullptr, &Size),
            CL_SUCCESS);
  ASSERT_EQ(Size, Module.size());
  Bytes Back(Size);
  ASSERT_EQ(clGetProgramInfo(Program(), CL_PROGRAM_IL_KHR, Size, Back.data(),
                             nullptr),
            CL_SUCCESS);
  EXPECT_EQ(Back, Module);
}

TEST_F(Spirv, AKernelIsDescribedAsItsSourceWouldBe) {
  const cl::Kernel Kernel(build(module("kernels")), "groups");
  EXPECT_EQ(Kernel.getInfo<CL_KERNEL_NUM_ARGS>(), 3U);
  EXPECT_EQ(Kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(0),
            static_cast<cl_uint>(CL_KERNEL_ARG_ADDRESS_GLOBAL));
  EXPECT_EQ(Kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(2),
            static_cast<cl_uint>(CL_KERNEL_ARG_ADDRESS_LOCAL));
  EXPECT_EQ(Kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(1), "int*");
  EXPECT_EQ(Kernel.getArgInfo<CL_KERNEL_ARG_NAME>(1), "in");
  const auto Size =
      Kernel.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(device());
  EXPECT_EQ(Size[0], 32U);
  EXPECT_EQ(Size[1], 1U);
  EXPECT_EQ(Kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device()), 260U);
}

TEST_F(Spirv, ModulesOfAnAssemblerRun) {
  const cl::Program Program = build(module("shared"));
  for (const char *Name : {"first", "second"}) {
    cl::Kernel Kernel(Program, Name);
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 64);
    Kernel.setArg(0, Out);
    Device.run(Kernel, 16, 16);
    const std::vector<cl_uint> Seen = Device.download<cl_uint>(Out, 16);
    for (cl_uint I = 0; I < 16; ++I)
      EXPECT_EQ(Seen[I], ((15 - I) % 4 * 10 + I) * (*Name == 's' ? 2 : 1))
          << Name << " " << I;
  }
}

/// llvm-spirv-15 crashes: OpenCL-CTS's op_assume and op_expect have nulls of
/// scalars and shuffles of vectors with different numbers of lanes.
TEST_F(Spirv, FormsThatTheTranslatorLacksAreRead) {
  cl::Kernel Kernel(build(module("forms")), "forms");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 96);
  Kernel.setArg(0, Out);
  Kernel.setArg(1, 7);
  Device.run(Kernel, 1, 1);
  std::vector<cl_uint> Seen = Device.download<cl_uint>(Out, 24);
  // One lane may be anything.
  Seen[13] = 0;
  EXPECT_EQ(Seen, (std::vector<cl_uint>{9, 5, 4, 7, 2, 7, 9, 1, //
                                        9, 1, 2, 3, 0, 0, 7, 0, //
                                        1, 2, 7, 9, 9, 4, 9, 4}));
}

TEST_F(Spirv, CppForOpenClRuns) {
  cl::Kernel Kernel(build(module("templates")), "templates");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 64);
  Kernel.setArg(0, Out);
  Device.run(Kernel, 16, 16);
  const std::vector<cl_int> Seen = Device.download<cl_int>(Out, 16);
  for (cl_int I = 0; I < 16; ++I)
    EXPECT_EQ(Seen[I], I * I + 3 * I + 7) << I;
}

TEST_F(Spirv, SpecializationConstantsAreSetBeforeTheBuild) {
  struct Case {
    std::optional<cl_uint> Scale;
    std::optional<cl_ulong> Value;
    std::optional<cl_uchar> Flag;
    cl_ulong Result;
  };
  const Bytes Module = module("spec");
  // The translator's own option refuses numbers of 17 digits.
  constexpr cl_ulong Long = 4609589727908835759;
  const std::array<Case, 6> Cases = {
      {{{}, {}, {}, 5},
       {{}, {}, cl_uchar{1}, 15},
       {4, {}, cl_uchar{1}, 20},
       {1U << 31, 1ULL << 32 | 3, cl_uchar{1}, (1ULL << 31) * (1ULL << 32 | 3)},
       {1, ~0ULL, cl_uchar{1}, ~0ULL},
       {3, Long, cl_uchar{1}, 3 * Long}}};
  for (const Case &C : Cases) {
    cl_int Status = CL_SUCCESS;
    cl::Program Program = create(Module, Status);
    ASSERT_EQ(Status, CL_SUCCESS);
    const auto Set = [&](cl_uint Id, const auto &Value) {
      if (Value)
        EXPECT_EQ(clSetProgramSpecializationConstant(Program(), Id,
                                                     sizeof(*Value), &*Value),
                  CL_SUCCESS);
    };
    Set(7, C.Scale);
    Set(8, C.Value);
    Set(9, C.Flag);
    ASSERT_EQ(Program.build(), CL_SUCCESS) << log(Program);
    cl::Kernel Kernel(Program, "spec");
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 8);
    Kernel.setArg(0, Out);
    Device.run(Kernel, 1, 1);
    EXPECT_EQ(Device.download<cl_ulong>(Out, 1)[0], C.Result);
  }
  cl_int Status = CL_SUCCESS;
  const cl::Program Program = create(Module, Status);
  const cl_ulong Value = 1;
  const auto Set = [&](cl_uint Id, std::size_t Size, const void *From) {
    return clSetProgramSpecializationConstant(Program(), Id, Size, From);
  };
  EXPECT_EQ(Set(6, 4, &Value), CL_INVALID_SPEC_ID);
  EXPECT_EQ(Set(7, 8, &Value), CL_INVALID_VALUE);
  EXPECT_EQ(Set(7, 4, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(clSetProgramSpecializationConstant(nullptr, 7, 4, &Value),
            CL_INVALID_PROGRAM);
}

TEST_F(Spirv, FloatsArePrintedAsDoublesAre) {
  const cl::Program Program = build(module("prints"));
  cl::Kernel Kernel(Program, "prints");
  Kernel.setArg(0, 2.5F);
  testing::internal::CaptureStdout();
  Device.run(Kernel, 1, 1);
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "2.5 0x1.4p+1 2.50,5.00 7\n");
}

TEST_F(Spirv, VariablesOfProgramScopeStayBetweenKernels) {
  const cl::Program Program = build(module("variables"));
  const auto Run = [&](const char *Name) {
    const cl::Buffer Out = Device.upload(std::vector<cl_int>(2));
    cl::Kernel Kernel(Program, Name);
    Kernel.setArg(0, Out);
    Device.run(Kernel, 1, 1);
    return Device.download<cl_int>(Out, 2);
  };
  EXPECT_EQ(Run("add"), (std::vector<cl_int>{40, 4}));
  EXPECT_EQ(Run("add"), (std::vector<cl_int>{41, 6}));
  EXPECT_EQ(Run("look"), (std::vector<cl_int>{42, 2}));
}

class SpirvLinks : public Spirv {
protected:
  /// The module imports.spv and \p Source, linked.
  cl::Program link(const char *Source, cl_int &Status) const {
    cl::Program Module = create(module("imports"), Status);
    EXPECT_EQ(Module.compile(), CL_SUCCESS) << log(Module);
    cl::Program Other(Device.context(), Source);
    EXPECT_EQ(Other.compile(), CL_SUCCESS) << log(Other);
    return cl::linkProgram(Module, Other, nullptr, nullptr, nullptr, &Status);
  }
};

TEST_F(SpirvLinks, AModuleCallsWhatASourceHas) {
  cl_int Status = CL_SUCCESS;
  const cl::Program Linked =
      link("int twice(int x) { return 2 * x; }"
           "kernel void beside(global int *out) { out[0] = 1; }",
           Status);
  ASSERT_EQ(Status, CL_SUCCESS);
  cl::Kernel Kernel(Linked, "imports");
  const cl::Buffer Out = Device.upload(std::vector<cl_int>{0, 21});
  Kernel.setArg(0, Out);
  Device.run(Kernel, 1, 1);
  EXPECT_EQ(Device.download<cl_int>(Out, 2)[0], 42);
}

TEST_F(SpirvLinks, AFunctionOfOtherTypesIsNotTakenForIt) {
  cl_int Status = CL_SUCCESS;
  const cl::Program Linked =
      link("float twice(float x) { return 2 * x; }", Status);
  EXPECT_EQ(Status, CL_LINK_PROGRAM_FAILURE);
  EXPECT_NE(log(Linked).find("twice is called with other types"),
            std::string::npos)
      << log(Linked);
}

TEST_F(SpirvLinks, AFunctionThatNobodyHasIsNamed) {
  cl_int Status = CL_SUCCESS;
  const cl::Program Linked = link("int other(int x) { return x; }", Status);
  EXPECT_EQ(Status, CL_LINK_PROGRAM_FAILURE);
  EXPECT_NE(log(Linked).find("twice"), std::string::npos) << log(Linked);
}

TEST_F(Spirv, WhatIsNoModuleForOpenClIsNamed) {
  std::string Told;
  const cl::Context Watched(
      device(), nullptr,
      [](const char *Text, const void *, std::size_t, void *To) {
        *static_cast<std::string *>(To) = Text;
      },
      &Told);
  const auto Problem = [&](const Bytes &Module) {
    Told.clear();
    cl_int Status = CL_SUCCESS;
    EXPECT_EQ(create(Module, Status, Watched())(), nullptr);
    EXPECT_EQ(Status, CL_INVALID_VALUE);
    return Told;
  };
  EXPECT_EQ(Problem(module("vulkan")),
            "the module of SPIR-V is for Vulkan (capability Shader), expected "
            "one for OpenCL (capability Kernel)");
  EXPECT_EQ(Problem({'n', 'o'}),
            "2 bytes are no module of SPIR-V, expected its header");
  const Bytes Whole = module("spec");
  EXPECT_EQ(Problem({Whole.begin(), Whole.begin() + 30}),
            "the module of SPIR-V has 30 bytes, expected whole words of 4");
  EXPECT_EQ(Problem({Whole.begin(), Whole.begin() + 24}),
            "the module of SPIR-V is damaged: the instruction at byte 20 has 2 "
            "words, 1 are left");
  Bytes Zero = Whole;
  setWord(Zero, 5, 17);
  EXPECT_EQ(Problem(Zero), "the module of SPIR-V is damaged: the instruction "
                           "at byte 20 has 0 words, " +
                               std::to_string(Zero.size() / 4 - 5) +
                               " are left");
  cl_int Status = CL_SUCCESS;
  EXPECT_EQ(create({}, Status)(), nullptr);
  EXPECT_EQ(Status, CL_INVALID_VALUE);
}

/// Cuts between two instructions were found by the translator, or by nobody.
TEST_F(Spirv, AModuleThatIsCutOffAnywhereIsRefused) {
  for (const char *Name : {"spec", "shared", "kernels"}) {
    const Bytes Whole = module(Name);
    std::vector<std::size_t> Taken;
    for (std::size_t Size = 4; Size < Whole.size(); Size += 4) {
      cl_int Status = CL_SUCCESS;
      create({Whole.begin(), Whole.begin() + static_cast<long>(Size)}, Status);
      if (Status != CL_INVALID_VALUE)
        Taken.push_back(Size);
    }
    // Behind the memory model: an empty module.
    EXPECT_EQ(Taken.size(), 1U)
        << Name << ": " << testing::PrintToString(Taken);
  }
}

TEST_F(Spirv, WhatTheDeviceDoesNotOfferIsNamed) {
  EXPECT_NE(refusal(module("kernels64"))
                .find("the module's addresses are Physical64, the device's "
                      "have 32 bits"),
            std::string::npos);
  Bytes Later = module("spec");
  setWord(Later, 1, 0x10600);
  EXPECT_NE(
      refusal(Later).find("the module is of SPIR-V 1.6, expected 1.4 at most"),
      std::string::npos);
  Bytes Pipes = module("spec");
  constexpr std::size_t ThirdCapability = 10;
  setWord(Pipes, ThirdCapability, 17);
  EXPECT_NE(refusal(Pipes).find("needs the capability Pipes"),
            std::string::npos);
}

TEST_F(Spirv, WhatTheTranslatorSaysIsInTheLog) {
  Bytes Unknown = module("spec");
  const std::size_t Return = Unknown.size() / sizeof(uint32_t) - 2;
  setWord(Unknown, Return, 1U << 16 | 4000U);
  const std::string Log = refusal(Unknown);
  EXPECT_NE(Log.find("the module cannot be translated: "), std::string::npos)
      << Log;
  EXPECT_EQ(Log.find("PLEASE submit"), std::string::npos) << Log;
}

/// The translator is no child of the program, but of its compiler.
TEST_F(Spirv, ProgramsThatIgnoreTheirChildrenBuildModules) {
  const auto Before = std::signal(SIGCHLD, SIG_IGN);
  build(module("spec"));
  std::signal(SIGCHLD, Before);
}

TEST_F(Spirv, TheSizesOfSpecializationConstantsAreThoseOfTheirTypes) {
  cl_int Status = CL_SUCCESS;
  const cl::Program Program = create(module("spec-sizes"), Status);
  ASSERT_EQ(Status, CL_SUCCESS);
  const cl_ulong Value = 0;
  for (const auto &[Id, Size] : {std::pair<cl_uint, std::size_t>{1, 1},
                                 {2, 2},
                                 {3, 4},
                                 {4, 8},
                                 {5, 2},
                                 {6, 4},
                                 {7, 8},
                                 {8, 1},
                                 {9, 1}})
    for (const std::size_t Given : {1, 2, 4, 8})
      EXPECT_EQ(
          clSetProgramSpecializationConstant(Program(), Id, Given, &Value),
          Given == Size ? CL_SUCCESS : CL_INVALID_VALUE)
          << Id << ", " << Given << " bytes";
  EXPECT_EQ(clSetProgramSpecializationConstant(Program(), 10, 4, &Value),
            CL_INVALID_SPEC_ID);
}

} // namespace
