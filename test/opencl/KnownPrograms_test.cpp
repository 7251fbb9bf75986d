/// A program whose text was built before is taken from the kernel cache without
/// clang, and is in all that can be asked of it what clang and LLVM made of it.
/// What clang would have found otherwise is not taken.

#include "TestDevice.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

using vorion::test::TestDevice;

namespace {

/// CL_PROGRAM_BUILD_GLOBAL_VARIABLE_TOTAL_SIZE of OpenCL 2.0.
constexpr cl_program_build_info VariableBytes = 0x1185;

class KnownPrograms : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  /// No earlier run has built a text that ends so.
  static std::string unseen(const std::string &Source) {
    return Source + "\n// " + std::to_string(getpid()) + " " +
           std::to_string(
               std::chrono::steady_clock::now().time_since_epoch().count());
  }

  /// What kernel `f` writes.
  int result(const cl::Program &Program) const {
    cl::Kernel Kernel(Program, "f");
    const cl::Buffer Out = Device.upload(std::vector<int>{-1});
    Kernel.setArg(0, Out);
    Device.run(Kernel, 1, 1);
    return Device.download<int>(Out, 1)[0];
  }

  template <cl_kernel_arg_info Question>
  static auto argument(const cl::Kernel &Kernel, cl_uint Index) {
    cl_int Status = CL_SUCCESS;
    auto Answer = Kernel.getArgInfo<Question>(Index, &Status);
    EXPECT_EQ(Status, CL_SUCCESS) << "argument " << Index;
    return Answer;
  }

  /// All that can be asked of the program and its kernels.
  std::string description(const cl::Program &Program) const {
    std::string All = Program.getInfo<CL_PROGRAM_KERNEL_NAMES>();
    const cl::Device Of = Device.queue().getInfo<CL_QUEUE_DEVICE>();
    All += Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(Of);
    std::size_t Variables = 0;
    EXPECT_EQ(clGetProgramBuildInfo(Program(), Of(), VariableBytes,
                                    sizeof(Variables), &Variables, nullptr),
              CL_SUCCESS);
    All += " " + std::to_string(Variables);
    std::vector<cl::Kernel> Kernels;
    cl::Program(Program).createKernels(&Kernels);
    for (const cl::Kernel &Kernel : Kernels) {
      All +=
          "\n" + Kernel.getInfo<CL_KERNEL_FUNCTION_NAME>() + " " +
          Kernel.getInfo<CL_KERNEL_ATTRIBUTES>() + " " +
          std::to_string(Kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(Of));
      for (const auto Size :
           Kernel.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(Of))
        All += " " + std::to_string(Size);
      for (cl_uint I = 0; I != Kernel.getInfo<CL_KERNEL_NUM_ARGS>(); ++I)
        All +=
            "; " + argument<CL_KERNEL_ARG_TYPE_NAME>(Kernel, I) + " " +
            argument<CL_KERNEL_ARG_NAME>(Kernel, I) + " " +
            std::to_string(
                argument<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(Kernel, I)) +
            " " +
            std::to_string(
                argument<CL_KERNEL_ARG_ACCESS_QUALIFIER>(Kernel, I)) +
            " " +
            std::to_string(argument<CL_KERNEL_ARG_TYPE_QUALIFIER>(Kernel, I));
    }
    return All;
  }

  const TestDevice Device;
};

TEST_F(KnownPrograms, AreDescribedAsWhenTheyWereMade) {
  const std::string Source = unseen(R"(
#warning seen
global int counter[3];
kernel __attribute__((reqd_work_group_size(4, 2, 1)))
__attribute__((vec_type_hint(float4)))
void required(constant const float *restrict table, local int *part,
              read_only image2d_t from, write_only image1d_array_t to,
              sampler_t how, global volatile uint *out, float3 scale) {
  local short own[7];
  own[get_local_id(0)] = part[0];
  out[0] = own[0] + counter[0];
}
kernel __attribute__((work_group_size_hint(8, 1, 1))) void f(global int *out) {
  *out = ++counter[1];
}
kernel void nothing() {}
)");
  const char *Options = "-cl-std=CL3.0 -cl-kernel-arg-info";
  const cl::Program Made = Device.build(Source, Options);
  const std::string Expected = description(Made);
  EXPECT_NE(Expected.find("warning: seen"), std::string::npos) << Expected;
  EXPECT_EQ(result(Made), 1);
  const cl::Program Known = Device.build(Source, Options);
  EXPECT_EQ(description(Known), Expected);
  EXPECT_EQ(result(Known), 1) << "variables begin anew";
}

