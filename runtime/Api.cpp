/// The C functions of vorion/runtime.h: arguments are checked, statuses and the
/// last error's text are kept, and no exception leaves.

#include "Device.h"
#include "Options.h"
#include "vorion/support/File.h"
#include "vorion/support/Printable.h"
#include "vorion_abi.h"

#include <cstring>
#include <exception>
#include <fmt/format.h>
#include <span>

using namespace vorion;
using namespace vorion::runtime;

// C names, as the header has them.
// NOLINTBEGIN(readability-identifier-naming)

/// The handles of the C interface.
struct vx_device {
  vx_device(std::unique_ptr<isasim::Machine> Machine,
            std::unique_ptr<isasim::Session> Watch, bool OnlyProfiled)
      : Impl(std::move(Machine), std::move(Watch), OnlyProfiled) {}
  Device Impl;
};
struct vx_image {
  vx_image(vx_device *Owner, std::shared_ptr<const isasim::Image> Program)
      : Owner(Owner), Impl(std::move(Program)) {}
  vx_device *Owner;
  LoadedImage Impl;
};

namespace {

thread_local std::string LastError;

/// Runs \p Body, which returns a Failure, and keeps the text of one.
template <typename Function> vx_status guarded(Function Body) noexcept {
  try {
    Failure Failed = Body();
    if (Failed)
      LastError = escapedLines(Failed.Text);
    return Failed.Status;
  } catch (const std::bad_alloc &) {
    LastError.clear(); // fits without allocating
    LastError = "no host memory";
    return VX_ERROR_INTERNAL;
  } catch (const std::exception &E) {
    LastError = E.what();
    return VX_ERROR_INTERNAL;
  }
}

Failure isNull(const char *Name) {
  return badArgument(fmt::format("{} is NULL", Name));
}

/// The texts that \p Given sets, else the environment's variables.
Failure findOptions(std::span<const vx_option> Given, DeviceOptions &Options) {
  Options = DeviceOptions::fromEnvironment();
  for (const vx_option &Option : Given) {
    if (!Option.name || !Option.text)
      return isNull(Option.name ? "text" : "name");
    std::string *Text = Options.find(Option.name);
    if (!Text)
      return badArgument(fmt::format("no option '{}', expected the name of an "
                                     "environment variable (docs/debugging.md)",
                                     Option.name));
    *Text = Option.text;
  }
  return {};
}

Failure openDevice(std::span<const vx_option> Given, vx_device **Device) {
  DeviceOptions Options;
  if (Failure Failed = findOptions(Given, Options))
    return Failed;
  isasim::Config Config = isasim::defaultMachine();
  if (Failure Failed = Options.machine(Config))
    return Failed;
  // Its plugins have policies of the machine.
  auto Watch = isasim::Session::create(Options.Watch, "vorion",
                                       isasim::NamedBy::Variable);
  if (!Watch)
    return cannotOpen(Watch.error());
  auto Machine = isasim::Machine::create(Config);
  if (!Machine)
    return cannotOpen(Options.ofMachine(Machine.error()));
  if (const auto Attached = (*Watch)->attach(**Machine); !Attached)
    return cannotOpen(Attached.error());
  *Device = new vx_device(std::move(*Machine), std::move(*Watch),
                          Options.onlyProfiled());
  return {};
}

Failure loadImage(vx_device *Device, std::span<const std::byte> Elf,
                  const std::string &Name, vx_image **Image) {
  auto Program = isasim::Image::parse(Elf, Name);
  if (!Program)
    return failure(VX_ERROR_IMAGE, Program.error());
  if (const auto Fits = (*Program)->checkLanes(Device->Impl.info().lanes);
      !Fits)
    return failure(VX_ERROR_IMAGE, Fits.error());
  *Image = new vx_image(Device, std::move(*Program));
  return {};
}

Failure findKernel(const vx_image *Image, uint32_t Number,
                   const isasim::Kernel **Kernel) {
  if (!Image)
    return isNull("image");
  const auto &Kernels = Image->Impl.program().kernels();
  if (Number >= Kernels.size())
    return {VX_ERROR_NOT_FOUND, fmt::format("kernel {} of an image with {}",
                                            Number, Kernels.size())};
  *Kernel = &Kernels[Number];
  return {};
}

Failure placeLocals(const vx_image &Image, const isasim::Kernel &Kernel,
                    std::span<const uint64_t> Sizes, std::byte *PackedArgs,
                    uint32_t &Total) {
  isasim::LocalPlaces Places(Kernel, Image.Owner->Impl.config());
  std::size_t Next = 0;
  std::vector<std::pair<uint32_t, uint32_t>> Placed;
  for (const isasim::KernelArg &Arg : Kernel.Args) {
    if (Arg.Kind != VX_ARG_LOCAL)
      continue;
    if (Next == Sizes.size())
      return badArgument(
          fmt::format("{} sizes of local-memory arguments, kernel {} has more",
                      Sizes.size(), Kernel.Name));
    const auto Address = Places.place(Sizes[Next++]);
    if (!Address)
      return failure(VX_ERROR_MEMORY, Address.error());
    Placed.emplace_back(Arg.Offset, *Address);
  }
  if (Next != Sizes.size())
    return badArgument(
        fmt::format("{} sizes of local-memory arguments, kernel {} has {}",
                    Sizes.size(), Kernel.Name, Next));
  for (const auto &[Offset, Address] : Placed)
    std::memcpy(PackedArgs + Offset, &Address, sizeof(Address));
  Total = static_cast<uint32_t>(Places.used());
  return {};
}

} // namespace

