#include "tools/Launch.h"

#include "core/IsaTables.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::isasim {

namespace {

/// Work-items of a group along x where neither the user nor the kernel says.
constexpr uint32_t PreferredGroup = 64;

Error usage(std::string What) { return {"", std::move(What), ExitCode::Usage}; }

/// Why \p P has no kernel to run where \p Asked, a name or nothing, was given.
Error noKernel(const Image &P, const std::string &Asked) {
  std::vector<std::string> Names;
  for (const Kernel &Each : P.kernels())
    Names.push_back(Each.Name);
  const std::string Listed = fmt::format("{}", fmt::join(Names, " "));
  std::string What;
  if (Names.empty())
    What = "no kernels, expected a program with at least one";
  else if (Asked.empty())
    What = fmt::format("{} kernels, expected --kernel to name one of: {}",
                       Names.size(), Listed);
  else
    What = fmt::format("no kernel '{}', expected one of: {}{}", Asked, Listed,
                       didYouMean(Asked, Names));
  return {P.name(), std::move(What), ExitCode::Usage};
}

/// Whether an argument of \p Kind takes \p In. Bytes may be of any type, and
/// kernels of C say none.
bool fits(KernelInput::Kind In, uint32_t Kind) {
  const auto IsValue = [](uint32_t K) {
    return K == VX_ARG_VALUE || K == VX_ARG_INTEGER || K == VX_ARG_FLOAT;
  };
  const uint32_t Given = In;
  return Given == Kind || (IsValue(Given) && IsValue(Kind) &&
                           (Given == VX_ARG_VALUE || Kind == VX_ARG_VALUE));
}

/// The groups that \p R asks for, or that suit \p K where it does not say.
Expected<LaunchShape> shapeOf(const Kernel &K, const KernelRequest &R) {
  std::array<uint32_t, 3> Local = R.Local;
  if (Local[0] == 0) {
    Local = K.LocalSize;
    if (Local[0] == 0) {
      Local = {std::min(R.Global[0], PreferredGroup), 1, 1};
      while (R.Global[0] % Local[0] != 0)
        --Local[0];
    }
  }
  LaunchShape S{.WorkDim = R.WorkDim, .LocalSize = Local};
  for (unsigned Dim = 0; Dim != 3; ++Dim) {
    if (R.Global[Dim] % Local[Dim] != 0)
      return usage(fmt::format("--global {} is not a multiple of --local {} "
                               "in dimension {}",
                               R.Global[Dim], Local[Dim], Dim));
    S.NumGroups[Dim] = R.Global[Dim] / Local[Dim];
  }
  return S;
}

} // namespace

Expected<uint32_t> KernelLaunch::reserve(uint64_t Bytes,
                                         const std::string &What) {
  for (const AddressRange &Part : globalRanges(Device->config())) {
    const uint64_t Address = std::max<uint64_t>(NextFree, Part.Base);
    const uint64_t End = std::min(Part.Base + Part.Bytes, StacksBegin);
    if (Address > End || Bytes > End - Address)
      continue;
    Watch->allocated(static_cast<uint32_t>(Address), Bytes, What);
    NextFree = alignLaunch(Address + std::max<uint64_t>(Bytes, 1) +
                           Watch->guardBytes());
    return static_cast<uint32_t>(Address);
  }
  return Error{"",
               fmt::format("{}: {} bytes, more than the largest free block of "
                           "the {} bytes of global memory",
                           What, Bytes, globalBytes(Device->config())),
               ExitCode::LimitReached};
}

Expected<uint32_t> KernelLaunch::placeBuffer(const KernelInput &In,
                                             size_t Argument,
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
  Device->write(*Address, Contents);
  // Without a file it is zeros by definition.
  Watch->hostWrote(*Address, Bytes);
  Given.push_back({Argument, Bytes, Contents.empty()});
  if (!In.WriteTo.empty())
    Outputs.push_back({In.WriteTo, *Address, Bytes});
  return Address;
}

