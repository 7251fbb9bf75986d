/// Variables of program scope: all kernels of a program share them, and they
/// stay from launch to launch.

#include "TestDevice.h"

#include <cstdint>
#include <thread>

using vorion::test::TestDevice;

namespace {

// Of OpenCL 2.0, which the header names to programs for it only.
constexpr cl_device_info MaxVariableSize = 0x104D;
constexpr cl_device_info PreferredTotalSize = 0x1054;
constexpr cl_program_build_info TotalSize = 0x1185;

class ProgramScope : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  cl::Program build(const std::string &Source) const {
    return Device.build(Source, "-cl-std=CL3.0");
  }
  /// What \p Items work-items of \p Name leave in its one argument.
  std::vector<int32_t> run(const cl::Program &Program, const char *Name,
                           std::size_t Items = 1) const {
    cl::Kernel Kernel(Program, Name);
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                         Items * sizeof(int32_t));
    Kernel.setArg(0, Out);
    Device.run(Kernel, Items, Items);
    return Device.download<int32_t>(Out, Items);
  }
  cl_device_id device() const {
    return Device.queue().getInfo<CL_QUEUE_DEVICE>()();
  }

  const TestDevice Device;
};

constexpr const char *Counter = R"(
global int count = 40;
kernel void add(global int *out) { out[0] = atomic_add(&count, 1); }
kernel void look(global int *out) { out[0] = count; }
)";

TEST_F(ProgramScope, AVariableStaysBetweenLaunchesAndKernels) {
  const cl::Program Program = build(Counter);
  EXPECT_EQ(run(Program, "add"), std::vector<int32_t>{40});
  EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{41});
  EXPECT_EQ(run(Program, "add"), std::vector<int32_t>{41});
  EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{42});
}

TEST_F(ProgramScope, ProgramsOfOneSourceDoNotShare) {
  const cl::Program First = build(Counter), Second = build(Counter);
  run(First, "add");
  run(First, "add");
  EXPECT_EQ(run(First, "look"), std::vector<int32_t>{42});
  EXPECT_EQ(run(Second, "look"), std::vector<int32_t>{40});
}

TEST_F(ProgramScope, ABuildBeginsAnew) {
  const cl::Program Program = build(Counter);
  run(Program, "add");
  ASSERT_EQ(Program.build("-cl-std=CL3.0"), CL_SUCCESS);
  EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{40});
}

TEST_F(ProgramScope, ABinaryHasItsVariables) {
  const cl::Program Source = build(Counter);
  run(Source, "add");
  const auto Binaries = Source.getInfo<CL_PROGRAM_BINARIES>();
  const cl::Program Program(Device.context(), {cl::Device(device(), true)},
                            {Binaries.front()});
  for (int Time = 0; Time < 2; ++Time) {
    ASSERT_EQ(Program.build(), CL_SUCCESS);
    EXPECT_EQ(run(Program, "add"), std::vector<int32_t>{40});
    EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{41});
  }
}

TEST_F(ProgramScope, VariablesBeginAsTheirInitializersSay) {
  const cl::Program Program = build(R"(
#pragma OPENCL EXTENSION cl_khr_fp16 : enable
typedef struct { char tag; double d; short s[3]; float4 v; } record;
global record records[2] = {{1, 2.5, {3, 4}, (float4)(1, 2, 3, 4)}, {.tag = 9}};
global char3 text[] = {(char3)(1, 2, 3), (char3)(4)};
global bool yes = true;
global half h = 1.5h;
global ulong wide = 0x123456789ABCDEF0;
int nothing[1000];
static global uchar bytes[8] = "abc";
kernel void look(global int *out) {
  bool good[] = {
      records[0].tag == 1 && records[0].d == 2.5 && records[0].s[1] == 4,
      records[0].s[2] == 0 && records[0].v.w == 4.0f,
      records[1].tag == 9 && records[1].d == 0 && records[1].v.x == 0,
      text[0].z == 3 && text[1].x == 4, yes, h == 1.5h,
      wide == 0x123456789ABCDEF0, bytes[2] == 'c' && bytes[3] == 0};
  int zeros = 0;
  for (int i = 0; i < 1000; ++i)
    zeros += nothing[i] == 0;
  out[0] = zeros;
  for (int i = 0; i < sizeof(good); ++i)
    out[0] += good[i] << (10 + i);
}
kernel void change(global int *out) {
  records[1].v.x = bytes[2] = yes = h = wide = text[0].z = nothing[7] = 0;
  out[0] = 0;
}
)");
  EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{1000 + (0xFF << 10)});
}

