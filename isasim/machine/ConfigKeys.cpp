#include "machine/ConfigKeys.h"

#include "machine/MachineTexts.h"
#include "vorion/support/ClockText.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::isasim {

namespace {

constexpr uint64_t Page = 4096;

#define VORION_KEY(PATH, LOW, HIGH, MULTIPLE, MEMBER)                          \
  {PATH,                                                                       \
   LOW,                                                                        \
   HIGH,                                                                       \
   MULTIPLE,                                                                   \
   [](const Config &C) -> uint64_t { return C.MEMBER; },                       \
   [](Config &C, uint64_t V) {                                                 \
     C.MEMBER = static_cast<decltype(C.MEMBER)>(V);                            \
   }}

constexpr uint64_t MaxGlobal = VX_IMAGE_BASE - VX_GLOBAL_BASE + MaxHigh;

void setMachine(Config &C, uint64_t Number);

std::vector<Key> makeKeys() {
  std::vector<Key> All = {
      {"machine",
       0,
       machineNames().size() - 1,
       1,
       nullptr,
       setMachine,
       {machineNames().begin(), machineNames().end()}},
      VORION_KEY("clusters", 1, MaxCores, 1, Clusters),
      VORION_KEY("sockets_per_cluster", 1, MaxCores, 1, SocketsPerCluster),
      VORION_KEY("cores_per_socket", 1, MaxCores, 1, CoresPerSocket),
      VORION_KEY("warps_per_core", 1, 32, 1, WarpsPerCore),
      VORION_KEY("lanes_per_warp", 1, 16, 1, LanesPerWarp),
      VORION_KEY("barriers", 1, 1024, 1, Barriers),
      VORION_KEY("divergence_depth", 1, 1024, 1, DivergenceDepth),
      VORION_KEY("global_bytes", 0, MaxGlobal, Page, GlobalBytes),
      VORION_KEY("local_bytes", Page, 64 << 10, Page, LocalBytes),
      VORION_KEY("stack_bytes", Page, VX_MAX_STACK, Page, StackBytes),
      VORION_KEY("quantum", 1, 1 << 30, 1, Quantum),
      VORION_KEY("max_instructions", 0, UINT64_MAX, 1, MaxInstructions),
      VORION_KEY("host_threads", 0, 1024, 1, HostThreads),
      {"engine",
       0,
       3,
       1,
       [](const Config &C) { return static_cast<uint64_t>(C.Runs); },
       [](Config &C, uint64_t V) { C.Runs = static_cast<Engine>(V); },
       {"auto", "interpreter", "translator", "translator-avx2"}},
      VORION_KEY("raster.queue_depth", 1, 1024, 1, Raster.QueueDepth),
      VORION_KEY("timing.enabled", 0, 1, 1, Timing.Enabled),
      VORION_KEY("timing.clock_mhz", 1, MostClockMhz, 1, Timing.ClockMhz),
  };
  std::vector<std::string> Presets;
  for (size_t N = 0; N != size_t(CorePreset::Count); ++N)
    Presets.emplace_back(name(static_cast<CorePreset>(N)));
  All.push_back({"timing.core.preset", 0, Presets.size() - 1, 1,
                 [](const Config &C) { return uint64_t(C.Timing.Preset); },
                 [](Config &C, uint64_t V) {
                   C.Timing.Preset = static_cast<CorePreset>(V);
                   C.Timing.Core = numbersOf(C.Timing.Preset);
                 },
                 Presets});
  for (const TimingParam &P : timingParams())
    All.push_back({fmt::format("timing.{}.{}", P.Group, P.Name),
                   P.Low,
                   P.High,
                   1,
                   [&P](const Config &C) {
                     TimingConfig T = C.Timing;
                     return uint64_t{P.Of(T)};
                   },
                   [&P](Config &C, uint64_t V) {
                     P.Of(C.Timing) = static_cast<uint32_t>(V);
                   },
                   {},
                   P.WordOf});
  return All;
}

#undef VORION_KEY

} // namespace

const std::vector<Key> &keys() {
  static const std::vector<Key> All = makeKeys();
  return All;
}

/// See isOfRun().
static constexpr std::string_view RunKeys[] = {
    "max_instructions", "quantum", "host_threads", "engine", "timing.enabled"};

bool isOfRun(const Key &K) {
  return std::ranges::find(RunKeys, K.Path) != std::end(RunKeys);
}

namespace {

/// The machine of that place in machineNames(), with the run's values of \p C.
void setMachine(Config &C, uint64_t Number) {
  Config Named = namedMachine(Number);
  for (const Key &K : keys())
    if (isOfRun(K))
      K.Set(Named, K.Get(C));
  C = Named;
}

} // namespace

nlohmann::ordered_json valueOf(const Key &K, const Config &C) {
  if (K.WordOf) {
    TimingConfig T = C.Timing;
    return K.WordOf(T);
  }
  if (K.Names.empty())
    return K.Get(C);
  return K.Names[K.Get(C)];
}

std::string checkRange(const Key &K, uint64_t Value) {
  if (Value < K.Low || Value > K.High)
    return fmt::format("{} is {}, expected {} to {}", K.Path, Value, K.Low,
                       K.High);
  if (Value % K.Multiple != 0)
    return fmt::format("{} is {}, expected a multiple of {}", K.Path, Value,
                       K.Multiple);
  return {};
}

std::optional<uint64_t> valueOf(const Key &K, std::string_view Name) {
  const auto Found = std::ranges::find(K.Names, Name);
  if (Found == K.Names.end())
    return std::nullopt;
  return static_cast<uint64_t>(Found - K.Names.begin());
}

std::string wrongName(const Key &K, std::string_view Name) {
  return fmt::format("{} is '{}', expected one of {}{}", K.Path, Name,
                     fmt::join(K.Names, ", "), didYouMean(Name, K.Names));
}

std::vector<std::string> namesIn(const std::string &Prefix) {
  std::vector<std::string> Names;
  for (const Key &K : keys())
    if (K.Path.starts_with(Prefix)) {
      const std::string Rest = K.Path.substr(Prefix.size());
      const std::string Name = Rest.substr(0, Rest.find('.'));
      if (Names.empty() || Names.back() != Name)
        Names.push_back(Name);
    }
  return Names;
}

const Key *findKey(const std::string &Path) {
  const auto Found = std::ranges::find(keys(), Path, &Key::Path);
  return Found == keys().end() ? nullptr : &*Found;
}

} // namespace vorion::isasim