Expected<uint64_t> KernelLaunch::packArguments(const Kernel &K,
                                               const KernelRequest &R) {
  constexpr const char *Kinds[] = {"a value", "a buffer", "local memory",
                                   "a whole number", "a float, as f32:X"};
  if (R.Args.size() != K.Args.size()) {
    std::string Wanted;
    for (const KernelArg &Arg : K.Args)
      Wanted += fmt::format("{}{} ({})", Wanted.empty() ? ": " : ", ", Arg.Name,
                            Kinds[Arg.Kind]);
    return usage(fmt::format("{}, expected {} for kernel '{}'{}",
                             counted(R.Args.size(), "argument"), K.Args.size(),
                             K.Name, Wanted));
  }
  Args.resize(K.ArgsBytes);
  LocalPlaces Locals(K, Device->config());
  for (size_t N = 0; N != K.Args.size(); ++N) {
    const KernelArg &Arg = K.Args[N];
    const Expected<KernelInput> In = parseInput(R.Args[N]);
    if (!In)
      return In.error();
    if (!fits(In->What, Arg.Kind))
      return usage(fmt::format("argument {} of '{}' ({}) is '{}', expected {}",
                               N, K.Name, Arg.Name, R.Args[N],
                               Kinds[Arg.Kind]));
    std::vector<std::byte> Bytes = In->Bytes;
    uint32_t Address = 0;
    if (In->What == KernelInput::Buffer) {
      const Expected<uint32_t> Placed = placeBuffer(*In, N, Arg.Name);
      if (!Placed)
        return Placed.error();
      Address = *Placed;
    } else if (In->What == KernelInput::Local) {
      const Expected<uint32_t> Placed = Locals.place(In->Size);
      if (!Placed)
        return usage(Placed.error().What);
      Address = *Placed;
      Given.push_back({N, In->Size});
    }
    if (In->What == KernelInput::Buffer || In->What == KernelInput::Local) {
      Bytes.resize(sizeof(Address));
      std::memcpy(Bytes.data(), &Address, sizeof(Address));
    }
    if (Bytes.size() != Arg.Size)
      return usage(fmt::format("argument {} of '{}' ({}) has {} bytes, "
                               "expected {}",
                               N, K.Name, Arg.Name, Bytes.size(), Arg.Size));
    std::copy(Bytes.begin(), Bytes.end(), Args.begin() + Arg.Offset);
  }
  Watch->localUsed(Locals.used());
  Watch->memoryGiven(Given);
  return Locals.used();
}

Expected<Success> KernelLaunch::write(const Launch &L, const Kernel &K) {
  const LaunchParts &Bytes = L.bytes();
  StacksBegin = L.stacksBegin();
  if (NextFree > StacksBegin)
    return Error{
        "",
        fmt::format(
            "kernel {} needs stacks from 0x{:x} on, which overlap its buffers",
            K.Name, StacksBegin),
        ExitCode::LimitReached};
  for (const auto &[Part, What] :
       {std::pair(&LaunchParts::Args, "the arguments"),
        std::pair(&LaunchParts::Context,
                  "the memory for values saved across barriers"),
        std::pair(&LaunchParts::Print, "the print buffer"),
        std::pair(&LaunchParts::Block, "the launch block")}) {
    const Expected<uint32_t> Address = reserve(Bytes.*Part, What);
    if (!Address)
      return Address.error();
    Parts.*Part = *Address;
  }
  if (K.Variables.Bytes != 0) {
    const Expected<uint32_t> Address =
        reserve(Bytes.Variables, "the program-scope variables");
    if (!Address)
      return Address.error();
    Parts.Variables = placeOf(K.Variables, *Address);
    writeVariables(*Device, *Watch, *Device->image(), K,
                   static_cast<uint32_t>(Parts.Variables));
  }
  L.write(*Device, *Watch, Parts, Args);
  return Success{};
}

Expected<KernelLaunch> KernelLaunch::prepare(Machine &M, const KernelRequest &R,
                                             Session &Watch) {
  const Image &Program = *M.image();
  const Kernel *K = Program.findKernel(R.Kernel);
  if (R.Kernel.empty() && Program.kernels().size() == 1)
    K = &Program.kernels().front();
  if (!K)
    return noKernel(Program, R.Kernel);
  Expected<LaunchShape> Shape = shapeOf(*K, R);
  if (!Shape)
    return Shape.error();
  KernelLaunch L(M, Watch);
  L.Name = K->Name;
  const Expected<uint64_t> Local = L.packArguments(*K, R);
  if (!Local)
    return Local.error();
  Shape->LocalBytes = *Local;
  const Expected<Launch> Planned = Launch::plan(*K, *Shape, M.config());
  if (!Planned)
    return Planned.error();
  if (Expected<Success> Ok = L.write(*Planned, *K); !Ok)
    return Ok.error();
  return L;
}

void KernelLaunch::print() const {
  const Printed P = printedBy(*Device, Parts);
  std::fwrite(P.Text.data(), 1, P.Text.size(), stdout);
  if (P.Dropped)
    printOut("[{} bytes of printf dropped]\n", P.Dropped);
}

Expected<Success> KernelLaunch::finish() const {
  for (const Output &O : Outputs) {
    const std::byte *From = Device->hostPointer(O.Address, O.Bytes);
    Watch->hostRead(O.Address, O.Bytes);
    if (Expected<Success> Ok = writeFileAtomically(O.File, From, O.Bytes); !Ok)
      return Ok;
  }
  return Success{};
}

} // namespace vorion::isasim
