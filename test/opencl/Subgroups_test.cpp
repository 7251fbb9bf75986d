/// What work-items tell each other: functions of subgroups, of their active
/// lanes, and of groups. The host computes what each should be.

#include "TestDevice.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

using vorion::test::TestDevice;

// Of OpenCL 2.1, which the header declares to programs for it only.
extern "C" cl_int clGetKernelSubGroupInfo(cl_kernel, cl_device_id, cl_uint,
                                          std::size_t, const void *,
                                          std::size_t, void *, std::size_t *);

namespace {

constexpr std::size_t Lanes = 16, Groups = 3;
/// Less than a warp, a warp, whole warps, and a last one with a few.
constexpr std::size_t GroupSizes[] = {5, 16, 64, 83};

/// The values of a subgroup, or of those lanes of it that call a function.
using Values = std::vector<int32_t>;
/// What the work-item at a place among them should get.
using Oracle = std::function<int32_t(const Values &, std::size_t)>;

struct Function {
  const char *Call; ///< of x
  Oracle Expected;
};

int32_t sum(Values::const_iterator From, Values::const_iterator To) {
  return std::accumulate(From, To, 0);
}

const std::vector<Function> OfSubgroups = {
    {"sub_group_reduce_add(x)",
     [](const Values &V, std::size_t) { return sum(V.begin(), V.end()); }},
    {"sub_group_reduce_min(x)",
     [](const Values &V, std::size_t) {
       return *std::min_element(V.begin(), V.end());
     }},
    {"sub_group_scan_inclusive_add(x)",
     [](const Values &V, std::size_t I) {
       return sum(V.begin(), V.begin() + static_cast<long>(I) + 1);
     }},
    {"sub_group_scan_exclusive_max(x)",
     [](const Values &V, std::size_t I) {
       return I == 0 ? std::numeric_limits<int32_t>::min()
                     : *std::max_element(V.begin(),
                                         V.begin() + static_cast<long>(I));
     }},
    {"(int)sub_group_scan_exclusive_add((float)x)",
     [](const Values &V, std::size_t I) {
       return sum(V.begin(), V.begin() + static_cast<long>(I));
     }},
    {"(int)(sub_group_reduce_add((long)x << 32) >> 32)",
     [](const Values &V, std::size_t) { return sum(V.begin(), V.end()); }},
    {"sub_group_broadcast(x, 2)",
     [](const Values &V, std::size_t) { return V[2]; }},
    {"sub_group_broadcast((short4)(x, 1, 2, x + 3), 1).w",
     [](const Values &V, std::size_t) { return V[1] + 3; }},
    {"sub_group_shuffle_xor(x, 1)",
     [](const Values &V, std::size_t I) {
       return V[(I ^ 1) < V.size() ? I ^ 1 : I];
     }},
    {"sub_group_shuffle_up(x, 1) * (get_sub_group_local_id() > 0)",
     [](const Values &V, std::size_t I) { return I == 0 ? 0 : V[I - 1]; }},
    {"sub_group_all(x > -90)",
     [](const Values &V, std::size_t) {
       return std::all_of(V.begin(), V.end(), [](int X) { return X > -90; });
     }},
    {"sub_group_ballot(x > 0).x",
     [](const Values &V, std::size_t) {
       int32_t Mask = 0;
       for (std::size_t I = 0; I < V.size(); ++I)
         Mask |= (V[I] > 0) << I;
       return Mask;
     }},
    {"sub_group_ballot_exclusive_scan(sub_group_ballot(x > 0))",
     [](const Values &V, std::size_t I) {
       return static_cast<int32_t>(
           std::count_if(V.begin(), V.begin() + static_cast<long>(I),
                         [](int X) { return X > 0; }));
     }},
    {"get_sub_group_size()",
     [](const Values &V, std::size_t) {
       return static_cast<int32_t>(V.size());
     }},
    {"get_sub_group_local_id()",
     [](const Values &, std::size_t I) { return static_cast<int32_t>(I); }},
};

/// Called by work-items with an odd x alone.
const std::vector<Function> OfActiveLanes = {
    {"sub_group_non_uniform_reduce_add(x)",
     [](const Values &V, std::size_t) { return sum(V.begin(), V.end()); }},
    {"sub_group_non_uniform_scan_exclusive_add(x)",
     [](const Values &V, std::size_t I) {
       return sum(V.begin(), V.begin() + static_cast<long>(I));
     }},
    {"sub_group_non_uniform_scan_inclusive_xor(x)",
     [](const Values &V, std::size_t I) {
       return std::accumulate(V.begin(), V.begin() + static_cast<long>(I) + 1,
                              0, std::bit_xor<>());
     }},
    {"sub_group_broadcast_first(x)",
     [](const Values &V, std::size_t) { return V[0]; }},
    {"sub_group_elect()",
     [](const Values &, std::size_t I) { return I == 0 ? 1 : 0; }},
    {"sub_group_non_uniform_all_equal(x)",
     [](const Values &V, std::size_t) {
       return std::all_of(V.begin(), V.end(), [&](int X) { return X == V[0]; });
     }},
};

const std::vector<Function> OfGroups = {
    {"work_group_reduce_add(x)",
     [](const Values &V, std::size_t) { return sum(V.begin(), V.end()); }},
    {"work_group_scan_inclusive_min(x)",
     [](const Values &V, std::size_t I) {
       return *std::min_element(V.begin(),
                                V.begin() + static_cast<long>(I) + 1);
     }},
    {"work_group_scan_exclusive_add(x)",
     [](const Values &V, std::size_t I) {
       return sum(V.begin(), V.begin() + static_cast<long>(I));
     }},
    {"(int)work_group_reduce_max((float)x)",
     [](const Values &V, std::size_t) {
       return *std::max_element(V.begin(), V.end());
     }},
    {"work_group_broadcast(x, get_local_size(0) - 1)",
     [](const Values &V, std::size_t) { return V.back(); }},
    {"work_group_any(x == in[get_group_id(0) * get_local_size(0) + 3])",
     [](const Values &, std::size_t) { return 1; }},
    {"work_group_all(x > 0)",
     [](const Values &V, std::size_t) {
       return std::all_of(V.begin(), V.end(), [](int X) { return X > 0; });
     }},
};

/// A kernel that writes every function's result, and 0 where a work-item does
/// not come to `CALL` in \p Body.
std::string kernelOf(const std::vector<Function> &Functions,
                     const std::string &Body) {
  const auto replaceAll = [](std::string Text, const std::string &Old,
                             const std::string &New) {
    for (std::size_t At = 0; (At = Text.find(Old, At)) != std::string::npos;
         At += New.size())
      Text.replace(At, Old.size(), New);
    return Text;
  };
  // What `again` reads is not known before it is read.
  std::string Source =
      "kernel void call(global const int *in, global int *out) {\n"
      "  const size_t i = get_global_id(0);\n  const int x = in[i];\n"
      "  const volatile global int *again = in + i;\n  volatile int side = "
      "0;\n";
  const std::string Count = std::to_string(Functions.size());
  for (std::size_t F = 0; F < Functions.size(); ++F) {
    const std::string Place =
        "out[i * " + Count + " + " + std::to_string(F) + "]";
    Source += "  " + Place + " = 0;\n  {";
    Source += replaceAll(
        replaceAll(Body, "CALL", Place + " = " + Functions[F].Call + ";"),
        "LABEL", "label" + std::to_string(F));
    Source += "}\n";
  }
  return Source + "}\n";
}

/// Runs \p Functions in groups of all sizes, in OpenCL C of \p Language. They
/// are over \p Width consecutive work-items of a group, of which those take
/// part for which \p Takes holds, which says who comes to CALL in \p Body.
void check(const TestDevice &Device, const char *Language,
           const std::vector<Function> &Functions, std::size_t Width,
           const std::string &Body, const std::function<bool(int32_t)> &Takes) {
  SCOPED_TRACE(Language);
  const cl::Program Program = Device.build(kernelOf(Functions, Body), Language);
  cl::Kernel Kernel(Program, "call");
  std::mt19937 Random(1);
  for (const std::size_t Size : GroupSizes) {
    Values In(Size * Groups);
    for (int32_t &Value : In)
      Value = static_cast<int32_t>(Random() % 201) - 100;
    const cl::Buffer Input = Device.upload(In);
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE,
                         In.size() * Functions.size() * sizeof(int32_t));
    Kernel.setArg(0, Input);
    Kernel.setArg(1, Out);
    Device.run(Kernel, In.size(), Size);
    const auto Got =
        Device.download<int32_t>(Out, In.size() * Functions.size());

    std::vector<int32_t> Expected(Got.size());
    for (std::size_t Group = 0; Group < In.size(); Group += Size)
      for (std::size_t First = Group; First < Group + Size; First += Width) {
        const std::size_t End = std::min(First + Width, Group + Size);
        Values Taking;
        std::vector<std::size_t> Items;
        for (std::size_t I = First; I < End; ++I)
          if (Takes(In[I])) {
            Taking.push_back(In[I]);
            Items.push_back(I);
          }
        for (std::size_t I = 0; I < Items.size(); ++I)
          for (std::size_t F = 0; F < Functions.size(); ++F)
            Expected[Items[I] * Functions.size() + F] =
                Functions[F].Expected(Taking, I);
      }
    for (std::size_t F = 0; F < Functions.size(); ++F)
      for (std::size_t I = 0; I < In.size(); ++I)
        ASSERT_EQ(Got[I * Functions.size() + F],
                  Expected[I * Functions.size() + F])
            << Functions[F].Call << ", work-item " << I << ", groups of "
            << Size;
  }
}