extern "C" {

const char *vx_last_error(void) { return LastError.c_str(); }

vx_status vx_device_open(const char *config, vx_device **device) {
  const vx_option Option{"VORION_CONFIG", config};
  return vx_device_open_with(&Option, config ? 1 : 0, device);
}

vx_status vx_device_open_with(const vx_option *options, uint32_t num_options,
                              vx_device **device) {
  return guarded([&]() -> Failure {
    if (!device || (!options && num_options))
      return isNull(device ? "options" : "device");
    return openDevice({options, num_options}, device);
  });
}

vx_status vx_device_close(vx_device *device) {
  return guarded([&]() -> Failure {
    delete device;
    return {};
  });
}

vx_status vx_device_set_profiled(vx_device *device, int profiled) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    device->Impl.setProfiled(profiled != 0);
    return {};
  });
}

vx_status vx_device_get_info(vx_device *device, vx_device_info *info) {
  return guarded([&]() -> Failure {
    if (!device || !info)
      return isNull(device ? "info" : "device");
    *info = device->Impl.info();
    return {};
  });
}

vx_status vx_device_get_config(vx_device *device, const char **json) {
  return guarded([&]() -> Failure {
    if (!device || !json)
      return isNull(device ? "json" : "device");
    *json = device->Impl.configText().c_str();
    return {};
  });
}

vx_status vx_mem_alloc(vx_device *device, uint64_t size, uint32_t *address) {
  return guarded([&]() -> Failure {
    if (!device || !address)
      return isNull(device ? "address" : "device");
    return device->Impl.allocate(size, *address);
  });
}

vx_status vx_mem_free(vx_device *device, uint32_t address) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    return device->Impl.release(address);
  });
}

vx_status vx_copy_to_device(vx_device *device, uint32_t to, const void *from,
                            uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device || !from)
      return isNull(device ? "from" : "device");
    return device->Impl.copyIn(to, from, size);
  });
}

vx_status vx_copy_from_device(vx_device *device, void *to, uint32_t from,
                              uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device || !to)
      return isNull(device ? "to" : "device");
    return device->Impl.copyOut(to, from, size);
  });
}

vx_status vx_copy_on_device(vx_device *device, uint32_t to, uint32_t from,
                            uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    return device->Impl.copyWithin(to, from, size);
  });
}

vx_status vx_fill_device(vx_device *device, uint32_t to, const void *pattern,
                         uint32_t pattern_size, uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device || !pattern)
      return isNull(device ? "pattern" : "device");
    return device->Impl.fill(to, pattern, pattern_size, size);
  });
}

