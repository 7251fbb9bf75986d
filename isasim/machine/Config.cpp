#include "vorion/isasim/Config.h"

#include "core/IsaTables.h"

#include <bit>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

constexpr uint64_t Page = 4096;

/// One key of the JSON form, and the range that its value may have.
struct Key {
  const char *Group; ///< object that holds it, nullptr for the top
  const char *Name;
  uint64_t Low, High, Multiple;
  uint64_t (*Get)(const Config &);
  void (*Set)(Config &, uint64_t);
};

#define VORION_KEY(GROUP, NAME, LOW, HIGH, MULTIPLE, MEMBER)                   \
  {GROUP,                                                                      \
   NAME,                                                                       \
   LOW,                                                                        \
   HIGH,                                                                       \
   MULTIPLE,                                                                   \
   [](const Config &C) -> uint64_t { return C.MEMBER; },                       \
   [](Config &C, uint64_t V) {                                                 \
     C.MEMBER = static_cast<decltype(C.MEMBER)>(V);                            \
   }}

// As many as the I/O window has room for (docs/abi.md, "Memory map"); the
// product of the three is checked in validate().
constexpr uint64_t MaxCores =
    (VX_GLOBAL_BASE - VX_IO_RASTER) / VX_IO_RASTER_STRIDE;
constexpr uint64_t MaxGlobal = VX_IMAGE_BASE - VX_GLOBAL_BASE;

constexpr Key Keys[] = {
    VORION_KEY(nullptr, "clusters", 1, MaxCores, 1, Clusters),
    VORION_KEY(nullptr, "sockets_per_cluster", 1, MaxCores, 1,
               SocketsPerCluster),
    VORION_KEY(nullptr, "cores_per_socket", 1, MaxCores, 1, CoresPerSocket),
    VORION_KEY(nullptr, "warps_per_core", 1, 32, 1, WarpsPerCore),
    VORION_KEY(nullptr, "lanes_per_warp", 1, 16, 1, LanesPerWarp),
    VORION_KEY(nullptr, "barriers", 1, 1024, 1, Barriers),
    VORION_KEY(nullptr, "divergence_depth", 1, 1024, 1, DivergenceDepth),
    VORION_KEY(nullptr, "global_bytes", Page, MaxGlobal, Page, GlobalBytes),
    VORION_KEY(nullptr, "local_bytes", Page, 64 << 10, Page, LocalBytes),
    VORION_KEY(nullptr, "stack_bytes", Page, 1 << 24, Page, StackBytes),
    VORION_KEY(nullptr, "quantum", 1, 1 << 30, 1, Quantum),
    VORION_KEY(nullptr, "max_instructions", 0, UINT64_MAX, 1, MaxInstructions),
    VORION_KEY(nullptr, "host_threads", 0, 1024, 1, HostThreads),
    VORION_KEY("raster", "queue_depth", 1, 1024, 1, Raster.QueueDepth),
};

#undef VORION_KEY

std::string path(const Key &K) {
  return K.Group ? fmt::format("{}.{}", K.Group, K.Name) : K.Name;
}

std::string checkRange(const Key &K, uint64_t Value) {
  if (Value < K.Low || Value > K.High)
    return fmt::format("{} is {}, expected {} to {}", path(K), Value, K.Low,
                       K.High);
  if (Value % K.Multiple != 0)
    return fmt::format("{} is {}, expected a multiple of {}", path(K), Value,
                       K.Multiple);
  return {};
}

std::string keysOf(const std::string &Group) {
  std::string Names;
  for (const Key &K : Keys)
    if (Group == (K.Group ? K.Group : ""))
      Names += fmt::format("{}{}", Names.empty() ? "" : ", ", K.Name);
  return Group.empty() ? Names + ", raster" : Names;
}

const Key *findKey(const std::string &Group, const std::string &Name) {
  for (const Key &K : Keys)
    if (Name == K.Name && Group == (K.Group ? K.Group : ""))
      return &K;
  return nullptr;
}

/// Reads the members of one JSON object; returns what is wrong.
std::string readObject(const Json &Object, const std::string &Group,
                       Config &C) {
  if (!Object.is_object())
    return Group.empty() ? "expected a JSON object"
                         : fmt::format("{}: expected a JSON object", Group);
  for (const auto &[Name, Value] : Object.items()) {
    if (Group.empty() && Name == "raster") {
      if (std::string Wrong = readObject(Value, Name, C); !Wrong.empty())
        return Wrong;
      continue;
    }
    const Key *K = findKey(Group, Name);
    if (!K)
      return fmt::format("unknown key '{}{}{}', expected one of {}", Group,
                         Group.empty() ? "" : ".", Name, keysOf(Group));
    if (!Value.is_number_unsigned())
      return fmt::format("{}: expected a whole number", path(*K));
    const auto Number = Value.get<uint64_t>();
    if (std::string Wrong = checkRange(*K, Number); !Wrong.empty())
      return Wrong;
    K->Set(C, Number);
  }
  return {};
}

} // namespace

Expected<Success> validate(const Config &C) {
  for (const Key &K : Keys)
    if (std::string Wrong = checkRange(K, K.Get(C)); !Wrong.empty())
      return Error{"configuration", std::move(Wrong), ExitCode::Usage};
  // No overflow: each factor is at most MaxCores.
  const uint64_t Cores =
      uint64_t{C.Clusters} * C.SocketsPerCluster * C.CoresPerSocket;
  if (Cores > MaxCores)
    return Error{"configuration",
                 fmt::format("{} cores, expected at most {}", Cores, MaxCores),
                 ExitCode::Usage};
  const uint64_t Stacks =
      Cores * C.WarpsPerCore * C.LanesPerWarp * C.StackBytes;
  // So that lanes' stacks can be told apart by shifts (core/State.h).
  if (!std::has_single_bit(C.StackBytes))
    return Error{
        "configuration",
        fmt::format("stack_bytes is {}, expected a power of two", C.StackBytes),
        ExitCode::Usage};
  const uint64_t Room = VX_STACK_TOP - (VX_IMAGE_BASE + VX_IMAGE_SIZE);
  if (Stacks > Room)
    return Error{"configuration",
                 fmt::format("the stacks take {} bytes, expected at most {}",
                             Stacks, Room),
                 ExitCode::Usage};
  return Success{};
}

std::string toJson(const Config &C) {
  Json Object;
  for (const Key &K : Keys)
    (K.Group ? Object[K.Group] : Object)[K.Name] = K.Get(C);
  return Object.dump(2) + "\n";
}

Expected<Config> parseConfig(std::string_view Text, const std::string &Where) {
  const Json Object = Json::parse(Text.begin(), Text.end(), nullptr,
                                  /*allow_exceptions=*/false);
  if (Object.is_discarded())
    return Error{Where, "not JSON, expected a configuration as "
                        "--print-default-config writes it"};
  Config C;
  if (std::string Wrong = readObject(Object, "", C); !Wrong.empty())
    return Error{Where, std::move(Wrong)};
  if (Expected<Success> Ok = validate(C); !Ok)
    return Error{Where, Ok.error().What};
  return C;
}

} // namespace vorion::isasim