bool everyone(int32_t) { return true; }

/// The extensions have macros, and so must have functions, in both.
constexpr const char *Languages[] = {"-cl-std=CL1.2", "-cl-std=CL3.0"};

TEST(Subgroups, EveryWorkItemOfAWarpTakesPart) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  for (const char *Language : Languages)
    check(Device, Language, OfSubgroups, Lanes, "CALL", everyone);
}

TEST(Subgroups, FunctionsOfActiveLanesLeaveTheOthersOut) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  for (const char *Language : Languages)
    check(Device, Language, OfActiveLanes, Lanes, "if (x & 1) CALL",
          [](int32_t X) { return (X & 1) != 0; });
}

struct Pattern {
  const char *Body;
  bool (*Takes)(int32_t);
};

/// Basic blocks that work-items reach along several paths.
const Pattern SharedBlocks[] = {
    {"if ((x & 1) || *again > 50) CALL",
     [](int32_t X) { return (X & 1) != 0 || X > 50; }},
    {"if (x > 0 && *again < 60) side += *again; else CALL",
     [](int32_t X) { return X <= 0 || X >= 60; }},
    {"switch (x) { case 3: side += *again; break; case 7: side += *again;"
     " break; case -11: break; default: CALL }",
     [](int32_t X) { return X != 3 && X != 7 && X != -11; }},
    {"switch (x & 3) { case 0: side += *again; case 1: CALL }",
     [](int32_t X) { return (X & 3) < 2; }},
    {"if (x > 40) goto LABEL; if (*again < 0) { if (*again > -50) goto LABEL; "
     "goto not_LABEL; } if (x & 1) LABEL: CALL not_LABEL:;",
     [](int32_t X) { return X > 40 || (X < 0 ? X > -50 : (X & 1) != 0); }},
    // As a function that returns early, once it is inlined.
    {"do { if (x > 20) { if (*again & 1) break; side += *again; } CALL } while "
     "(0);",
     [](int32_t X) { return X <= 20 || (X & 1) == 0; }},
    // The label is reached from two loops, at different times.
    {"for (int a = 0; a < 4; ++a) { for (int b = 0; b < 4; ++b) { "
     "if (*again == a * 4 + b) goto LABEL; if (*again < b) break; } "
     "if (*again == -a) goto LABEL; } goto not_LABEL; LABEL: CALL "
     "not_LABEL:;",
     [](int32_t X) { return X >= -3 && X < 16; }},
    // In each of three rounds; the result of the last round is compared.
    {"for (int a = 0; a < 3; ++a) { if (x & 2) { if (*again & 4) continue; } "
     "CALL }",
     [](int32_t X) { return (X & 2) == 0 || (X & 4) == 0; }},
};

