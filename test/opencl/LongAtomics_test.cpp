/// Atomics of 64 bits: those of OpenCL 1.x, and those that OpenCL C 3.0 has
/// from C11, with all work-items of all groups on the same words.

#include "TestDevice.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>

using vorion::test::TestDevice;

namespace {

constexpr std::size_t Groups = 11; // more than cores
constexpr std::size_t GroupSize = 40;
constexpr std::size_t Items = Groups * GroupSize;

/// An operand of work-item I; 64 bits that are not alike.
constexpr const char *OperandSource = R"(
ulong operand(ulong i) {
  i = (i + 1) * 0x9E3779B97F4A7C15UL;
  i ^= i >> 29;
  return i * 0xBF58476D1CE4E5B9UL;
}
)";
uint64_t operand(uint64_t I) {
  I = (I + 1) * 0x9E3779B97F4A7C15U;
  I ^= I >> 29;
  return I * 0xBF58476D1CE4E5B9U;
}

/// What an atomic leaves of the old value and the operand.
struct Operation {
  const char *Name;
  std::function<uint64_t(uint64_t Old, uint64_t Operand)> Apply;
};

template <typename T> std::vector<Operation> operations() {
  const auto As = [](uint64_t Bits) { return static_cast<T>(Bits); };
  return {
      {"add", [](auto Old, auto V) { return Old + V; }},
      {"sub", [](auto Old, auto V) { return Old - V; }},
      {"xchg", [](auto, auto V) { return V; }},
      {"and", [](auto Old, auto V) { return Old & V; }},
      {"or", [](auto Old, auto V) { return Old | V; }},
      {"xor", [](auto Old, auto V) { return Old ^ V; }},
      {"min", [=](auto Old, auto V) { return As(V) < As(Old) ? V : Old; }},
      {"max", [=](auto Old, auto V) { return As(V) > As(Old) ? V : Old; }},
  };
}

/// Whether the work-items First to First + Count may have changed a word from
/// Before to After one after the other, each having seen what Olds says.
void expectOneAfterTheOther(const Operation &O, uint64_t Before, uint64_t After,
                            const std::vector<uint64_t> &Olds,
                            std::size_t First, std::size_t Count) {
  std::multimap<uint64_t, std::size_t> BySeen;
  for (std::size_t I = First; I != First + Count; ++I)
    BySeen.emplace(Olds[I], I);
  uint64_t Now = Before;
  while (!BySeen.empty()) {
    uint64_t Next = Now;
    const auto [Begin, End] = BySeen.equal_range(Now);
    ASSERT_NE(Begin, End) << O.Name << ": nobody has seen " << Now;
    for (auto Seen = Begin; Seen != End; ++Seen) {
      const uint64_t Left = O.Apply(Now, operand(Seen->second));
      if (Left == Now)
        continue;
      ASSERT_EQ(Next, Now) << O.Name << ": two have changed " << Now;
      Next = Left;
    }
    BySeen.erase(Begin, End);
    Now = Next;
  }
  EXPECT_EQ(Now, After) << O.Name;
}

/// Runs kernel `change`, which applies operation N to global word N and to
/// local word N, and keeps what it has seen and what is left.
void expectAllAtomic(const TestDevice &Device, const cl::Program &Program,
                     const std::vector<Operation> &All) {
  const std::size_t Count = All.size();
  std::vector<uint64_t> Before;
  for (std::size_t N = 0; N != Count; ++N)
    Before.push_back(operand(1000 + N));
  const cl::Buffer Words = Device.upload(Before),
                   Seen(Device.context(), CL_MEM_READ_WRITE, Count * Items * 8),
                   SeenLocally(Device.context(), CL_MEM_READ_WRITE,
                               Count * Items * 8),
                   Locals(Device.context(), CL_MEM_READ_WRITE,
                          Count * Groups * 8);
  cl::Kernel Kernel(Program, "change");
  unsigned Argument = 0;
  for (const cl::Buffer &B : {Words, Seen, SeenLocally, Locals})
    Kernel.setArg(Argument++, B);
  Device.run(Kernel, Items, GroupSize);
  const auto After = Device.download<uint64_t>(Words, Count);
  const auto LocalAfter = Device.download<uint64_t>(Locals, Count * Groups);
  const auto OfGlobal = Device.download<uint64_t>(Seen, Count * Items);
  const auto OfLocal = Device.download<uint64_t>(SeenLocally, Count * Items);
  const auto Part = [](const std::vector<uint64_t> &V, std::size_t N) {
    const auto Begin = V.begin() + static_cast<std::ptrdiff_t>(N * Items);
    return std::vector<uint64_t>(Begin, Begin + Items);
  };
  for (std::size_t N = 0; N != Count; ++N) {
    expectOneAfterTheOther(All[N], Before[N], After[N], Part(OfGlobal, N), 0,
                           Items);
    for (std::size_t G = 0; G != Groups; ++G)
      expectOneAfterTheOther(All[N], operand(2000 + N),
                             LocalAfter[N * Groups + G], Part(OfLocal, N),
                             G * GroupSize, GroupSize);
    if (::testing::Test::HasFatalFailure())
      return;
  }
}

