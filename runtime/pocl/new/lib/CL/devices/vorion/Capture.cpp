#include "Capture.h"

#include "vorion/support/Environment.h"

#include <vorion_abi.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace vorion {

namespace {

/// What a global argument points to, in host memory.
std::string contentsOf(const pocl_argument &Argument, cl_device_id Device) {
  cl_mem Buffer = nullptr;
  if (Argument.value)
    std::memcpy(&Buffer, Argument.value, sizeof(Buffer));
  if (!Buffer || Buffer->size <= Argument.offset)
    return {};
  const auto *Bytes = static_cast<const char *>(
      Buffer->device_ptrs[Device->global_mem_id].mem_ptr);
  return {Bytes + Argument.offset, Buffer->size - Argument.offset};
}

/// Images and samplers are objects of the host, which vorion-sim cannot make.
bool takesImages(const pocl_kernel_metadata_t &Meta) {
  return std::any_of(Meta.arg_info, Meta.arg_info + Meta.num_args,
                     [](const pocl_argument_info &Info) {
                       return Info.type == POCL_ARG_TYPE_IMAGE ||
                              Info.type == POCL_ARG_TYPE_SAMPLER;
                     });
}

std::string hex(const void *Value, size_t Size) {
  std::string Text = "bytes:";
  std::array<char, 3> Byte{};
  for (size_t I = 0; I < Size; ++I) {
    snprintf(Byte.data(), Byte.size(), "%02x",
             static_cast<const unsigned char *>(Value)[I]);
    Text += Byte.data();
  }
  return Text;
}

std::string list(const size_t *Values, unsigned Count, const size_t *Factors) {
  std::string Text = "[";
  for (unsigned I = 0; I < Count; ++I)
    Text += (I ? ", " : "") + std::to_string(Values[I] * Factors[I]);
  return Text + "]";
}

/// \p Text as a JSON string.
std::string jsonText(const std::string &Text) {
  std::string Json = "\"";
  std::array<char, 7> Code{};
  for (const char C : Text) {
    if (C == '"' || C == '\\') {
      Json += {'\\', C};
    } else if (static_cast<unsigned char>(C) < ' ') {
      snprintf(Code.data(), Code.size(), "\\u%04x", C);
      Json += Code.data();
    } else {
      Json += C;
    }
  }
  return Json + "\"";
}

} // namespace

void captureLaunch(const LoadedKernel &Kernel,
                   const _cl_command_node &Command) {
  const char *Folder = environmentVariable("VORION_CAPTURE");
  if (!Folder)
    return;
  static std::atomic<unsigned> Launches{0};
  const _cl_command_run &Run = Command.command.run;
  const char *Missing =
      takesImages(*Run.kernel->meta)     ? "has images or samplers"
      : Kernel.Info.variables_bytes != 0 ? "uses variables of program scope"
      : Run.is_range_part                ? "has groups of several sizes"
                                         : nullptr;
  if (Missing) {
    fprintf(stderr,
            "vorion: warning: kernel %s %s, its launches are not kept\n",
            Run.kernel->name, Missing);
    return;
  }
  std::error_code Problem;
  fs::create_directories(Folder, Problem);
  // Whole names, so that it does not matter where the launch is repeated.
  const std::string Base =
      (fs::absolute(Folder, Problem) /
       (std::to_string(Launches++) + "-" + Run.kernel->name))
          .string();

  bool Good = true;
  std::string Arguments;
  for (unsigned I = 0; I < Run.kernel->meta->num_args; ++I) {
    const pocl_argument &Argument = Run.arguments[I];
    vx_arg_info Info;
    if (vx_image_get_arg(Kernel.Image.get(), Kernel.Number, I, &Info) != VX_OK)
      return;
    std::string Text;
    if (Info.kind == VX_ARG_LOCAL) {
      Text = "local:" + std::to_string(Argument.size);
    } else if (Info.kind == VX_ARG_GLOBAL) {
      const std::string Bytes = contentsOf(Argument, Command.device);
      const std::string File = Base + "." + std::to_string(I) + ".bin";
      Text = Bytes.empty() ? "u32:0" : "buf@" + File;
      if (!Bytes.empty())
        Good &= bool(std::ofstream(File, std::ios::binary) << Bytes);
    } else {
      std::vector<char> Value(Info.size);
      if (Argument.value)
        std::memcpy(Value.data(), Argument.value,
                    std::min<size_t>(Info.size, Argument.size));
      Text = hex(Value.data(), Value.size());
    }
    Arguments += (I ? ", " : "") + jsonText(Text);
  }

  const pocl_context &Grid = Run.pc;
  constexpr std::array<size_t, 3> Ones{1, 1, 1};
  fs::copy_file(Kernel.Path, Base + ".elf",
                fs::copy_options::overwrite_existing, Problem);
  Good &= !Problem;
  Good &= bool(std::ofstream(Base + ".json")
               << "{\"kernel\": \"" << Run.kernel->name << "\", \"global\": "
               << list(Grid.num_groups, Grid.work_dim, Grid.local_size)
               << ", \"local\": "
               << list(Grid.local_size, Grid.work_dim, Ones.data())
               << ", \"args\": [" << Arguments << "]}\n");
  if (!Good)
    fprintf(stderr,
            "vorion: warning: %s: the launch cannot be kept, expected a folder "
            "that can be written\n",
            Folder);
}

} // namespace vorion