TEST_F(ProgramScope, SpecialNumbersAreConstants) {
  const cl::Program Program = build(R"(
#pragma OPENCL EXTENSION cl_khr_fp16 : enable
constant float alone = NAN;
constant float some[] = {NAN, INFINITY, -HUGE_VALF, MAXFLOAT, -NAN};
constant float4 vectors[1] = {(float4)(NAN, 1.0f, -INFINITY, NAN)};
constant double wide[] = {NAN, HUGE_VAL};
constant struct { int i; float f[2]; } record = {1, {2.0f, NAN}};
global half narrow = NAN;
float variable = NAN;
kernel void look(global int *out) {
  static constant float own[] = {1.0f, NAN};
  const float mine[] = {NAN, 1.0f};
  int i = get_global_id(0) & 1;
  int good[] = {isnan(alone), isnan(some[i]), some[i + 1] == INFINITY,
                some[i + 2] == -INFINITY, some[i + 3] == FLT_MAX,
                isnan(some[i + 4]), isnan(vectors[i].x),
                isinf(vectors[i].z) && isnan(vectors[i].w),
                isnan(wide[i]) && isinf(wide[i + 1]), isnan(record.f[i + 1]),
                isnan(narrow), isnan(variable), isnan(own[i + 1]),
                isnan(mine[i])};
  out[0] = 0;
  for (int k = 0; k < 14; ++k)
    out[0] |= !!good[k] << k;
}
)");
  EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{(1 << 14) - 1});
}

TEST_F(ProgramScope, PointersGoToOtherVariables) {
  const cl::Program Program = build(R"(
global int numbers[4] = {10, 20, 30, 40};
constant int table[] = {7, 8, 9};
global int *global second = &numbers[1];
global int *constant last = numbers + 3;
constant int *global from_table = table + 2;
global struct node { int value; global struct node *next; } list[3] = {
    {1, list + 2}, {2, 0}, {3, list + 1}};
global void *own = &own;
kernel void follow(global int *out) {
  out[0] = *second;
  out[1] = *last;
  out[2] = *from_table;
  out[3] = list[0].next->next->value;
  out[4] = own == &own;
}
kernel void change(global int *out) {
  *second = 21;
  *last = 41;
  second = last;
  from_table = table;
  list[1].value = 5;
  out[0] = numbers[1];
}
)");
  const auto First = run(Program, "follow", 5);
  EXPECT_EQ(First, (std::vector<int32_t>{20, 40, 9, 2, 1}));
  EXPECT_EQ(run(Program, "change"), std::vector<int32_t>{21});
  EXPECT_EQ(run(Program, "follow", 5), (std::vector<int32_t>{41, 41, 7, 5, 1}));
}

TEST_F(ProgramScope, AFunctionsOwnVariableIsOne) {
  const cl::Program Program = build(R"(
int next(void) {
  static global int number = 5;
  return number++;
}
kernel void first(global int *out) { out[0] = next() * 100 + next(); }
kernel void second(global int *out) { out[0] = next(); }
)");
  EXPECT_EQ(run(Program, "first"), std::vector<int32_t>{506});
  EXPECT_EQ(run(Program, "second"), std::vector<int32_t>{7});
}

/// Local variables are told from those of the program, and groups of several
/// passes keep the variables' address across barriers.
TEST_F(ProgramScope, GroupsShareThemAcrossBarriers) {
  const cl::Program Program = build(R"(
global uint seen[64];
global uint sum;
kernel void gather(global int *out) {
  local uint turned[64];
  size_t i = get_local_id(0);
  seen[i] += i;
  turned[63 - i] = i;
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  atomic_add(&sum, seen[63 - i] + turned[i]);
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  out[i] = sum;
}
)");
  constexpr int32_t Once = 64 * 63 / 2;
  EXPECT_EQ(run(Program, "gather", 64), std::vector<int32_t>(64, 2 * Once));
  EXPECT_EQ(run(Program, "gather", 64), std::vector<int32_t>(64, 5 * Once));
}