/// Kernel `change`. Statement gives an operation's code for place P, operand V;
/// Type is that of the words.
std::string changeSource(
    const std::vector<Operation> &All, const std::string &Type,
    const std::function<std::string(const Operation &, const std::string &)>
        &Statement) {
  const std::string Count = std::to_string(All.size());
  std::string Text =
      std::string(OperandSource) + "kernel void change(global " + Type +
      " *words, global ulong *seen, global ulong *seen_locally, "
      "global ulong *locals) {\n  local " +
      Type + " own[" + Count +
      "];\n  size_t i = get_global_id(0), n = get_global_size(0);\n"
      "  ulong v = operand(i);\n"
      "  if (get_local_id(0) < " +
      Count +
      ")\n    ((local ulong *)own)[get_local_id(0)] = operand(2000 + "
      "get_local_id(0));\n"
      "  barrier(CLK_LOCAL_MEM_FENCE);\n";
  for (std::size_t N = 0; N != All.size(); ++N) {
    const std::string Number = std::to_string(N);
    Text += "  seen[" + Number +
            " * n + i] = " + Statement(All[N], "&words[" + Number + "]") +
            ";\n  seen_locally[" + Number +
            " * n + i] = " + Statement(All[N], "&own[" + Number + "]") + ";\n";
  }
  return Text +
         "  barrier(CLK_LOCAL_MEM_FENCE);\n"
         "  if (get_local_id(0) < " +
         Count +
         ")\n    locals[get_local_id(0) * get_num_groups(0) + "
         "get_group_id(0)] = ((local ulong *)own)[get_local_id(0)];\n}\n";
}

constexpr const char *Extensions =
    "#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable\n"
    "#pragma OPENCL EXTENSION cl_khr_int64_extended_atomics : enable\n";

template <typename T>
void expectOldFunctionsAtomic(const TestDevice &Device,
                              const std::string &Type) {
  const std::vector<Operation> All = operations<T>();
  const cl::Program Program = Device.build(
      Extensions +
      changeSource(All, Type, [](const Operation &O, const std::string &Place) {
        return std::string("atom_") + O.Name + "(" + Place + ", v)";
      }));
  expectAllAtomic(Device, Program, All);
}

TEST(LongAtomics, OfOpenCL1) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  expectOldFunctionsAtomic<int64_t>(Device, "long");
  expectOldFunctionsAtomic<uint64_t>(Device, "ulong");
}

TEST(LongAtomics, CountAndCompare) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(std::string(Extensions) + R"(
kernel void count(volatile global long *up, volatile global ulong *down,
                  volatile global long *chain, global long *seen) {
  size_t i = get_global_id(0), n = get_global_size(0);
  seen[i] = atom_inc(up);
  seen[n + i] = atom_dec(down);
  long old = 0, expected;
  do {
    expected = old;
    old = atom_cmpxchg(chain, expected, expected * 3 + 1);
  } while (old != expected);
  seen[2 * n + i] = old;
})");
  const int64_t Carries = 0xFFFFFFF0;
  const cl::Buffer Up = Device.upload(std::vector<int64_t>{Carries}),
                   Down = Device.upload(std::vector<int64_t>{Carries + 100}),
                   Chain = Device.upload(std::vector<int64_t>{0}),
                   Seen(Device.context(), CL_MEM_READ_WRITE, 3 * Items * 8);
  cl::Kernel Kernel(Program, "count");
  unsigned Argument = 0;
  for (const cl::Buffer &B : {Up, Down, Chain, Seen})
    Kernel.setArg(Argument++, B);
  Device.run(Kernel, Items, GroupSize);
  auto Values = Device.download<int64_t>(Seen, 3 * Items);
  const auto Part = [&](std::size_t N) {
    const auto Begin = Values.begin() + static_cast<std::ptrdiff_t>(N * Items);
    std::vector<int64_t> Sorted(Begin, Begin + Items);
    std::sort(Sorted.begin(), Sorted.end());
    return Sorted;
  };
  std::vector<int64_t> Ups, Downs, Links;
  uint64_t Link = 0;
  for (std::size_t I = 0; I != Items; ++I, Link = Link * 3 + 1) {
    Ups.push_back(Carries + static_cast<int64_t>(I));
    Downs.insert(Downs.begin(), Carries + 100 - static_cast<int64_t>(I));
    Links.push_back(static_cast<int64_t>(Link));
  }
  std::sort(Links.begin(), Links.end());
  EXPECT_EQ(Part(0), Ups);
  EXPECT_EQ(Part(1), Downs);
  EXPECT_EQ(Part(2), Links);
  EXPECT_EQ(Device.download<uint64_t>(Chain, 1)[0], Link);
}