TEST_F(KnownPrograms, GiveOtherKernelsThanThoseThatRanBefore) {
  const std::string Source =
      unseen("kernel void g(global int *o) { *o = 1; }\n"
             "kernel void f(global int *o) { *o = get_local_size(0) + 1; }");
  Device.build(Source);
  EXPECT_EQ(result(Device.build(Source)), 2)
      << "no group of it was compiled before";
}

TEST_F(KnownPrograms, AreThoseOfTheirOptions) {
  const std::string Source = unseen("kernel void f(global int *o) { *o = N; }");
  for (const char *Options : {"-DN=1", "-DN=2", "-DN=1"})
    EXPECT_EQ(result(Device.build(Source, Options)), Options[4] - '0');
}

TEST_F(KnownPrograms, CanBeLinkedAndGivenAsBinaries) {
  const std::string Source =
      unseen("kernel void f(global int *o) { *o = 11; }");
  Device.build(Source);
  const cl::Program Known = Device.build(Source);
  const auto Binaries = Known.getInfo<CL_PROGRAM_BINARIES>();
  const cl::Device Of = Device.queue().getInfo<CL_QUEUE_DEVICE>();
  cl::Program Loaded(Device.context(), {Of}, Binaries);
  EXPECT_EQ(Loaded.build(), CL_SUCCESS);
  EXPECT_EQ(result(Loaded), 11);

  cl::Program Part(Device.context(), Source);
  for (int Time = 0; Time != 2; ++Time) {
    EXPECT_EQ(Part.compile(), CL_SUCCESS);
    EXPECT_EQ(result(cl::linkProgram({Part})), 11);
  }
}

/// A file of the program's own may change while its text does not.
TEST_F(KnownPrograms, ReadTheirOwnFilesAgain) {
  namespace fs = std::filesystem;
  const fs::path Folder = fs::temp_directory_path() /
                          ("known-programs-" + std::to_string(getpid()));
  fs::create_directories(Folder);
  const std::string Options = "-I" + Folder.string();
  int Number = 0;
  for (const char *Include :
       {"#include \"own.h\"", "#include <own.h>", " # /**/ include \"own.h\"",
        "#inc\\\nlude \"own.h\"", "#define OWN \"own.h\"\n#include OWN",
        "#include <vorion.h>\n#include \"own.h\"",
        "#if __has_include(<later.h>)\n#include \"own.h\"\n#else\n"
        "#define VALUE 0\n#endif"}) {
    const std::string Source =
        unseen(std::string(Include) +
               "\nkernel void f(global int *o) { *o = VALUE; }");
    if (std::string(Include).find("later.h") != std::string::npos) {
      EXPECT_EQ(result(Device.build(Source, Options.c_str())), 0);
      std::ofstream(Folder / "later.h") << "\n";
    }
    for (int Time = 0; Time != 2; ++Time) {
      // Of the same length each time, and perhaps of the same time.
      std::ofstream(Folder / "own.h")
          << "#define VALUE " << 10 + ++Number << "\n";
      EXPECT_EQ(result(Device.build(Source, Options.c_str())), 10 + Number)
          << Include;
    }
  }
  fs::remove_all(Folder);
}

/// A build in another second gives another program, also if only an option or
/// two halves of a word ask for the time.
TEST_F(KnownPrograms, AskForTheTimeAgain) {
  struct {
    const char *Text, *Options;
  } constexpr Asking[] = {
      {"constant char text[] = __TIME__;", ""},
      {"constant char text[] = T;", "-DT=__TIME__"},
      {"#define JOIN(a, b) a##b\nconstant char text[] = JOIN(__TI, ME__);", ""},
      {"constant char text[] = __DATE__ __TIME__;", ""},
  };
  // Minutes and seconds, as digits.
  const std::string Kernel = unseen(R"(
kernel void f(global int *o) {
  const int end = sizeof(text) - 1;
  *o = (text[end - 5] * 10 + text[end - 4]) * 100 + text[end - 2] * 10 +
       text[end - 1];
})");
  std::vector<int> Before;
  for (const auto &[Text, Options] : Asking)
    Before.push_back(result(Device.build(Text + Kernel, Options)));
  const std::time_t Built = std::time(nullptr);
  while (std::time(nullptr) == Built)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (size_t I = 0; I < std::size(Asking); ++I)
    EXPECT_NE(result(Device.build(Asking[I].Text + Kernel, Asking[I].Options)),
              Before[I])
        << Asking[I].Text << Asking[I].Options;
}

} // namespace
