/// What building, compiling and linking programs says when something is wrong:
/// the standard's codes, the log, and the functions that wait for the end.

#include "TestDevice.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <vector>

using vorion::test::TestDevice;

namespace {

constexpr const char *Good = "kernel void f(global int *o) { o[0] = 1; }";
constexpr const char *Wrong = "kernel void f(global int *o) {\n"
                              "  o[0] = nowhere;\n"
                              "  o[1] = 1 +;\n"
                              "}\n";

/// Counts how often it was told, and of which program.
struct Listener {
  static void CL_CALLBACK hear(cl_program Program, void *Data) {
    auto *To = static_cast<Listener *>(Data);
    ++To->Calls;
    To->Last = Program;
  }
  int Calls = 0;
  cl_program Last = nullptr;
};

class Builds : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  cl_device_id device() const {
    return Device.queue().getInfo<CL_QUEUE_DEVICE>()();
  }
  cl::Program program(const char *Source) const {
    return {Device.context(), std::string(Source)};
  }
  std::string log(const cl::Program &Program) const {
    return Program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(cl::Device(device()));
  }
  cl_build_status status(const cl::Program &Program) const {
    return Program.getBuildInfo<CL_PROGRAM_BUILD_STATUS>(cl::Device(device()));
  }
  cl_int build(const cl::Program &Program, const char *Options = "") const {
    return clBuildProgram(Program(), 0, nullptr, Options, nullptr, nullptr);
  }
  cl_int compile(const cl::Program &Program, const char *Options = "") const {
    return clCompileProgram(Program(), 0, nullptr, Options, 0, nullptr, nullptr,
                            nullptr, nullptr);
  }
  /// What one work-item of kernel `f` leaves in its only argument, zeros at
  /// first.
  template <typename T>
  std::vector<T> resultOf(const cl::Program &Program, size_t Count) const {
    cl::Kernel Kernel(Program, "f");
    const cl::Buffer Out = Device.upload(std::vector<T>(Count));
    Kernel.setArg(0, Out);
    Device.run(Kernel, 1, 1);
    return Device.download<T>(Out, Count);
  }
  /// The program of a link, perhaps none.
  cl::Program link(const std::vector<cl_program> &Inputs, const char *Options,
                   cl_int &Status) const {
    return cl::Program(clLinkProgram(Device.context()(), 0, nullptr, Options,
                                     static_cast<cl_uint>(Inputs.size()),
                                     Inputs.data(), nullptr, nullptr, &Status));
  }

  const TestDevice Device;
};

