/// The C interface against a real machine, with the kernels of
/// testing/kernels.S.
#include "vorion/runtime.h"
#include "vorion_abi.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <numeric>
#include <thread>
#include <vector>

namespace {

// KERNELS_ELF and OTHER_LANES_ELF are given by the build.
constexpr const char *Elf = KERNELS_ELF;
/// Small memory, and an end for what would not end.
constexpr const char *Config =
    R"({"global_bytes": 8388608, "max_instructions": 100000})";

class Runtime : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(vx_device_open(Config, &Device), VX_OK) << vx_last_error();
    ASSERT_EQ(vx_image_load_file(Device, Elf, &Image), VX_OK)
        << vx_last_error();
    ASSERT_EQ(vx_device_get_info(Device, &Info), VX_OK);
  }
  void TearDown() override {
    EXPECT_EQ(vx_image_free(Image), VX_OK);
    EXPECT_EQ(vx_device_close(Device), VX_OK);
  }

  uint32_t find(const char *Name) {
    uint32_t Kernel = ~0U;
    EXPECT_EQ(vx_image_find_kernel(Image, Name, &Kernel), VX_OK)
        << vx_last_error();
    return Kernel;
  }
  uint32_t allocate(uint64_t Size) {
    uint32_t Address = 0;
    EXPECT_EQ(vx_mem_alloc(Device, Size, &Address), VX_OK) << vx_last_error();
    return Address;
  }
  std::vector<uint32_t> words(uint32_t Address, std::size_t Count) {
    std::vector<uint32_t> Words(Count);
    EXPECT_EQ(vx_copy_from_device(Device, Words.data(), Address, 4 * Count),
              VX_OK)
        << vx_last_error();
    return Words;
  }
  vx_status start(const char *Kernel, const std::vector<uint32_t> &Args,
                  const vx_launch_params &Params = OneItem) {
    return vx_start(Device, Image, find(Kernel), &Params, Args.data(),
                    static_cast<uint32_t>(4 * Args.size()));
  }
  vx_result wait() {
    vx_result Result{};
    EXPECT_EQ(vx_wait(Device, &Result), VX_OK) << vx_last_error();
    return Result;
  }
  vx_result run(const char *Kernel, const std::vector<uint32_t> &Args) {
    EXPECT_EQ(start(Kernel, Args), VX_OK) << vx_last_error();
    return wait();
  }

  static constexpr vx_launch_params OneItem{1, {1, 1, 1}, {1, 1, 1}, {0, 0, 0},
                                            0, nullptr,   0};
  vx_device *Device = nullptr;
  vx_image *Image = nullptr;
  vx_device_info Info{};
};

TEST_F(Runtime, RunsAKernelOnEveryCore) {
  const uint32_t Out = allocate(4 * Info.cores);
  const vx_result Result = run("store", {Out, 100});
  EXPECT_EQ(Result.outcome, VX_OUTCOME_DONE) << Result.report;
  EXPECT_STREQ(Result.report, "");
  EXPECT_GT(Result.counters.warp_instructions, 8 * Info.cores);
  EXPECT_EQ(Result.counters.stores, Info.cores);
  std::vector<uint32_t> Expected(Info.cores);
  std::iota(Expected.begin(), Expected.end(), 100);
  EXPECT_EQ(words(Out, Info.cores), Expected);
}