vx_status vx_mem_host_pointer(vx_device *device, uint32_t address,
                              uint64_t size, void **pointer) {
  return guarded([&]() -> Failure {
    if (!device || !pointer)
      return isNull(device ? "pointer" : "device");
    return device->Impl.hostPointer(address, size, pointer);
  });
}

vx_status vx_mem_written(vx_device *device, uint32_t address, uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    return device->Impl.hostWrote(address, size);
  });
}

vx_status vx_mem_read(vx_device *device, uint32_t address, uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    return device->Impl.hostRead(address, size);
  });
}

vx_status vx_command_begin(vx_device *device, const uint64_t *after,
                           uint32_t num_after, const uint64_t *host_after,
                           uint32_t num_host_after) {
  return guarded([&]() -> Failure {
    if (!device || (num_after && !after) || (num_host_after && !host_after))
      return isNull(!device               ? "device"
                    : num_after && !after ? "after"
                                          : "host_after");
    return device->Impl.beginCommand(
        {{after, after + num_after},
         {host_after, host_after + num_host_after}});
  });
}

vx_status vx_command_end(vx_device *device, uint64_t *number) {
  return guarded([&]() -> Failure {
    if (!device || !number)
      return isNull(device ? "number" : "device");
    return device->Impl.endCommand(*number);
  });
}

vx_status vx_command_copy(vx_device *device, vx_copy_kind kind,
                          uint32_t address, uint32_t from, uint64_t size) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    if (kind > VX_COPY_FILL)
      return badArgument(fmt::format("kind {} of a copy, expected 0 to {}",
                                     static_cast<unsigned>(kind),
                                     static_cast<unsigned>(VX_COPY_FILL)));
    return device->Impl.copied(
        {static_cast<isasim::HostCopy::Kind>(kind), address, from, size});
  });
}

vx_status vx_command_settle(vx_device *device) {
  return guarded([&]() -> Failure {
    if (!device)
      return isNull("device");
    return device->Impl.settle();
  });
}

vx_status vx_image_load(vx_device *device, const void *elf, size_t size,
                        vx_image **image) {
  return guarded([&]() -> Failure {
    if (!device || !elf || !image)
      return isNull(!device ? "device" : !elf ? "elf" : "image");
    return loadImage(device, {static_cast<const std::byte *>(elf), size},
                     "program", image);
  });
}

vx_status vx_image_load_file(vx_device *device, const char *path,
                             vx_image **image) {
  return guarded([&]() -> Failure {
    if (!device || !path || !image)
      return isNull(!device ? "device" : !path ? "path" : "image");
    const auto Bytes = readFile(path);
    if (!Bytes)
      return failure(VX_ERROR_FILE, Bytes.error());
    return loadImage(device, *Bytes, path, image);
  });
}

vx_status vx_image_free(vx_image *image) {
  return guarded([&]() -> Failure {
    if (image)
      image->Owner->Impl.forget(&image->Impl);
    delete image;
    return {};
  });
}

vx_status vx_image_num_kernels(vx_image *image, uint32_t *count) {
  return guarded([&]() -> Failure {
    if (!image || !count)
      return isNull(image ? "count" : "image");
    *count = static_cast<uint32_t>(image->Impl.program().kernels().size());
    return {};
  });
}

vx_status vx_image_find_kernel(vx_image *image, const char *name,
                               uint32_t *kernel) {
  return guarded([&]() -> Failure {
    if (!image || !name || !kernel)
      return isNull(!image ? "image" : !name ? "name" : "kernel");
    const isasim::Kernel *Found = image->Impl.program().findKernel(name);
    if (!Found)
      return {VX_ERROR_NOT_FOUND,
              fmt::format("the image has no kernel {}", name)};
    *kernel =
        static_cast<uint32_t>(Found - image->Impl.program().kernels().data());
    return {};
  });
}