TEST_F(ProgramScope, LinkedPartsShareThem) {
  const auto Compile = [&](const char *Source) {
    cl::Program Part(Device.context(), std::string(Source));
    EXPECT_EQ(Part.compile("-cl-std=CL3.0"), CL_SUCCESS);
    return Part;
  };
  const std::vector<cl::Program> Parts = {
      Compile("global int shared = 3; static global int own = 10;\n"
              "int other(void) { return own + shared; }\n"),
      Compile("extern global int shared; static global int own = 20;\n"
              "int other(void);\n"
              "kernel void go(global int *out) {\n"
              "  shared += own++;\n"
              "  out[0] = other();\n"
              "}\n")};
  cl_int Status = CL_SUCCESS;
  const cl::Program Whole =
      cl::linkProgram(Parts, nullptr, nullptr, nullptr, &Status);
  ASSERT_EQ(Status, CL_SUCCESS);
  EXPECT_EQ(run(Whole, "go"), std::vector<int32_t>{33});
  EXPECT_EQ(run(Whole, "go"), std::vector<int32_t>{54});

  const cl::Program Half(clLinkProgram(Device.context()(), 0, nullptr, "", 1,
                                       &Parts[1](), nullptr, nullptr, &Status));
  EXPECT_EQ(Status, CL_LINK_PROGRAM_FAILURE);
  EXPECT_NE(Half.getBuildInfo<CL_PROGRAM_BUILD_LOG>(cl::Device(device(), true))
                .find("the variable shared is declared, but no part of the "
                      "program has it"),
            std::string::npos);
}

/// A kernel that read such a constant failed when it started.
TEST_F(ProgramScope, AConstantThatNoPartHasIsNamed) {
  cl::Program Part(Device.context(),
                   std::string("extern constant int table[4];\n"
                               "kernel void go(global int *out) {\n"
                               "  out[0] = table[1];\n"
                               "}\n"));
  EXPECT_EQ(Part.build(), CL_BUILD_PROGRAM_FAILURE);
  EXPECT_NE(Part.getBuildInfo<CL_PROGRAM_BUILD_LOG>(cl::Device(device(), true))
                .find("the variable table is declared, but no part"),
            std::string::npos);
}

TEST_F(ProgramScope, AnAlignmentThatIsAskedForIsKept) {
  const cl::Program Program = build(R"(
global char first;
global int aligned __attribute__((aligned(1024)));
kernel void look(global int *out) {
  first = 1;
  aligned = 2;
  out[0] = (uintptr_t)&aligned % 1024;
}
)");
  EXPECT_EQ(run(Program, "look"), std::vector<int32_t>{0});
}

TEST_F(ProgramScope, ManyThreadsMayStartKernels) {
  const cl::Program Program = build(Counter);
  constexpr int Threads = 4, Launches = 5;
  std::vector<std::thread> All;
  for (int I = 0; I < Threads; ++I)
    All.emplace_back([&] {
      for (int J = 0; J < Launches; ++J)
        run(Program, "add");
    });
  for (std::thread &Each : All)
    Each.join();
  EXPECT_EQ(run(Program, "look"),
            std::vector<int32_t>{40 + Threads * Launches});
}

TEST_F(ProgramScope, SizesCanBeAsked) {
  const auto Ask = [&](cl_device_info What) {
    size_t Size = 0;
    EXPECT_EQ(clGetDeviceInfo(device(), What, sizeof(Size), &Size, nullptr),
              CL_SUCCESS);
    return Size;
  };
  EXPECT_GE(Ask(MaxVariableSize), 65536U);
  EXPECT_GE(Ask(PreferredTotalSize), 65536U);
  const auto Total = [&](const cl::Program &Program) {
    size_t Size = 1;
    EXPECT_EQ(clGetProgramBuildInfo(Program(), device(), TotalSize,
                                    sizeof(Size), &Size, nullptr),
              CL_SUCCESS);
    return Size;
  };
  // The order is not promised.
  const size_t Two = Total(build("global char one; global int two[3];\n"
                                 "kernel void k() { one = two[0] = 0; }\n"));
  EXPECT_GE(Two, 13U);
  EXPECT_LE(Two, 16U);
  EXPECT_EQ(Total(build("kernel void k() {}\n")), 0U);
}

} // namespace