TEST_F(Runtime, ListsKernelsAndArguments) {
  uint32_t Count = 0;
  ASSERT_EQ(vx_image_num_kernels(Image, &Count), VX_OK);
  EXPECT_EQ(Count, 10u);
  vx_kernel_info Kernel{};
  ASSERT_EQ(vx_image_get_kernel(Image, find("copy_launch"), &Kernel), VX_OK);
  EXPECT_STREQ(Kernel.name, "copy_launch");
  EXPECT_EQ(Kernel.num_args, 1u);
  EXPECT_EQ(Kernel.args_bytes, 4u);
  EXPECT_EQ(Kernel.context_bytes, 100u);
  EXPECT_EQ(Kernel.local_size[0], 4u);
  EXPECT_EQ(Kernel.local_size[1], 2u);
  vx_arg_info Arg{};
  ASSERT_EQ(vx_image_get_arg(Image, find("locals"), 2, &Arg), VX_OK);
  EXPECT_STREQ(Arg.name, "second");
  EXPECT_EQ(Arg.kind, VX_ARG_LOCAL);
  EXPECT_EQ(Arg.offset, 8u);
  EXPECT_EQ(Arg.size, 4u);
  EXPECT_EQ(vx_image_get_arg(Image, find("locals"), 3, &Arg),
            VX_ERROR_NOT_FOUND);
  EXPECT_EQ(vx_image_find_kernel(Image, "absent", &Count), VX_ERROR_NOT_FOUND);
  EXPECT_STREQ(vx_last_error(), "the image has no kernel absent");
}

TEST_F(Runtime, RefusesKernelsForOtherLanes) {
  vx_kernel_info Kernel{};
  ASSERT_EQ(vx_image_get_kernel(Image, find("store"), &Kernel), VX_OK);
  EXPECT_EQ(Kernel.lanes, 0u);
  vx_image *Other = nullptr;
  EXPECT_EQ(vx_image_load_file(Device, OTHER_LANES_ELF, &Other),
            VX_ERROR_IMAGE);
  EXPECT_EQ(vx_last_error(),
            OTHER_LANES_ELF +
                std::string(": kernel 'store' was compiled for warps of 8 "
                            "lanes, expected 16 as in the machine (the "
                            "compiler reads VORION_SET and VORION_CONFIG)"));
  vx_device *Narrow = nullptr;
  ASSERT_EQ(vx_device_open(R"({"lanes_per_warp": 8, "global_bytes": 8388608})",
                           &Narrow),
            VX_OK);
  ASSERT_EQ(vx_image_load_file(Narrow, OTHER_LANES_ELF, &Other), VX_OK)
      << vx_last_error();
  ASSERT_EQ(vx_image_get_kernel(Other, 0, &Kernel), VX_OK);
  EXPECT_EQ(Kernel.lanes, 8u);
  EXPECT_EQ(vx_image_free(Other), VX_OK);
  EXPECT_EQ(vx_device_close(Narrow), VX_OK);
}

TEST_F(Runtime, FillsTheLaunchBlock) {
  const uint32_t Out = allocate(sizeof(vx_launch));
  const vx_launch_params Params{2, {3, 5, 1}, {4, 2, 1}, {7, 8, 9},
                                0, nullptr,   0};
  ASSERT_EQ(start("copy_launch", {Out}, Params), VX_OK) << vx_last_error();
  EXPECT_EQ(wait().outcome, VX_OUTCOME_DONE);
  vx_launch Block;
  ASSERT_EQ(vx_copy_from_device(Device, &Block, Out, sizeof(Block)), VX_OK);
  EXPECT_EQ(Block.work_dim, 2u);
  EXPECT_EQ(Block.num_groups[1], 5u);
  EXPECT_EQ(Block.local_size[0], 4u);
  EXPECT_EQ(Block.global_offset[2], 9u);
  // 8 work-items of 100 bytes, rounded up to the alignment.
  EXPECT_EQ(Block.context_stride, 896u);
  EXPECT_GE(Block.context, Info.global_base);
  EXPECT_EQ(Block.print_capacity, (1u << 20) - sizeof(vx_print));
  EXPECT_EQ(Block.stack_bytes, 1u << 16);
}

