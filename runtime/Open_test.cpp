/// How a device and an image are opened, and what is refused; what they do
/// then: Api_test.cpp.
#include "vorion/runtime.h"
#include "vorion/support/File.h"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace {

// KERNELS_ELF is given by the build.
constexpr const char *SmallMemory = R"({"global_bytes": 8388608})";

/// A configuration file that VORION_CONFIG names while this lives.
class ConfigOfEnvironment {
public:
  explicit ConfigOfEnvironment(const std::string &Text)
      : Path((std::filesystem::temp_directory_path() /
              ("vorion-config" + std::to_string(getpid())))
                 .string()) {
    EXPECT_TRUE(vorion::writeFileAtomically(Path, Text));
    EXPECT_EQ(setenv("VORION_CONFIG", Path.c_str(), 1), 0);
  }
  ~ConfigOfEnvironment() {
    unsetenv("VORION_CONFIG");
    std::error_code Ignored;
    std::filesystem::remove(Path, Ignored);
  }
  ConfigOfEnvironment(const ConfigOfEnvironment &) = delete;
  ConfigOfEnvironment &operator=(const ConfigOfEnvironment &) = delete;

private:
  std::string Path;
};

TEST(RuntimeOpen, ToolsThatTheMachineCannotServe) {
  const vx_option Options[] = {{"VORION_CONFIG", SmallMemory},
                               {"VORION_PIPELINE", "file=x,core=99"}};
  vx_device *Device = nullptr;
  EXPECT_EQ(vx_device_open_with(Options, 2, &Device), VX_ERROR_CONFIG);
  EXPECT_NE(std::string(vx_last_error())
                .find("core=99: the machine has 8 cores, expected 0 to 7"),
            std::string::npos);
}

TEST(RuntimeOpen, ClockForProfiledRunsOnly) {
  const vx_option Options[] = {{"VORION_CONFIG", SmallMemory},
                               {"VORION_TIME", "profiled"}};
  vx_device *Device = nullptr;
  ASSERT_EQ(vx_device_open_with(Options, 2, &Device), VX_OK) << vx_last_error();
  vx_image *Image = nullptr;
  ASSERT_EQ(vx_image_load_file(Device, KERNELS_ELF, &Image), VX_OK);
  uint32_t Kernel = 0;
  ASSERT_EQ(vx_image_find_kernel(Image, "exit_seven", &Kernel), VX_OK);
  const auto Report = [&] {
    const vx_launch_params Params{1, {1, 1, 1}, {1, 1, 1}, {0, 0, 0},
                                  0, nullptr,   0};
    vx_result Result{};
    EXPECT_EQ(vx_start(Device, Image, Kernel, &Params, nullptr, 0), VX_OK)
        << vx_last_error();
    EXPECT_EQ(vx_wait(Device, &Result), VX_OK);
    return std::string(Result.time_report);
  };
  EXPECT_EQ(Report(), "");
  EXPECT_EQ(vx_device_set_profiled(Device, 1), VX_OK);
  EXPECT_NE(Report().find("\"cycles\""), std::string::npos);
  EXPECT_EQ(vx_device_set_profiled(Device, 0), VX_OK);
  EXPECT_EQ(Report(), "");
  EXPECT_EQ(vx_image_free(Image), VX_OK);
  EXPECT_EQ(vx_device_close(Device), VX_OK);
}

TEST(RuntimeOpen, BadImagesAreRefused) {
  vx_device *Device = nullptr;
  ASSERT_EQ(vx_device_open(SmallMemory, &Device), VX_OK);
  vx_image *Image = nullptr;
  EXPECT_EQ(vx_image_load_file(Device, "/nonexistent.elf", &Image),
            VX_ERROR_FILE);
  EXPECT_EQ(vx_image_load(Device, "hello", 5, &Image), VX_ERROR_IMAGE);
  auto Bytes = vorion::readFile(KERNELS_ELF);
  ASSERT_TRUE(Bytes);
  EXPECT_EQ(vx_image_load(Device, Bytes->data(), Bytes->size() / 2, &Image),
            VX_ERROR_IMAGE);
  EXPECT_EQ(vx_image_load(Device, Bytes->data(), Bytes->size(), &Image), VX_OK)
      << vx_last_error();
  EXPECT_EQ(vx_image_free(Image), VX_OK);
  EXPECT_EQ(vx_device_close(Device), VX_OK);
}