TEST(Subgroups, FunctionsSeeAllLanesThatComeAlongDifferentPaths) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  for (const Pattern &P : SharedBlocks) {
    SCOPED_TRACE(P.Body);
    check(Device, "-cl-std=CL3.0", OfActiveLanes, Lanes, P.Body, P.Takes);
  }
}

TEST(Subgroups, FunctionsOfGroupsGoThroughAllSubgroups) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  check(Device, "-cl-std=CL3.0", OfGroups,
        *std::max_element(std::begin(GroupSizes), std::end(GroupSizes)), "CALL",
        everyone);
}

/// A program sees it in the device's list, in kernels, and by the function that
/// comes with it.
TEST(Subgroups, TheExtensionOfTheBaseFunctionsIsOffered) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Device Chosen = Device.context().getInfo<CL_CONTEXT_DEVICES>()[0];
  EXPECT_NE((" " + Chosen.getInfo<CL_DEVICE_EXTENSIONS>() + " ")
                .find(" cl_khr_subgroups "),
            std::string::npos);
  // The subgroups of a group take turns, whatever the extension promises.
  constexpr cl_device_info IndependentProgress = 0x105D;
  cl_bool Progress = CL_TRUE;
  EXPECT_EQ(clGetDeviceInfo(Chosen(), IndependentProgress, sizeof(Progress),
                            &Progress, nullptr),
            CL_SUCCESS);
  EXPECT_EQ(Progress, CL_FALSE);

  using Query = decltype(&clGetKernelSubGroupInfo);
  const auto ByName =
      reinterpret_cast<Query>(clGetExtensionFunctionAddressForPlatform(
          Chosen.getInfo<CL_DEVICE_PLATFORM>(), "clGetKernelSubGroupInfoKHR"));
  ASSERT_NE(ByName, nullptr);
  for (const char *Language : Languages) {
    const cl::Program Program =
        Device.build("#ifndef cl_khr_subgroups\n"
                     "#error\n"
                     "#endif\n"
                     "#pragma OPENCL EXTENSION cl_khr_subgroups : enable\n"
                     "kernel void f(global int *out) {\n"
                     "  local int x[48];\n"
                     "  int i = get_local_id(0);\n"
                     "  x[i] = i;\n"
                     "  sub_group_barrier(CLK_LOCAL_MEM_FENCE);\n"
                     "  out[i] = x[i ^ 1] + 100 * get_sub_group_id();\n"
                     "}\n",
                     Language);
    cl::Kernel Kernel(Program, "f");
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 4 * 48);
    Kernel.setArg(0, Out);
    Device.run(Kernel, 48, 48);
    const auto Values = Device.download<int32_t>(Out, 48);
    for (int32_t I = 0; I < 48; ++I)
      ASSERT_EQ(Values[I], (I ^ 1) + I / 16 * 100) << Language;

    constexpr cl_uint MaxSize = 0x2033, Count = 0x2034;
    const std::size_t Local[] = {10, 4};
    for (const auto &[Question, Answer] :
         {std::pair(MaxSize, 16U), {Count, 3U}})
      for (const Query Function : {ByName, &clGetKernelSubGroupInfo}) {
        std::size_t Value = 0;
        EXPECT_EQ(Function(Kernel(), Chosen(), Question, sizeof(Local), Local,
                           sizeof(Value), &Value, nullptr),
                  CL_SUCCESS);
        EXPECT_EQ(Value, Answer);
      }
  }
}

TEST(Subgroups, AGroupOfSoManySubgroupsHasALaneForEachWorkItem) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(
      "kernel void fill(global int *out) { out[get_global_id(0)] = 1; }");
  const cl::Kernel Kernel(Program, "fill");
  constexpr cl_uint LocalSizeForCount = 0x11B8;
  for (const std::size_t Count : {std::size_t{4}, std::size_t{65}}) {
    const std::size_t Items = Count == 4 ? 64 : 0; // more than 1024 is none
    for (std::size_t Dimensions = 1; Dimensions <= 3; ++Dimensions) {
      std::vector<std::size_t> Local(Dimensions, 9);
      std::size_t Returned = 0;
      EXPECT_EQ(clGetKernelSubGroupInfo(
                    Kernel(), nullptr, LocalSizeForCount, sizeof(Count), &Count,
                    Dimensions * sizeof(std::size_t), Local.data(), &Returned),
                CL_SUCCESS);
      EXPECT_EQ(Returned, Dimensions * sizeof(std::size_t));
      std::vector<std::size_t> Expected(Dimensions, Items ? 1 : 0);
      Expected[0] = Items;
      EXPECT_EQ(Local, Expected);
    }
  }
}

} // namespace