TEST_F(Runtime, GivesBackWhatARunUsed) {
  const uint32_t Out = allocate(sizeof(vx_launch));
  vx_device_info Before{}, After{};
  ASSERT_EQ(vx_device_get_info(Device, &Before), VX_OK);
  const vx_launch_params Params{2, {1, 1, 1}, {4, 2, 1}, {0, 0, 0},
                                0, nullptr,   0};
  ASSERT_EQ(start("copy_launch", {Out}, Params), VX_OK);
  wait();
  ASSERT_EQ(vx_device_get_info(Device, &After), VX_OK);
  EXPECT_EQ(After.free_bytes, Before.free_bytes);
  EXPECT_EQ(After.largest_free_bytes, Before.largest_free_bytes);
}

TEST_F(Runtime, PlacesLocalArgumentsAfterStaticOnes) {
  const uint32_t Out = allocate(8);
  uint32_t Args[3] = {Out, 0, 0};
  const uint64_t Sizes[2] = {130, 4};
  uint32_t Total = 0;
  ASSERT_EQ(
      vx_image_place_locals(Image, find("locals"), Sizes, 2, Args, &Total),
      VX_OK)
      << vx_last_error();
  // 100 static bytes, then two blocks on boundaries of 128.
  EXPECT_EQ(Args[1], VX_LOCAL_BASE + 128);
  EXPECT_EQ(Args[2], VX_LOCAL_BASE + 128 + 256);
  EXPECT_EQ(Total, 128u + 256u + 4u);
  run("locals", {Args[0], Args[1], Args[2]});
  EXPECT_EQ(words(Out, 2), (std::vector<uint32_t>{Args[1], Args[2]}));

  const uint64_t TooLarge[2] = {130, Info.local_bytes};
  EXPECT_EQ(
      vx_image_place_locals(Image, find("locals"), TooLarge, 2, Args, nullptr),
      VX_ERROR_MEMORY);
  EXPECT_EQ(
      vx_image_place_locals(Image, find("locals"), Sizes, 1, Args, nullptr),
      VX_ERROR_ARGUMENT);
  const uint64_t Huge[2] = {UINT64_MAX, UINT64_MAX};
  EXPECT_EQ(
      vx_image_place_locals(Image, find("locals"), Huge, 2, Args, nullptr),
      VX_ERROR_MEMORY);
}

TEST_F(Runtime, AnImageKeepsItsDataWhileOthersRun) {
  vx_image *Other = nullptr;
  ASSERT_EQ(vx_image_load_file(Device, Elf, &Other), VX_OK);
  const uint32_t Out = allocate(4);
  run("count", {Out});
  EXPECT_EQ(words(Out, 1)[0], 41u);
  std::swap(Image, Other);
  run("count", {Out});
  EXPECT_EQ(words(Out, 1)[0], 41u) << "the second image has data of its own";
  std::swap(Image, Other);
  run("count", {Out});
  EXPECT_EQ(words(Out, 1)[0], 42u) << "the first image's data came back";
  EXPECT_EQ(vx_image_free(Other), VX_OK);
}

TEST_F(Runtime, ReturnsPrintedText) {
  vx_result Result = run("print", {3});
  EXPECT_EQ(std::string(Result.print_text, Result.print_bytes), "hi\n");
  EXPECT_EQ(Result.print_dropped, 0u);
  Result = run("store", {allocate(64), 0});
  EXPECT_EQ(Result.print_bytes, 0u) << "text of an earlier run";
}

TEST_F(Runtime, CountsTextThatDidNotFit) {
  const vx_result Result = run("print", {(1 << 20) + 5});
  constexpr std::size_t Room = (1 << 20) - sizeof(vx_print);
  EXPECT_EQ(Result.print_bytes, Room);
  EXPECT_EQ(Result.print_dropped, (1 << 20) + 5 - Room);
}

TEST_F(Runtime, AFaultIsAResultAndTheDeviceGoesOn) {
  vx_result Result = run("fault", {});
  EXPECT_EQ(Result.outcome, VX_OUTCOME_FAULT);
  EXPECT_NE(std::string(Result.report).find("fault"), std::string::npos)
      << Result.report;
  const uint32_t Out = allocate(4 * Info.cores);
  Result = run("store", {Out, 5});
  EXPECT_EQ(Result.outcome, VX_OUTCOME_DONE) << Result.report;
  EXPECT_EQ(words(Out, 1)[0], 5u);
}