TEST_F(Builds, WrongArgumentsHaveTheirCodes) {
  const cl::Program P = program(Good);
  const cl_device_id D = device();
  int Data = 0;
  const auto Build = [](cl_program Program, cl_uint Count,
                        const cl_device_id *Devices, void *User) {
    return clBuildProgram(Program, Count, Devices, "", nullptr, User);
  };
  EXPECT_EQ(Build(nullptr, 0, nullptr, nullptr), CL_INVALID_PROGRAM);
  EXPECT_EQ(Build(P(), 1, nullptr, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Build(P(), 0, &D, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Build(P(), 0, nullptr, &Data), CL_INVALID_VALUE);

  const cl_program Header = P();
  const char *Name = "p.h";
  const auto Compile = [&](cl_uint Count, const cl_program *Headers,
                           const char **Names, void *User) {
    return clCompileProgram(P(), 0, nullptr, "", Count, Headers, Names, nullptr,
                            User);
  };
  EXPECT_EQ(Compile(1, nullptr, &Name, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Compile(1, &Header, nullptr, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Compile(0, &Header, nullptr, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Compile(0, nullptr, &Name, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Compile(0, nullptr, nullptr, &Data), CL_INVALID_VALUE);

  ASSERT_EQ(compile(P), CL_SUCCESS);
  const cl_program Input = P();
  const auto Link = [&](cl_context Context, cl_uint Devices,
                        const cl_device_id *List, cl_uint Count,
                        const cl_program *Inputs, void *User) {
    cl_int Status = CL_SUCCESS;
    EXPECT_EQ(clLinkProgram(Context, Devices, List, "", Count, Inputs, nullptr,
                            User, &Status),
              nullptr);
    return Status;
  };
  const cl_context C = Device.context()();
  EXPECT_EQ(Link(nullptr, 0, nullptr, 1, &Input, nullptr), CL_INVALID_CONTEXT);
  EXPECT_EQ(Link(C, 1, nullptr, 1, &Input, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Link(C, 0, &D, 1, &Input, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Link(C, 0, nullptr, 0, &Input, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Link(C, 0, nullptr, 1, nullptr, nullptr), CL_INVALID_VALUE);
  EXPECT_EQ(Link(C, 0, nullptr, 1, &Input, &Data), CL_INVALID_VALUE);
  const cl_program Nothing = nullptr;
  EXPECT_EQ(Link(C, 0, nullptr, 1, &Nothing, nullptr), CL_INVALID_PROGRAM);
  const cl::Program Source = program(Good);
  const cl_program Uncompiled = Source();
  EXPECT_EQ(Link(C, 0, nullptr, 1, &Uncompiled, nullptr), CL_INVALID_OPERATION);
}

TEST_F(Builds, ACompilerThatGivesNoAnswerIsEnded) {
  const std::string Folder = testing::TempDir() + "never";
  std::filesystem::create_directory(Folder);
  mkfifo((Folder + "/never.h").c_str(), 0600); // which nobody writes
  setenv("VORION_COMPILE_SECONDS", "1", 1);
  cl::Program P = program("#include \"never.h\"\n");
  EXPECT_EQ(build(P, ("-I" + Folder).c_str()), CL_BUILD_PROGRAM_FAILURE);
  unsetenv("VORION_COMPILE_SECONDS");
  EXPECT_TRUE(log(P).starts_with("the compiler gave no answer in 1 s"))
      << log(P);
  EXPECT_EQ(program(Good).build(), CL_SUCCESS);
  std::filesystem::remove_all(Folder);
}

TEST_F(Builds, APartThatIsInUseOrHasNoSourceIsNotBuiltAgain) {
  const cl::Program P = program(Good);
  ASSERT_EQ(build(P), CL_SUCCESS);
  {
    const cl::Kernel Kernel(P, "f");
    EXPECT_EQ(build(P), CL_INVALID_OPERATION);
    EXPECT_EQ(compile(P), CL_INVALID_OPERATION);
  }
  EXPECT_EQ(build(P), CL_SUCCESS);
  const cl::Program Binary(Device.context(), {cl::Device(device())},
                           P.getInfo<CL_PROGRAM_BINARIES>());
  EXPECT_EQ(compile(Binary), CL_INVALID_OPERATION);
  EXPECT_EQ(build(Binary), CL_SUCCESS);
}

/// A program's binary, as the platform gives it.
std::vector<unsigned char> binaryOf(const cl::Program &P) {
  return P.getInfo<CL_PROGRAM_BINARIES>().front();
}

/// Programs that keep binaries ask for them right after each build. Compiling
/// every kernel for that took minutes where there are a hundred.
TEST_F(Builds, ABinaryHasNoKernelThatWasNotStarted) {
  const cl::Program P =
      program("kernel void unstarted(global int *o) { o[0] = 1; }");
  ASSERT_EQ(build(P), CL_SUCCESS);
  const std::vector<unsigned char> Binary = binaryOf(P);
  ASSERT_FALSE(Binary.empty());
  const std::string Elf = "\x7f"
                          "ELF";
  EXPECT_EQ(std::search(Binary.begin(), Binary.end(), Elf.begin(), Elf.end()),
            Binary.end());
}

TEST_F(Builds, ABinaryRunsInGroupsOfAnySize) {
  constexpr cl_uint Items = 40;
  const cl::Program P =
      program("kernel void two(global uint *o) { o[get_global_id(0)] = 2; }");
  ASSERT_EQ(build(P), CL_SUCCESS);
  const cl::Program Again(Device.context(), {cl::Device(device())},
                          {binaryOf(P)});
  ASSERT_EQ(build(Again), CL_SUCCESS);
  cl::Kernel Kernel(Again, "two");
  for (const cl_uint Size : {1U, 8U, 20U}) {
    const cl::Buffer Out = Device.upload(std::vector<cl_uint>(Items));
    Kernel.setArg(0, Out);
    Device.run(Kernel, Items, Size);
    EXPECT_EQ(Device.download<cl_uint>(Out, Items),
              std::vector<cl_uint>(Items, 2));
  }
}

// Names of parameters, and of a function, in clang's opencl-c.h.
TEST_F(Builds, AMacroOfTheProgramDoesNotReachTheHeaders) {
  const std::string Source = "kernel void f(global uint *o) {\n"
                             "  o[0] = offset + data + p;\n"
                             "  o[1] = popcount(1u << 20);\n"
                             "}\n";
  const cl::Program P = program(Source.c_str());
  ASSERT_EQ(build(P, "-Doffset=1 -D data=20 -D\"p=300\" -Dpopcount=clz"),
            CL_SUCCESS)
      << log(P);
  EXPECT_EQ(resultOf<cl_uint>(P, 2), (std::vector<cl_uint>{321, 11}));
}

// Programs write options as for a shell.
TEST_F(Builds, ABackslashHidesSpacesAndQuotesOfOptions) {
  const std::string Source =
      "#define TEXT_OF(x) #x\n"
      "#define TEXT(x) TEXT_OF(x)\n"
      "kernel void f(global char *o) {\n"
      "  constant char *Texts[] = {TEXT(A), TEXT(B), C, D};\n"
      "  for (int t = 0, n = 0; t < 4; t++)\n"
      "    for (int i = 0;; i++) {\n"
      "      o[n++] = Texts[t][i] ? Texts[t][i] : '|';\n"
      "      if (!Texts[t][i]) break;\n"
      "    }\n"
      "}\n";
  const cl::Program P = program(Source.c_str());
  ASSERT_EQ(build(P, "-D A=a\\ b -DB=\"c d\" -DC=\\\"e\\ f\\\" "
                     "-D \"D=\\\"g\\\\n h\\\"\""),
            CL_SUCCESS)
      << log(P);
  const std::vector<char> Text = resultOf<char>(P, 17);
  EXPECT_EQ(std::string(Text.begin(), Text.end()), "a b|c d|e f|g\n h|");
}

// What is kept of the headers is kept for each set of options that changes
// them.
TEST_F(Builds, OptionsThatTheHeadersSeeAreSeen) {
  const std::string Source = "kernel void f(global int *o) {\n"
                             "#ifdef cl_khr_fp64\n"
                             "  o[0] = 1;\n"
                             "#endif\n"
                             "#ifdef __FAST_RELAXED_MATH__\n"
                             "  o[0] |= 2;\n"
                             "#endif\n"
                             "#ifdef __opencl_c_images\n"
                             "  o[0] |= 4;\n"
                             "#endif\n"
                             "}\n";
  const std::pair<const char *, int> Cases[] = {
      {"", 1},
      {"-cl-fast-relaxed-math", 3},
      {"-cl-std=CL3.0", 5},
      {"-Dcl_khr_fp64=1", 1},
      {"-cl-std=CL3.0 -w -g -cl-fast-relaxed-math -cl-opt-disable", 7}};
  for (const auto &[Options, Expected] : Cases)
    for (const bool Again : {false, true}) {
      const cl::Program P = program(Source.c_str());
      ASSERT_EQ(build(P, Options), CL_SUCCESS) << Options << log(P);
      EXPECT_EQ(resultOf<cl_int>(P, 1)[0], Expected) << Options << Again;
    }
}

TEST_F(Builds, UnknownOptionsAreNamed) {
  const cl::Program P = program(Good);
  for (const char *Option :
       {"-cl-fast", "-cl-std=CL9.9", "-wall", "-foo", "-create-library",
        "-enable-link-options", "stray"}) {
    EXPECT_EQ(build(P, Option), CL_INVALID_BUILD_OPTIONS) << Option;
    EXPECT_NE(log(P).find(Option), std::string::npos) << log(P);
    EXPECT_EQ(compile(P, Option), CL_INVALID_COMPILER_OPTIONS) << Option;
    EXPECT_NE(log(P).find(Option), std::string::npos) << log(P);
  }
  EXPECT_EQ(build(P, "-D"), CL_INVALID_BUILD_OPTIONS);
  ASSERT_EQ(compile(P), CL_SUCCESS);
  for (const char *Option : {"-cl-fast", "-DX", "-I.", "-w", "-g", "-foo",
                             "-cl-mad-enable", "-enable-link-options"}) {
    cl_int Status = CL_SUCCESS;
    EXPECT_EQ(link({P()}, Option, Status)(), nullptr) << Option;
    EXPECT_EQ(Status, CL_INVALID_LINKER_OPTIONS) << Option;
  }
  for (const char *Option : {"-cl-fast-relaxed-math", "-create-library",
                             "-create-library -enable-link-options "
                             "-cl-fast-relaxed-math"}) {
    cl_int Status = CL_INVALID_VALUE;
    EXPECT_NE(link({P()}, Option, Status)(), nullptr) << Option;
    EXPECT_EQ(Status, CL_SUCCESS) << Option;
  }
  cl_int Status = CL_SUCCESS;
  EXPECT_EQ(link({P()}, "-create-library -cl-fast-relaxed-math", Status)(),
            nullptr);
  EXPECT_EQ(Status, CL_INVALID_LINKER_OPTIONS);
}

// Only the linker knows what inline assembly calls.
TEST_F(Builds, TheLogNamesTheKernelThatCannotBeLinked) {
  const cl::Program P =
      program("kernel void f() { __asm__ volatile(\"call missing\"); }\n");
  ASSERT_EQ(build(P), CL_SUCCESS);
  const cl::Kernel Kernel(P, "f");
  cl::Event Done;
  ASSERT_EQ(Device.queue().enqueueNDRangeKernel(Kernel, cl::NullRange, 1, 1,
                                                nullptr, &Done),
            CL_SUCCESS);
  EXPECT_NE(Done.wait(), CL_SUCCESS);
  for (const char *Named : {"kernel f: cannot be linked",
                            "undefined symbol: missing", "kernel f:(f)"})
    EXPECT_NE(log(P).find(Named), std::string::npos) << log(P);
}

TEST_F(Builds, TheLogHasEveryErrorWithItsLineAndPlace) {
  const cl::Program P = program(Wrong);
  const auto Check = [&] {
    const std::string Log = log(P);
    EXPECT_EQ(status(P), CL_BUILD_ERROR);
    EXPECT_NE(Log.find(":2:10: error: use of undeclared identifier 'nowhere'\n"
                       "    2 |   o[0] = nowhere;\n"
                       "      |          ^\n"),
              std::string::npos)
        << Log;
    EXPECT_NE(Log.find(":3:13: error: expected expression"), std::string::npos)
        << Log;
  };
  EXPECT_EQ(build(P), CL_BUILD_PROGRAM_FAILURE);
  Check();
  EXPECT_EQ(compile(P), CL_COMPILE_PROGRAM_FAILURE);
  Check();
}

TEST_F(Builds, KernelsAreMadeOfLinkedProgramsOnly) {
  const cl::Program Compiled = program(Good);
  ASSERT_EQ(compile(Compiled), CL_SUCCESS);
  const cl_program Input = Compiled();
  cl_int Status = CL_INVALID_VALUE;
  const cl::Program Library(clLinkProgram(Device.context()(), 0, nullptr,
                                          "-create-library", 1, &Input, nullptr,
                                          nullptr, &Status));
  ASSERT_EQ(Status, CL_SUCCESS);
  for (const cl_program P : {Compiled(), Library()}) {
    EXPECT_EQ(clCreateKernel(P, "f", &Status), nullptr);
    EXPECT_EQ(Status, CL_INVALID_PROGRAM_EXECUTABLE);
    cl_uint Number = 0;
    EXPECT_EQ(clCreateKernelsInProgram(P, 0, nullptr, &Number),
              CL_INVALID_PROGRAM_EXECUTABLE);
    for (const cl_program_info What :
         {CL_PROGRAM_NUM_KERNELS, CL_PROGRAM_KERNEL_NAMES})
      EXPECT_EQ(clGetProgramInfo(P, What, 0, nullptr, nullptr),
                CL_INVALID_PROGRAM_EXECUTABLE)
          << What;
  }
  const cl_program Part = Library();
  const cl::Program Linked(clLinkProgram(Device.context()(), 0, nullptr, "", 1,
                                         &Part, nullptr, nullptr, &Status));
  ASSERT_EQ(Status, CL_SUCCESS);
  EXPECT_EQ(Linked.getInfo<CL_PROGRAM_KERNEL_NAMES>(), "f");
}

// As from a header that both include; one has it without `inline`.
TEST_F(Builds, LinkedProgramsMayHaveTheSameInlineFunction) {
  const std::string Function = "int next(int x) { return x + 1; }\n";
  for (const char *Options : {"", "-cl-opt-disable"})
    for (const char *Word : {"inline ", "__inline__ ", ""}) {
      const cl::Program One = program(
          ("inline " + Function +
           "int other(int x); kernel void f(global int *o) { *o = next(*o) + "
           "other(*o); }")
              .c_str());
      const cl::Program Two =
          program((Word + Function + "int other(int x) { return 2 * next(x); }")
                      .c_str());
      ASSERT_EQ(compile(One, Options), CL_SUCCESS) << log(One);
      ASSERT_EQ(compile(Two, Options), CL_SUCCESS) << log(Two);
      cl_int Status = CL_SUCCESS;
      const cl::Program Linked = link({One(), Two()}, "", Status);
      ASSERT_EQ(Status, CL_SUCCESS) << Word << log(Linked);
      const auto Buffer = Device.upload(std::vector<int32_t>{20});
      cl::Kernel Kernel(Linked, "f");
      Kernel.setArg(0, Buffer);
      Device.run(Kernel, cl::NDRange(1), cl::NDRange(1));
      EXPECT_EQ(Device.download<int32_t>(Buffer, 1)[0], 63);
    }
}

TEST_F(Builds, AFailedLinkHasAProgramWithALog) {
  const cl::Program Caller = program(
      "int other(int); kernel void f(global int *o) { *o = other(1); }");
  const cl::Program Twice = program(Good);
  const cl::Program Again = program(Good);
  for (const cl::Program &P : {Caller, Twice, Again})
    ASSERT_EQ(compile(P), CL_SUCCESS);
  const auto Check = [&](const std::vector<cl_program> &Inputs,
                         const char *Named) {
    cl_int Status = CL_SUCCESS;
    const cl::Program Linked = link(Inputs, "", Status);
    EXPECT_EQ(Status, CL_LINK_PROGRAM_FAILURE);
    ASSERT_NE(Linked(), nullptr);
    EXPECT_EQ(status(Linked), CL_BUILD_ERROR);
    EXPECT_NE(log(Linked).find(Named), std::string::npos) << log(Linked);
    cl_int Made = CL_SUCCESS;
    EXPECT_EQ(clCreateKernel(Linked(), "f", &Made), nullptr);
    EXPECT_EQ(Made, CL_INVALID_PROGRAM_EXECUTABLE);
  };
  Check({Caller()}, "other");
  Check({Twice(), Again()}, "'f'");
}

TEST_F(Builds, WhoWaitsIsToldOnceOfWhatBegan) {
  Listener Heard;
  const auto Expect = [&](int Calls, cl_program Program) {
    EXPECT_EQ(Heard.Calls, Calls);
    EXPECT_EQ(Heard.Last, Program);
    Heard = {};
  };
  const auto Build = [&](cl_program Program) {
    return clBuildProgram(Program, 0, nullptr, "", Listener::hear, &Heard);
  };
  const cl::Program Right = program(Good);
  const cl::Program Bad = program(Wrong);
  EXPECT_EQ(Build(Right()), CL_SUCCESS);
  Expect(1, Right());
  EXPECT_EQ(Build(Bad()), CL_BUILD_PROGRAM_FAILURE);
  Expect(1, Bad());
  EXPECT_EQ(Build(nullptr), CL_INVALID_PROGRAM);
  Expect(0, nullptr);
  EXPECT_EQ(clCompileProgram(Right(), 0, nullptr, "", 0, nullptr, nullptr,
                             Listener::hear, &Heard),
            CL_SUCCESS);
  Expect(1, Right());
  const cl_program Input = Right();
  cl_int Status = CL_INVALID_VALUE;
  const cl::Program Linked(clLinkProgram(Device.context()(), 0, nullptr, "", 1,
                                         &Input, Listener::hear, &Heard,
                                         &Status));
  EXPECT_EQ(Status, CL_SUCCESS);
  Expect(1, Linked());
  EXPECT_EQ(clLinkProgram(Device.context()(), 0, nullptr, "", 0, nullptr,
                          Listener::hear, &Heard, &Status),
            nullptr);
  EXPECT_EQ(Status, CL_INVALID_VALUE);
  Expect(0, nullptr);
}

TEST_F(Builds, TheOptionsThatWereGivenAreReturned) {
  const cl::Program P = program(Good);
  constexpr const char *Options = "-DA=1 -cl-denorms-are-zero -cl-mad-enable";
  ASSERT_EQ(build(P, Options), CL_SUCCESS);
  EXPECT_EQ(P.getBuildInfo<CL_PROGRAM_BUILD_OPTIONS>(cl::Device(device())),
            Options);
}

TEST_F(Builds, NoContextWithoutADeviceOfTheType) {
  const cl::Platform Platform(
      cl::Device(device()).getInfo<CL_DEVICE_PLATFORM>());
  const std::vector<cl_context_properties> Properties = {
      CL_CONTEXT_PLATFORM, reinterpret_cast<cl_context_properties>(Platform()),
      0};
  cl_int Status = CL_SUCCESS;
  EXPECT_EQ(clCreateContextFromType(Properties.data(),
                                    CL_DEVICE_TYPE_ACCELERATOR, nullptr,
                                    nullptr, &Status),
            nullptr);
  EXPECT_EQ(Status, CL_DEVICE_NOT_FOUND);
}

TEST_F(Builds, BinariesThatAreBuiltAgainKeepTheirOwnKernels) {
  // Their kernels have one name, and once had one place in the cache, too.
  for (const int Number : {1, 2}) {
    const cl::Program Source = Device.build(
        "kernel void f(global int *o) { o[0] = " + std::to_string(Number) +
        "; }");
    const std::vector<int32_t> Expected{Number};
    EXPECT_EQ(resultOf<int32_t>(Source, 1), Expected);
    const auto Binaries = Source.getInfo<CL_PROGRAM_BINARIES>();
    const cl::Program Program(Device.context(), {cl::Device(device(), true)},
                              {Binaries.front()});
    for (int Time = 0; Time < 2; ++Time) {
      EXPECT_EQ(build(Program), CL_SUCCESS);
      EXPECT_EQ(resultOf<int32_t>(Program, 1), Expected) << Time;
    }
  }
}

} // namespace
