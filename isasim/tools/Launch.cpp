#include "tools/Launch.h"

#include "core/IsaTables.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"

#include <cstring>
#include <fmt/format.h>

namespace vorion::isasim {

namespace {

/// Of buffers and local arguments (docs/abi.md, "Launch block").
constexpr uint64_t Alignment = 128;
constexpr uint32_t PrintBytes = 1 << 20;
constexpr uint64_t MaxGroupItems = 1024;
/// Work-items of a group along x where neither the user nor the kernel says.
constexpr uint32_t PreferredGroup = 64;

uint64_t alignUp(uint64_t Value) {
  return (Value + Alignment - 1) / Alignment * Alignment;
}

Error usage(std::string What) { return {"", std::move(What), ExitCode::Usage}; }

/// The group size to use, checked against the kernel and the global size.
Expected<std::array<uint32_t, 3>> groupSize(const Kernel &K,
                                            const KernelRequest &R) {
  std::array<uint32_t, 3> Local = R.Local;
  if (Local[0] == 0) {
    Local = K.LocalSize;
    if (Local[0] == 0) {
      Local = {std::min(R.Global[0], PreferredGroup), 1, 1};
      while (R.Global[0] % Local[0] != 0)
        --Local[0];
    }
  }
  uint64_t Items = 1;
  for (unsigned Dim = 0; Dim != 3; ++Dim) {
    if (K.LocalSize[0] != 0 && Local[Dim] != K.LocalSize[Dim])
      return usage(fmt::format("kernel '{}' was compiled for groups of "
                               "{},{},{}",
                               K.Name, K.LocalSize[0], K.LocalSize[1],
                               K.LocalSize[2]));
    if (R.Global[Dim] % Local[Dim] != 0)
      return usage(fmt::format("--global {} is not a multiple of --local {} "
                               "in dimension {}",
                               R.Global[Dim], Local[Dim], Dim));
    Items = std::min<uint64_t>(Items * Local[Dim], MaxGroupItems + 1);
  }
  if (Items > MaxGroupItems)
    return usage(fmt::format("groups of {},{},{}, expected at most {} "
                             "work-items",
                             Local[0], Local[1], Local[2], MaxGroupItems));
  return Local;
}

} // namespace

Expected<uint32_t> KernelLaunch::reserve(uint64_t Bytes,
                                         const std::string &What) {
  const uint64_t Address = NextFree;
  const uint64_t End = VX_GLOBAL_BASE + M->config().GlobalBytes;
  if (Address > End || Bytes > End - Address)
    return usage(fmt::format("{} bytes more do not fit the {} bytes of global "
                             "memory",
                             Bytes, M->config().GlobalBytes));
  Watch->allocated(static_cast<uint32_t>(Address), Bytes, What);
  NextFree =
      alignUp(Address + std::max<uint64_t>(Bytes, 1) + Watch->guardBytes());
  return static_cast<uint32_t>(Address);
}

Expected<uint32_t> KernelLaunch::placeBuffer(const KernelInput &In,
                                             const std::string &ArgName) {
  std::vector<std::byte> Contents;
  uint64_t Bytes = In.Size;
  if (!In.ReadFrom.empty()) {
    Expected<std::vector<std::byte>> File = readFile(In.ReadFrom);
    if (!File)
      return File.error();
    Contents = std::move(*File);
    Bytes = Contents.size();
  }
  const Expected<uint32_t> Address =
      reserve(Bytes, fmt::format("buffer '{}'", ArgName));
  if (!Address)
    return Address;
  M->write(*Address, Contents);
  // Without a file it is zeros by definition.
  Watch->written(*Address, Bytes);
  if (!In.WriteTo.empty())
    Outputs.push_back({In.WriteTo, *Address, Bytes});
  return Address;
}

Expected<Success> KernelLaunch::packArguments(const Kernel &K,
                                              const KernelRequest &R) {
  if (R.Args.size() != K.Args.size())
    return usage(fmt::format("{} arguments, expected {} for kernel '{}'",
                             R.Args.size(), K.Args.size(), K.Name));
  const auto NoRoom = [&] {
    return usage(fmt::format("kernel '{}' needs more than the {} bytes of "
                             "local memory",
                             K.Name, M->config().LocalBytes));
  };
  if (K.LocalBytes > M->config().LocalBytes)
    return NoRoom();
  std::vector<std::byte> Packed(K.ArgsBytes);
  uint64_t LocalEnd = alignUp(K.LocalBytes), LocalUsed = K.LocalBytes;
  for (size_t N = 0; N != K.Args.size(); ++N) {
    const KernelArg &Arg = K.Args[N];
    const Expected<KernelInput> In = parseInput(R.Args[N]);
    if (!In)
      return In.error();
    constexpr const char *Kinds[] = {"a value", "a buffer", "local memory"};
    if (static_cast<uint32_t>(In->What) != Arg.Kind)
      return usage(fmt::format("argument {} of '{}' ({}) is '{}', expected {}",
                               N, K.Name, Arg.Name, R.Args[N],
                               Kinds[Arg.Kind]));
    std::vector<std::byte> Bytes = In->Bytes;
    uint32_t Address = 0;
    if (In->What == KernelInput::Buffer) {
      const Expected<uint32_t> Placed = placeBuffer(*In, Arg.Name);
      if (!Placed)
        return Placed.error();
      Address = *Placed;
    } else if (In->What == KernelInput::Local) {
      if (In->Size > M->config().LocalBytes ||
          LocalEnd + In->Size > M->config().LocalBytes)
        return NoRoom();
      Address = VX_LOCAL_BASE + static_cast<uint32_t>(LocalEnd);
      LocalUsed = LocalEnd + In->Size;
      LocalEnd = alignUp(LocalUsed);
    }
    if (In->What != KernelInput::Value) {
      Bytes.resize(sizeof(Address));
      std::memcpy(Bytes.data(), &Address, sizeof(Address));
    }
    if (Bytes.size() != Arg.Size)
      return usage(fmt::format("argument {} of '{}' ({}) has {} bytes, "
                               "expected {}",
                               N, K.Name, Arg.Name, Bytes.size(), Arg.Size));
    std::copy(Bytes.begin(), Bytes.end(), Packed.begin() + Arg.Offset);
  }
  const Expected<uint32_t> Address = reserve(Packed.size(), "the arguments");
  if (!Address)
    return Address.error();
  Args = *Address;
  M->write(Args, Packed);
  Watch->written(Args, Packed.size());
  Watch->useLocal(LocalUsed);
  return Success{};
}

Expected<Success>
KernelLaunch::writeBlock(const Kernel &K, const KernelRequest &R,
                         const std::array<uint32_t, 3> &Local) {
  VxLaunch L{};
  L.Entry = K.Entry;
  L.Args = Args;
  L.WorkDim = R.WorkDim;
  uint64_t Items = 1;
  for (unsigned Dim = 0; Dim != 3; ++Dim) {
    L.NumGroups[Dim] = R.Global[Dim] / Local[Dim];
    L.LocalSize[Dim] = Local[Dim];
    Items *= Local[Dim];
  }
  const uint64_t Stride = alignUp(K.contextBytesOf(Items));
  const Expected<uint32_t> Context =
      reserve(Stride * M->config().cores(), "the memory kept across barriers");
  if (!Context)
    return Context.error();
  const Expected<uint32_t> Print = reserve(PrintBytes, "the print buffer");
  if (!Print)
    return Print.error();
  const Expected<uint32_t> Address = reserve(sizeof(L), "the launch block");
  if (!Address)
    return Address.error();
  L.Context = *Context;
  L.ContextStride = static_cast<uint32_t>(Stride);
  L.PrintBuffer = *Print;
  L.PrintCapacity = PrintBytes;
  Block = *Address;
  PrintBuffer = *Print;
  M->write(Block, std::as_bytes(std::span(&L, 1)));
  Watch->written(Block, sizeof(L));
  return Success{};
}

Expected<KernelLaunch> KernelLaunch::prepare(Machine &M, const KernelRequest &R,
                                             Session &Watch) {
  const Image &Program = *M.image();
  const Kernel *K = Program.findKernel(R.Kernel);
  if (R.Kernel.empty() && Program.kernels().size() == 1)
    K = &Program.kernels().front();
  if (!K) {
    std::string Names;
    for (const Kernel &Each : Program.kernels())
      Names += " " + Each.Name;
    return Error{Program.name(),
                 R.Kernel.empty()
                     ? "more or less than one kernel, expected --kernel to "
                       "name one of:" +
                           Names
                     : fmt::format("no kernel '{}', expected one of:{}",
                                   R.Kernel, Names),
                 ExitCode::Usage};
  }
  const Expected<std::array<uint32_t, 3>> Local = groupSize(*K, R);
  if (!Local)
    return Local.error();
  KernelLaunch L(M, Watch);
  L.Name = K->Name;
  L.NextFree = VX_GLOBAL_BASE;
  if (Expected<Success> Ok = L.packArguments(*K, R); !Ok)
    return Ok.error();
  if (Expected<Success> Ok = L.writeBlock(*K, R, *Local); !Ok)
    return Ok.error();
  return L;
}

Expected<Success> KernelLaunch::finish() const {
  VxLaunch L{};
  M->read(Block, std::as_writable_bytes(std::span(&L, 1)));
  // The program may have written anything there: only how much it printed is
  // taken from it.
  std::string Text(std::min(L.PrintUsed, PrintBytes), '\0');
  M->read(PrintBuffer, std::as_writable_bytes(std::span(Text)));
  std::fwrite(Text.data(), 1, Text.size(), stdout);
  if (L.PrintUsed > PrintBytes)
    printOut("[{} bytes of printf dropped]\n", L.PrintUsed - PrintBytes);
  for (const Output &O : Outputs) {
    const std::byte *From = M->hostPointer(O.Address, O.Bytes);
    if (Expected<Success> Ok = writeFileAtomically(O.File, From, O.Bytes); !Ok)
      return Ok;
  }
  return Success{};
}

} // namespace vorion::isasim