TEST_F(Runtime, HangsLimitsAndExitCodesAreResults) {
  vx_result Result = run("hang", {});
  EXPECT_EQ(Result.outcome, VX_OUTCOME_HANG);
  EXPECT_STRNE(Result.report, "");
  Result = run("forever", {});
  EXPECT_EQ(Result.outcome, VX_OUTCOME_LIMIT);
  EXPECT_STRNE(Result.report, "");
  Result = run("exit_seven", {});
  EXPECT_EQ(Result.outcome, VX_OUTCOME_EXIT);
  EXPECT_EQ(Result.exit_code, 7u);
}

TEST_F(Runtime, RunsAProgramWithoutALaunchBlock) {
  ASSERT_EQ(vx_start_main(Device, Image), VX_OK) << vx_last_error();
  const vx_result Result = wait();
  EXPECT_EQ(Result.outcome, VX_OUTCOME_EXIT);
  EXPECT_EQ(Result.exit_code, 3u);
  EXPECT_STREQ(Result.console_text, "m\nm\nm\nm\nm\nm\nm\nm\n");
}

TEST(RuntimeConsole, KeepsABoundedPart) {
  vx_device *Device = nullptr;
  ASSERT_EQ(vx_device_open("{\"cores_per_socket\": 1}", &Device), VX_OK);
  vx_image *Image = nullptr;
  ASSERT_EQ(vx_image_load_file(Device, Elf, &Image), VX_OK);
  uint32_t Kernel = 0;
  ASSERT_EQ(vx_image_find_kernel(Image, "chatter", &Kernel), VX_OK);
  const vx_launch_params Params{1, {1, 1, 1}, {1, 1, 1}, {0, 0, 0},
                                0, nullptr,   0};
  const uint32_t Words = (1 << 20) + 100;
  ASSERT_EQ(vx_start(Device, Image, Kernel, &Params, &Words, 4), VX_OK);
  vx_result Result{};
  ASSERT_EQ(vx_wait(Device, &Result), VX_OK);
  EXPECT_EQ(Result.console_bytes, std::size_t{1} << 20);
  // The last line may have been ended for the program.
  EXPECT_GE(Result.console_dropped, 100u);
  EXPECT_LE(Result.console_dropped, 101u);
  EXPECT_EQ(vx_image_free(Image), VX_OK);
  EXPECT_EQ(vx_device_close(Device), VX_OK);
}

/// Ends the program with a static object that still runs an image, and that
/// outlasts ours, as it was there before. What had gone was mostly read without
/// harm; sanitizers see it.
[[noreturn]] void endWithARun() {
  static struct Last {
    vx_device *Device = nullptr;
    bool run() const {
      vx_image *Image = nullptr;
      vx_result Result{};
      return vx_image_load_file(Device, Elf, &Image) == VX_OK &&
             vx_start_main(Device, Image) == VX_OK &&
             vx_wait(Device, &Result) == VX_OK &&
             Result.outcome == VX_OUTCOME_EXIT;
    }
    ~Last() { std::_Exit(run() ? 0 : 1); }
  } Object;
  vx_device_open(Config, &Object.Device);
  std::exit(Object.run() ? 0 : 1);
}

TEST(RuntimeDeathTest, RunsWhileStaticObjectsGo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(endWithARun(), testing::ExitedWithCode(0), "");
}

TEST_F(Runtime, NoGroupsRunNothing) {
  const vx_launch_params Params{1, {0, 1, 1}, {1, 1, 1}, {0, 0, 0},
                                0, nullptr,   0};
  ASSERT_EQ(start("exit_seven", {}, Params), VX_OK) << vx_last_error();
}