TEST(RuntimeOpen, ConfigurationsByTextFileAndEnvironment) {
  vx_device *Device = nullptr;
  EXPECT_EQ(vx_device_open("{\"coars\": 1}", &Device), VX_ERROR_CONFIG);
  EXPECT_NE(std::string(vx_last_error()).find("coars"), std::string::npos)
      << vx_last_error();
  EXPECT_EQ(vx_device_open("/nonexistent.json", &Device), VX_ERROR_FILE);
  EXPECT_EQ(vx_device_open("/dev/null", &Device), VX_ERROR_FILE) << "no JSON";
  const vx_option Trace{"VORION_TRACE", "trap:/nonexistent/trace"};
  EXPECT_EQ(vx_device_open_with(&Trace, 1, &Device), VX_ERROR_FILE);

  {
    const ConfigOfEnvironment File(
        "{\"clusters\": 2, \"global_bytes\": 1048576}");
    ASSERT_EQ(vx_device_open(nullptr, &Device), VX_OK) << vx_last_error();
  }
  vx_device_info Info{};
  EXPECT_EQ(vx_device_get_info(Device, &Info), VX_OK);
  EXPECT_EQ(Info.cores, 16u);
  EXPECT_EQ(Info.rasterizers, 4u);

  // The configuration in force opens an equal machine.
  const char *Json = nullptr, *Again = nullptr;
  ASSERT_EQ(vx_device_get_config(Device, &Json), VX_OK);
  vx_device *Twin = nullptr;
  ASSERT_EQ(vx_device_open(Json, &Twin), VX_OK) << vx_last_error();
  ASSERT_EQ(vx_device_get_config(Twin, &Again), VX_OK);
  EXPECT_STREQ(Json, Again);
  EXPECT_EQ(vx_device_close(Twin), VX_OK);
  EXPECT_EQ(vx_device_close(Device), VX_OK);
}

TEST(RuntimeOpen, OptionsGoBeforeTheEnvironment) {
  const ConfigOfEnvironment File(R"({"clusters": 2, "global_bytes": 1048576})");
  vx_device *Device = nullptr;
  const auto CoresWith = [&](std::initializer_list<vx_option> Options) {
    vx_device_info Info{};
    EXPECT_EQ(vx_device_open_with(std::data(Options),
                                  static_cast<uint32_t>(Options.size()),
                                  &Device),
              VX_OK)
        << vx_last_error();
    EXPECT_EQ(vx_device_get_info(Device, &Info), VX_OK);
    EXPECT_EQ(vx_device_close(Device), VX_OK);
    return Info.cores;
  };
  EXPECT_EQ(CoresWith({}), 16u);
  EXPECT_EQ(CoresWith({{"VORION_SET", "clusters=1"}}), 8u);
  EXPECT_EQ(CoresWith({{"VORION_CONFIG", SmallMemory}}), 8u);

  const vx_option Wrong[] = {{"VORION_CLOCK", "on"},
                             {"VORION_TIME", "fast"},
                             {"VORION_TIME", nullptr},
                             {nullptr, "on"}};
  const vx_status Statuses[] = {VX_ERROR_ARGUMENT, VX_ERROR_CONFIG,
                                VX_ERROR_ARGUMENT, VX_ERROR_ARGUMENT};
  for (std::size_t I = 0; I != std::size(Wrong); ++I)
    EXPECT_EQ(vx_device_open_with(&Wrong[I], 1, &Device), Statuses[I])
        << vx_last_error();
}

TEST(RuntimeOpen, NullArgumentsNeverCrash) {
  vx_device *Device = nullptr;
  uint32_t Number = 0;
  uint64_t Size = 0;
  void *Pointer = nullptr;
  vx_device_info Info{};
  const char *Text = nullptr;
  vx_image *Image = nullptr;
  vx_kernel_info Kernel{};
  vx_arg_info Arg{};
  vx_launch_params Params{};
  vx_result Result{};
  EXPECT_EQ(vx_device_open("{}", nullptr), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_device_open_with(nullptr, 1, &Device), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_mem_written(nullptr, 1, 8), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_mem_read(nullptr, 1, 8), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_device_get_info(nullptr, &Info), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_device_get_config(nullptr, &Text), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_device_set_profiled(nullptr, 1), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_mem_alloc(nullptr, 1, &Number), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_mem_free(nullptr, 1), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_copy_to_device(nullptr, 1, &Size, 8), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_copy_from_device(nullptr, &Size, 1, 8), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_copy_on_device(nullptr, 1, 2, 8), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_fill_device(nullptr, 1, &Size, 8, 8), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_mem_host_pointer(nullptr, 1, 8, &Pointer), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_load(nullptr, &Size, 8, &Image), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_load_file(nullptr, "x", &Image), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_free(nullptr), VX_OK);
  EXPECT_EQ(vx_image_num_kernels(nullptr, &Number), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_find_kernel(nullptr, "x", &Number), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_get_kernel(nullptr, 0, &Kernel), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_get_arg(nullptr, 0, 0, &Arg), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_image_place_locals(nullptr, 0, &Size, 1, &Size, &Number),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_start(nullptr, nullptr, 0, &Params, nullptr, 0),
            VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_start_main(nullptr, nullptr), VX_ERROR_ARGUMENT);
  EXPECT_EQ(vx_wait(nullptr, &Result), VX_ERROR_ARGUMENT);
}

} // namespace