vx_status vx_image_get_kernel(vx_image *image, uint32_t kernel,
                              vx_kernel_info *info) {
  return guarded([&]() -> Failure {
    const isasim::Kernel *Found = nullptr;
    if (Failure Failed = findKernel(image, kernel, &Found))
      return Failed;
    if (!info)
      return isNull("info");
    info->name = Found->Name.c_str();
    info->num_args = static_cast<uint32_t>(Found->Args.size());
    info->args_bytes = Found->ArgsBytes;
    info->context_bytes = Found->ContextBytes;
    info->local_bytes = Found->LocalBytes;
    for (unsigned I = 0; I < 3; ++I)
      info->local_size[I] = Found->LocalSize[I];
    info->lanes = Found->Lanes;
    info->variables_bytes = Found->Variables.Bytes;
    info->stack_bytes = Found->StackBytes;
    return {};
  });
}

vx_status vx_image_get_arg(vx_image *image, uint32_t kernel, uint32_t arg,
                           vx_arg_info *info) {
  return guarded([&]() -> Failure {
    const isasim::Kernel *Found = nullptr;
    if (Failure Failed = findKernel(image, kernel, &Found))
      return Failed;
    if (!info)
      return isNull("info");
    if (arg >= Found->Args.size())
      return {VX_ERROR_NOT_FOUND,
              fmt::format("argument {} of kernel {} with {}", arg, Found->Name,
                          Found->Args.size())};
    const isasim::KernelArg &Arg = Found->Args[arg];
    *info = {Arg.Name.c_str(), Arg.Kind, Arg.Offset, Arg.Size};
    return {};
  });
}

vx_status vx_image_place_locals(vx_image *image, uint32_t kernel,
                                const uint64_t *sizes, uint32_t num_sizes,
                                void *packed_args, uint32_t *total) {
  return guarded([&]() -> Failure {
    const isasim::Kernel *Found = nullptr;
    if (Failure Failed = findKernel(image, kernel, &Found))
      return Failed;
    if (num_sizes && (!sizes || !packed_args))
      return isNull(sizes ? "packed_args" : "sizes");
    uint32_t Used = 0;
    Failure Failed = placeLocals(*image, *Found, {sizes, num_sizes},
                                 static_cast<std::byte *>(packed_args), Used);
    if (!Failed && total)
      *total = Used;
    if (!Failed)
      image->Owner->Impl.localUsed(Used);
    return Failed;
  });
}

vx_status vx_variables_alloc(vx_image *image, uint32_t kernel,
                             uint32_t *address) {
  return guarded([&]() -> Failure {
    const isasim::Kernel *Found = nullptr;
    if (Failure Failed = findKernel(image, kernel, &Found))
      return Failed;
    if (!address)
      return isNull("address");
    if (Found->Variables.Bytes == 0)
      return {VX_ERROR_NOT_FOUND,
              fmt::format("kernel {} uses no variables of program scope",
                          Found->Name)};
    return image->Owner->Impl.allocateVariables(image->Impl, *Found, *address);
  });
}

vx_status vx_start(vx_device *device, vx_image *image, uint32_t kernel,
                   const vx_launch_params *params, const void *args,
                   uint32_t args_bytes) {
  return guarded([&]() -> Failure {
    if (!device || !image || !params)
      return isNull(!device ? "device" : !image ? "image" : "params");
    if (image->Owner != device)
      return badArgument("the image belongs to another device");
    return device->Impl.start(image->Impl, kernel, *params, args, args_bytes);
  });
}

vx_status vx_start_main(vx_device *device, vx_image *image) {
  return guarded([&]() -> Failure {
    if (!device || !image)
      return isNull(device ? "image" : "device");
    if (image->Owner != device)
      return badArgument("the image belongs to another device");
    return device->Impl.startMain(image->Impl);
  });
}

vx_status vx_wait(vx_device *device, vx_result *result) {
  return guarded([&]() -> Failure {
    if (!device || !result)
      return isNull(device ? "result" : "device");
    return device->Impl.wait(*result);
  });
}

} // extern "C"

// NOLINTEND(readability-identifier-naming)