template <typename T>
void expectNewFunctionsAtomic(const TestDevice &Device,
                              const std::string &Type) {
  const std::vector<Operation> All = operations<T>();
  const cl::Program Program = Device.build(
      changeSource(All, "atomic_" + Type,
                   [&](const Operation &O, const std::string &Place) {
                     const std::string Name = O.Name;
                     return (Name == "xchg" ? "atomic_exchange("
                                            : "atomic_fetch_" + Name + "(") +
                            Place + ", v)";
                   }),
      "-cl-std=CL3.0");
  expectAllAtomic(Device, Program, All);
}

TEST(LongAtomics, OfOpenCLC3) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  expectNewFunctionsAtomic<int64_t>(Device, "long");
  expectNewFunctionsAtomic<uint64_t>(Device, "ulong");
}

/// fetch_add with every order and scope, each with words of its own.
TEST(LongAtomics, OrdersAndScopes) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const std::vector<std::string> Orders = {"relaxed", "acquire", "release",
                                           "acq_rel", "seq_cst"},
                                 Scopes = {"work_group", "device",
                                           "all_svm_devices"};
  const Operation Add = operations<uint64_t>().front();
  std::vector<std::string> Suffixes;
  for (const std::string &Order : Orders)
    for (const std::string &Scope : Scopes)
      Suffixes.push_back(", v, memory_order_" + Order + ", memory_scope_" +
                         Scope + ")");
  std::size_t Next = 0;
  const std::vector<Operation> All(Suffixes.size(), Add);
  const cl::Program Program = Device.build(
      changeSource(All, "atomic_ulong",
                   [&](const Operation &, const std::string &Place) {
                     // Twice, for the global and the local word.
                     return "atomic_fetch_add_explicit(" + Place +
                            Suffixes[Next++ / 2];
                   }),
      "-cl-std=CL3.0");
  expectAllAtomic(Device, Program, All);
}

/// Doubles are exchanged, compared, loaded and stored as wholes.
TEST(LongAtomics, Doubles) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
void add(generic atomic_double *sum, double v) {
  double seen = atomic_load_explicit(sum, memory_order_relaxed);
  while (!atomic_compare_exchange_weak(sum, &seen, seen + v))
    ;
}
kernel void sum(global atomic_double *all, global atomic_double *last,
                global double *seen, global double *of_group) {
  size_t i = get_global_id(0);
  local atomic_double own;
  if (get_local_id(0) == 0)
    atomic_init(&own, 0.25);
  barrier(CLK_LOCAL_MEM_FENCE);
  add(all, i + 0.5);
  add(&own, get_local_id(0));
  seen[i] = atomic_exchange(last, (double)i);
  barrier(CLK_LOCAL_MEM_FENCE);
  of_group[i] = atomic_load(&own);
  atomic_store_explicit(&last[1], 1e300, memory_order_release);
})",
                                           "-cl-std=CL3.0");
  const cl::Buffer All = Device.upload(std::vector<double>{0}),
                   Last = Device.upload(std::vector<double>{-1, 0}),
                   Seen(Device.context(), CL_MEM_READ_WRITE, Items * 8),
                   OfGroup(Device.context(), CL_MEM_READ_WRITE, Items * 8);
  cl::Kernel Kernel(Program, "sum");
  unsigned Argument = 0;
  for (const cl::Buffer &B : {All, Last, Seen, OfGroup})
    Kernel.setArg(Argument++, B);
  Device.run(Kernel, Items, GroupSize);
  EXPECT_EQ(Device.download<double>(All, 1)[0], Items * Items / 2.0);
  EXPECT_EQ(Device.download<double>(OfGroup, Items),
            std::vector<double>(Items, GroupSize * (GroupSize - 1) / 2 + 0.25));
  // Each value was seen by one, but for the last.
  std::vector<double> Values = Device.download<double>(Seen, Items), Given{-1};
  const auto Left = Device.download<double>(Last, 2);
  Values.push_back(Left[0]);
  for (std::size_t I = 0; I != Items; ++I)
    Given.push_back(static_cast<double>(I));
  std::sort(Values.begin(), Values.end());
  EXPECT_EQ(Values, Given);
  EXPECT_EQ(Left[1], 1e300);
}

} // namespace