TEST_F(Runtime, WaitingTwiceGivesTheSameResult) {
  const uint32_t Out = allocate(4 * Info.cores);
  const vx_result First = run("store", {Out, 1});
  const vx_result Second = wait();
  EXPECT_EQ(First.counters.warp_instructions,
            Second.counters.warp_instructions);
  EXPECT_EQ(First.report, Second.report);
}

TEST_F(Runtime, WaitingForNothingIsAnError) {
  vx_result Result{};
  EXPECT_EQ(vx_wait(Device, &Result), VX_ERROR_BUSY);
}

TEST_F(Runtime, CopiesWaitForTheRun) {
  const uint32_t Out = allocate(4 * Info.cores);
  ASSERT_EQ(start("store", {Out, 9}), VX_OK);
  EXPECT_EQ(words(Out, 1)[0], 9u); // no vx_wait before
}

TEST_F(Runtime, RefusesBadLaunches) {
  const uint32_t Out = allocate(4 * Info.cores);
  const uint32_t Args[2] = {Out, 1};
  const auto Status = [&](const vx_launch_params &Params) {
    return vx_start(Device, Image, find("store"), &Params, Args, 8);
  };
  EXPECT_EQ(Status({0, {1, 1, 1}, {1, 1, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(Status({4, {1, 1, 1}, {1, 1, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(Status({1, {1, 2, 1}, {1, 1, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(Status({1, {1, 1, 1}, {0, 1, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(Status({3, {1, 1, 1}, {1025, 1, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(Status({3, {1, 1, 1}, {65536, 65536, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(Status({3, {~0U, ~0U, ~0U}, {1, 1, 1}, {}, 0, nullptr, 0}),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_start(Device, Image, find("store"), &OneItem, Args, 4),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_start(Device, Image, find("store"), &OneItem, nullptr, 8),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_start(Device, Image, 99, &OneItem, Args, 8), VX_ERROR_NOT_FOUND);
  // copy_launch was compiled for groups of 4 x 2.
  EXPECT_EQ(vx_start(Device, Image, find("copy_launch"), &OneItem, Args, 4),
            VX_ERROR_ARGUMENT);
}

TEST_F(Runtime, RefusesImagesOfAnotherDevice) {
  vx_device *Other = nullptr;
  ASSERT_EQ(vx_device_open(Config, &Other), VX_OK);
  EXPECT_EQ(vx_start_main(Other, Image), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_device_close(Other), VX_OK);
}

TEST_F(Runtime, MemoryExhaustionIsAnError) {
  uint32_t Address = 0;
  EXPECT_EQ(vx_mem_alloc(Device, Info.global_bytes + 1, &Address),
            VX_ERROR_MEMORY);
  ASSERT_EQ(vx_mem_alloc(Device, Info.largest_free_bytes, &Address), VX_OK);
  // Not even the launch block fits now.
  EXPECT_EQ(start("exit_seven", {}), VX_ERROR_MEMORY);
  EXPECT_EQ(vx_mem_free(Device, Address), VX_OK);
  EXPECT_EQ(vx_mem_free(Device, Address), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_mem_free(Device, 0), VX_OK);
  EXPECT_EQ(run("exit_seven", {}).exit_code, 7u);
}

TEST_F(Runtime, ThreeGibibytesCanBeHad) {
  vx_device *Large = nullptr;
  ASSERT_EQ(vx_device_open(R"({"global_bytes": 3221225472})", &Large), VX_OK)
      << vx_last_error();
  vx_image *Kernels = nullptr;
  ASSERT_EQ(vx_image_load_file(Large, Elf, &Kernels), VX_OK);
  vx_device_info I{};
  ASSERT_EQ(vx_device_get_info(Large, &I), VX_OK);
  EXPECT_EQ(I.global_bytes, 3ULL << 30);
  EXPECT_EQ(I.free_bytes, 3ULL << 30);
  uint32_t First = 0, Second = 0;
  ASSERT_EQ(vx_mem_alloc(Large, I.largest_free_bytes, &First), VX_OK);
  ASSERT_EQ(vx_mem_alloc(Large, 1000 << 20, &Second), VX_OK);
  EXPECT_EQ(Second, VX_HIGH_BASE);
  // A kernel's launch block and arguments lie behind the image, too.
  const uint32_t Args[] = {Second + (999 << 20), 100};
  uint32_t Store = 0;
  ASSERT_EQ(vx_image_find_kernel(Kernels, "store", &Store), VX_OK);
  ASSERT_EQ(vx_start(Large, Kernels, Store, &OneItem, Args, sizeof(Args)),
            VX_OK)
      << vx_last_error();
  vx_result Result{};
  ASSERT_EQ(vx_wait(Large, &Result), VX_OK);
  EXPECT_EQ(Result.outcome, VX_OUTCOME_DONE) << Result.report;
  uint32_t Word = 0;
  ASSERT_EQ(vx_copy_from_device(Large, &Word, Args[0], 4), VX_OK);
  EXPECT_EQ(Word, 100U);
  // No range has the image in its middle.
  EXPECT_EQ(vx_copy_from_device(Large, &Word, VX_IMAGE_BASE - 2, 4),
            VX_ERROR_ARGUMENT);
  EXPECT_STREQ(vx_last_error(),
               "[0x7ffffffe, +0x4) is not inside global memory, expected a "
               "range in [0x10000, +0x7fff0000) or [0x81000000, +0x40010000)");
  EXPECT_EQ(vx_image_free(Kernels), VX_OK);
  EXPECT_EQ(vx_device_close(Large), VX_OK);
}

TEST_F(Runtime, CopiesFillsAndRangesAreChecked) {
  const uint32_t A = allocate(64), B = allocate(64);
  const uint32_t Pattern = 0x12345678;
  ASSERT_EQ(vx_fill_device(Device, A, &Pattern, 4, 64), VX_OK);
  ASSERT_EQ(vx_copy_on_device(Device, B, A, 64), VX_OK);
  EXPECT_EQ(words(B, 16), std::vector<uint32_t>(16, Pattern));
  EXPECT_EQ(vx_fill_device(Device, A, &Pattern, 4, 63), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_fill_device(Device, A, &Pattern, 0, 64), VX_ERROR_ARGUMENT);

  void *Host = nullptr;
  ASSERT_EQ(vx_mem_host_pointer(Device, B, 64, &Host), VX_OK);
  EXPECT_EQ(*static_cast<uint32_t *>(Host), Pattern);

  std::byte Bytes[16];
  const auto End = static_cast<uint32_t>(Info.global_base + Info.global_bytes);
  for (const uint32_t Bad :
       {0U, 0x40U, End - 8, VX_IMAGE_BASE, VX_LOCAL_BASE, 0xfffffff8U}) {
    EXPECT_EQ(vx_copy_from_device(Device, Bytes, Bad, 16), VX_ERROR_ARGUMENT);
    EXPECT_EQ(vx_copy_to_device(Device, Bad, Bytes, 16), VX_ERROR_ARGUMENT);
    EXPECT_EQ(vx_mem_host_pointer(Device, Bad, 16, &Host), VX_ERROR_ARGUMENT);
  }
  EXPECT_EQ(vx_copy_from_device(Device, Bytes, A, UINT64_MAX),
            VX_ERROR_ARGUMENT);
}

TEST_F(Runtime, CommandsAreTimedByDmaEngines) {
  uint64_t Number = 1;
  // Not this machine.
  EXPECT_EQ(Info.dma_engines, 0U);
  EXPECT_EQ(vx_command_begin(Device, nullptr, 0, nullptr, 0), VX_OK);
  EXPECT_EQ(vx_command_end(Device, &Number), VX_OK);
  EXPECT_EQ(Number, 0U);
  EXPECT_EQ(vx_command_begin(Device, nullptr, 1, nullptr, 0),
            VX_ERROR_ARGUMENT);
  EXPECT_STREQ(vx_last_error(), "after is NULL");

  vx_device *Timed = nullptr;
  ASSERT_EQ(vx_device_open(R"({"global_bytes": 8388608, "timing":
                               {"enabled": 1, "host": {"dma_engines": 2}}})",
                           &Timed),
            VX_OK)
      << vx_last_error();
  vx_image *Kernels = nullptr;
  ASSERT_EQ(vx_image_load_file(Timed, Elf, &Kernels), VX_OK);
  ASSERT_EQ(vx_device_get_info(Timed, &Info), VX_OK);
  EXPECT_EQ(Info.dma_engines, 2U);
  uint32_t Store = 0, To = 0;
  ASSERT_EQ(vx_image_find_kernel(Kernels, "store", &Store), VX_OK);
  ASSERT_EQ(vx_mem_alloc(Timed, 1 << 20, &To), VX_OK);
  const auto SecondsBehind = [&](const std::vector<uint64_t> &After) {
    EXPECT_EQ(vx_command_begin(Timed, After.data(),
                               static_cast<uint32_t>(After.size()), nullptr, 0),
              VX_OK);
    const uint32_t Args[] = {To, 100};
    EXPECT_EQ(vx_start(Timed, Kernels, Store, &OneItem, Args, sizeof(Args)),
              VX_OK);
    vx_result Result{};
    EXPECT_EQ(vx_wait(Timed, &Result), VX_OK);
    EXPECT_EQ(vx_command_end(Timed, &Number), VX_OK);
    EXPECT_NE(Number, 0U);
    return Result.device_seconds;
  };
  SecondsBehind({});
  const std::vector<char> Bytes(1 << 20);
  // A MiB at 3,282 MB/s.
  constexpr double CopySeconds = 319e-6;
  EXPECT_EQ(vx_copy_to_device(Timed, To, Bytes.data(), Bytes.size()), VX_OK);
  EXPECT_LT(SecondsBehind({}), CopySeconds / 2);
  const uint64_t Copy = Number - 1;
  EXPECT_GT(SecondsBehind({Copy}), CopySeconds / 2);
  EXPECT_EQ(vx_command_copy(Timed, VX_COPY_FILL, To, 0, 1 << 20), VX_OK);
  EXPECT_EQ(vx_command_settle(Timed), VX_OK);
  const uint64_t Never = 1000;
  EXPECT_EQ(vx_command_begin(Timed, &Never, 1, nullptr, 0), VX_ERROR_ARGUMENT);
  EXPECT_STREQ(vx_last_error(),
               "command 1000 has not been begun, expected a number from "
               "vx_command_end");
  EXPECT_EQ(vx_command_copy(Timed, VX_COPY_TO_DEVICE, 0, 0, 1),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_free(Kernels), VX_OK);
  EXPECT_EQ(vx_device_close(Timed), VX_OK);
}

TEST_F(Runtime, CopiesReachTheRasterWindow) {
  const auto At = [](unsigned Core, unsigned Csr) {
    return VX_IO_RASTER + Core * VX_IO_RASTER_STRIDE +
           4 * (Csr - VX_CSR_VR_STATUS);
  };
  const auto Write = [&](unsigned Csr, uint32_t Value) {
    EXPECT_EQ(vx_copy_to_device(Device, At(7, Csr), &Value, 4), VX_OK)
        << vx_last_error();
  };
  // A tile of one pixel without Gaussians: black, transmittance 1.
  const uint32_t Out = allocate(16);
  Write(VX_CSR_VR_OUTPUT, Out);
  Write(VX_CSR_VR_OUTPUT_PITCH, 16);
  Write(VX_CSR_VR_TILE_SHAPE, 0x00010001);
  Write(VX_CSR_VR_START, 0);
  EXPECT_EQ(words(At(7, VX_CSR_VR_WAIT), 1)[0], 0u);
  EXPECT_EQ(words(At(7, VX_CSR_VR_OUTPUT), 1)[0], Out);
  EXPECT_EQ(words(Out, 4), (std::vector<uint32_t>{0, 0, 0, 0x3f800000}));

  uint32_t Word[2] = {};
  const uint32_t Last = VX_GLOBAL_BASE - 4;
  for (const auto &[Address, Size] : {std::pair{At(8, VX_CSR_VR_OUTPUT), 4},
                                      {At(0, VX_CSR_VR_OUTPUT), 2},
                                      {At(0, VX_CSR_VR_OUTPUT) + 2, 4},
                                      {Last, 4},
                                      {Last, 8}}) {
    EXPECT_EQ(vx_copy_to_device(Device, Address, Word, Size),
              VX_ERROR_ARGUMENT);
    EXPECT_EQ(vx_copy_from_device(Device, Word, Address, Size),
              VX_ERROR_ARGUMENT);
  }
  EXPECT_EQ(vx_copy_to_device(Device, At(0, VX_CSR_VR_STATUS), Word, 4),
            VX_ERROR_ARGUMENT);
}

TEST(Device, TheRasterWindowHasAllCoresOfALargeMachine) {
  vx_device *Large = nullptr;
  ASSERT_EQ(vx_device_open(R"({"clusters": 1024, "sockets_per_cluster": 1,
                               "cores_per_socket": 4, "stack_bytes": 16384})",
                           &Large),
            VX_OK)
      << vx_last_error();
  vx_device_info Info{};
  EXPECT_EQ(vx_device_get_info(Large, &Info), VX_OK);
  EXPECT_EQ(Info.cores, 4096U);
  EXPECT_EQ(Info.rasterizers, 1024U);
  // The word is the last core's, and no memory of a buffer.
  const uint32_t Csr = VX_IO_RASTER + 4095 * VX_IO_RASTER_STRIDE +
                       4 * (VX_CSR_VR_OUTPUT - VX_CSR_VR_STATUS);
  EXPECT_LT(Csr, Info.global_base);
  EXPECT_GE(Csr + VX_IO_RASTER_STRIDE, Info.global_base);
  uint32_t Address = 0, Word = 0x12340, Read = 0;
  EXPECT_EQ(vx_mem_alloc(Large, 64, &Address), VX_OK);
  EXPECT_GE(Address, Info.global_base);
  EXPECT_EQ(vx_copy_to_device(Large, Csr, &Word, 4), VX_OK) << vx_last_error();
  EXPECT_EQ(vx_copy_from_device(Large, &Read, Csr, 4), VX_OK);
  EXPECT_EQ(Read, Word);
  EXPECT_EQ(vx_device_close(Large), VX_OK);
}

TEST_F(Runtime, ThreadsTakeTurns) {
  const uint32_t Out = allocate(4 * Info.cores);
  std::vector<std::thread> Threads;
  Threads.reserve(4);
  for (unsigned T = 0; T < 4; ++T)
    Threads.emplace_back([&] {
      for (unsigned I = 0; I < 20; ++I) {
        uint32_t Address = 0;
        EXPECT_EQ(vx_mem_alloc(Device, 1000, &Address), VX_OK);
        const vx_status Status = start("store", {Out, 1});
        EXPECT_TRUE(Status == VX_OK || Status == VX_ERROR_BUSY)
            << vx_last_error();
        EXPECT_EQ(vx_copy_on_device(Device, Address, Out, 4), VX_OK);
        EXPECT_EQ(vx_mem_free(Device, Address), VX_OK);
      }
    });
  for (std::thread &Thread : Threads)
    Thread.join();
  EXPECT_EQ(wait().outcome, VX_OUTCOME_DONE);
}

} // namespace
