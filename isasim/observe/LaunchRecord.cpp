#include "observe/LaunchRecord.h"

#include "core/IsaTables.h"
#include "vorion/isasim/Image.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/Hash.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

namespace vorion::isasim {

using Json = nlohmann::ordered_json;

namespace {

std::string hashOf(std::span<const std::byte> Bytes) {
  return fnv1a64(std::string_view(reinterpret_cast<const char *>(Bytes.data()),
                                  Bytes.size()));
}

/// As a number where its kind says which, else byte by byte.
Json valueOf(const KernelArg &Arg, std::span<const std::byte> Bytes) {
  if (Arg.Kind == VX_ARG_INTEGER && Bytes.size() <= sizeof(uint64_t)) {
    uint64_t Value = 0;
    std::memcpy(&Value, Bytes.data(), Bytes.size());
    return Value;
  }
  if (float Value = 0;
      Arg.Kind == VX_ARG_FLOAT && Bytes.size() == sizeof(Value)) {
    std::memcpy(&Value, Bytes.data(), sizeof(Value));
    return fmt::format("{}", Value); // what JSON has no number for, too
  }
  std::string Text;
  for (const std::byte B : Bytes)
    Text += fmt::format("{:02x}", std::to_integer<unsigned>(B));
  return Text;
}

/// The memory at \p Address, which says nothing of the work itself.
Json memoryOf(const KernelArg &Arg, const GivenMemory *Given, const Machine &M,
              uint32_t Address) {
  const bool IsLocal = Arg.Kind == VX_ARG_LOCAL;
  Json One{{"kind", IsLocal ? "local" : "buffer"}};
  if (!Given)
    return One;
  One["bytes"] = Given->Bytes;
  if (!IsLocal && Given->IsZeros) {
    One["contents"] = "zeros";
  } else if (!IsLocal) {
    std::vector<std::byte> Contents(Given->Bytes);
    M.read(Address, Contents);
    One["contents"] = hashOf(Contents);
  }
  return One;
}

bool isMemory(const KernelArg &Arg) {
  return Arg.Kind == VX_ARG_GLOBAL || Arg.Kind == VX_ARG_LOCAL;
}

/// Those of \p K at \p Address.
Json argumentsOf(const Kernel &K, const Machine &M, uint32_t Address,
                 const std::vector<GivenMemory> &Given) {
  std::vector<std::byte> Packed(K.ArgsBytes);
  M.read(Address, Packed);
  Json All = Json::array();
  for (size_t N = 0; N != K.Args.size(); ++N) {
    const KernelArg &Arg = K.Args[N];
    const auto Said = std::ranges::find(Given, N, &GivenMemory::Argument);
    const std::span Bytes = std::span(Packed).subspan(Arg.Offset, Arg.Size);
    Json One{{"name", Arg.Name}};
    if (isMemory(Arg)) {
      uint32_t At = 0;
      std::memcpy(&At, Bytes.data(), std::min(sizeof(At), Bytes.size()));
      One.update(memoryOf(Arg, Said == Given.end() ? nullptr : &*Said, M, At));
    } else {
      One["value"] = valueOf(Arg, Bytes);
    }
    All.push_back(std::move(One));
  }
  return All;
}

} // namespace

const std::string &
LaunchRecord::hashOf(const std::shared_ptr<const Image> &Program) {
  if (Program != Hashed)
    Hash = isasim::hashOf(Program->file());
  Hashed = Program;
  return Hash;
}

Json LaunchRecord::take(const Machine &M, const std::string &Kernel,
                        uint32_t LaunchBlock) {
  const std::vector<GivenMemory> Of = std::exchange(Given, {});
  if (!M.image())
    return Json::object();
  Json Record{{"program_fnv1a64", hashOf(M.image())}};
  VxLaunch Block{};
  if (LaunchBlock == 0 ||
      !M.read(LaunchBlock, std::as_writable_bytes(std::span(&Block, 1))))
    return Record;
  for (unsigned Dim = 0; Dim != 3; ++Dim) {
    Record["global"].push_back(uint64_t{Block.NumGroups[Dim]} *
                               Block.LocalSize[Dim]);
    Record["local"].push_back(Block.LocalSize[Dim]);
  }
  if (const auto *K = M.image()->findKernel(Kernel))
    Record["arguments"] = argumentsOf(*K, M, Block.Args, Of);
  return Record;
}

} // namespace vorion::isasim
