#include "vorion/isasim/Config.h"

#include "core/IsaTables.h"
#include "machine/MachineTexts.h"
#include "timing/DramChannels.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/ClockText.h"
#include "vorion/support/Json.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <vector>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

constexpr uint64_t Page = 4096;

/// One key of the JSON form, and the range that its value may have.
struct Key {
  /// Names of the objects that hold it and its own, joined by dots.
  std::string Path;
  uint64_t Low, High, Multiple;
  /// None of a key that is read, and not written: what it sets has keys.
  std::function<uint64_t(const Config &)> Get;
  std::function<void(Config &, uint64_t)> Set;
  /// Of a key whose values are names: those of 0, 1, ... Such a key may set
  /// others, so an object's are read first.
  // Without it the compiler warns of keys that leave it out.
  // NOLINTNEXTLINE(readability-redundant-member-init)
  std::vector<std::string> Names = {};
  /// Of a key whose value is a text; validate() says what it may be.
  std::string &(*WordOf)(TimingConfig &) = nullptr;
};

#define VORION_KEY(PATH, LOW, HIGH, MULTIPLE, MEMBER)                          \
  {PATH,                                                                       \
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
/// In front of the image, and behind it. Stacks take some of the latter;
/// validate() knows how much.
constexpr uint64_t MaxHigh = VX_STACK_TOP - VX_HIGH_BASE;
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

/// In declaration order.
const std::vector<Key> &keys() {
  static const std::vector<Key> All = makeKeys();
  return All;
}

/// Keys of a run: they do not make another machine.
constexpr std::string_view RunKeys[] = {
    "max_instructions", "quantum", "host_threads", "engine", "timing.enabled"};

bool isOfRun(const Key &K) {
  return std::ranges::find(RunKeys, K.Path) != std::end(RunKeys);
}

/// The machine of that place in machineNames(), with the run's values of \p C.
void setMachine(Config &C, uint64_t Number) {
  Config Named = namedMachine(Number);
  for (const Key &K : keys())
    if (isOfRun(K))
      K.Set(Named, K.Get(C));
  C = Named;
}

/// As the JSON form has it.
Json valueOf(const Key &K, const Config &C) {
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

/// The value of the name \p Name, or nothing.
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

/// What an object may hold; \p Prefix is its path and a dot, or empty.
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

/// Whether \p Path is a key, or an object that holds some.
bool isKnown(const std::string &Path) {
  return std::ranges::any_of(keys(), [&](const Key &K) {
    return K.Path.starts_with(Path) &&
           (K.Path.size() == Path.size() || K.Path[Path.size()] == '.');
  });
}

const Key *findKey(const std::string &Path) {
  const auto Found = std::ranges::find(keys(), Path, &Key::Path);
  return Found == keys().end() ? nullptr : &*Found;
}

std::string readObject(const Json &Object, const std::string &Prefix,
                       Config &C);

/// Reads one member of an object; returns what is wrong.
std::string readMember(const Json &Value, const std::string &Path, Config &C) {
  const Key *K = findKey(Path);
  if (!K)
    return readObject(Value, Path + ".", C);
  if (!K->Names.empty()) {
    if (!Value.is_string())
      return fmt::format("{}: expected one of {}", Path,
                         fmt::join(K->Names, ", "));
    const auto Name = Value.get<std::string>();
    const std::optional<uint64_t> Number = valueOf(*K, Name);
    if (!Number)
      return wrongName(*K, Name);
    K->Set(C, *Number);
    return {};
  }
  if (K->WordOf) {
    if (!Value.is_string())
      return fmt::format("{}: expected a text", Path);
    K->WordOf(C.Timing) = Value.get<std::string>();
    return {};
  }
  if (!Value.is_number_unsigned())
    return fmt::format("{}: expected a whole number", Path);
  const auto Number = Value.get<uint64_t>();
  if (std::string Wrong = checkRange(*K, Number); !Wrong.empty())
    return Wrong;
  K->Set(C, Number);
  return {};
}

/// Reads the members of one JSON object; returns what is wrong.
std::string readObject(const Json &Object, const std::string &Prefix,
                       Config &C) {
  if (!Object.is_object())
    return Prefix.empty() ? "expected a JSON object"
                          : fmt::format("{}: expected a JSON object",
                                        Prefix.substr(0, Prefix.size() - 1));
  for (const bool Named : {true, false})
    for (const auto &[Name, Value] : Object.items()) {
      const std::string Path = Prefix + Name;
      if (Name.find('.') != std::string::npos || !isKnown(Path))
        return fmt::format("unknown key '{}', expected one of {}{}", Path,
                           fmt::join(namesIn(Prefix), ", "),
                           didYouMean(Name, namesIn(Prefix)));
      const Key *K = findKey(Path);
      if ((K && !K->Names.empty()) != Named)
        continue;
      if (std::string Wrong = readMember(Value, Path, C); !Wrong.empty())
        return Wrong;
    }
  return {};
}

} // namespace

Expected<Success> validate(const Config &C) {
  for (const Key &K : keys()) {
    if (K.WordOf || !K.Get)
      continue;
    if (std::string Wrong = checkRange(K, K.Get(C)); !Wrong.empty())
      return Error{"configuration", std::move(Wrong), ExitCode::Usage};
  }
  // A set cannot have more ways than the cache has lines.
  for (const auto &[Path, Kib, Ways] :
       {std::tuple{"timing.l2.ways", C.Timing.L2.Kib, C.Timing.L2.Ways},
        {"timing.llc.ways", C.Timing.Llc.Kib, C.Timing.Llc.Ways}})
    if (const uint32_t Lines = Kib * 1024 / TimingLineBytes; Ways > Lines)
      return Error{"configuration",
                   fmt::format("{} is {}, expected at most the {} lines of {} "
                               "KiB",
                               Path, Ways, Lines, Kib),
                   ExitCode::Usage};
  // A test holds the default good, so that not every run reads its standard.
  if (C.Timing.Dram != defaultMachine().Timing.Dram)
    if (const auto Dram = setUpDram(C.Timing.Dram); !Dram)
      return Dram.error();
  // No overflow: each factor is at most MaxCores.
  const uint64_t Cores =
      uint64_t{C.Clusters} * C.SocketsPerCluster * C.CoresPerSocket;
  if (Cores > MaxCores)
    return Error{"configuration",
                 fmt::format("{} cores, expected at most {}", Cores, MaxCores),
                 ExitCode::Usage};
  const uint64_t Stacks = stackBytes(C);
  // So that lanes' stacks can be told apart by shifts (core/State.h).
  if (!std::has_single_bit(C.StackBytes))
    return Error{
        "configuration",
        fmt::format("stack_bytes is {}, expected a power of two", C.StackBytes),
        ExitCode::Usage};
  const uint64_t High = globalRanges(C)[1].Bytes;
  if (Stacks > MaxHigh - High)
    return Error{
        "configuration",
        fmt::format(
            "the stacks take {} bytes, expected at most {}{}", Stacks,
            MaxHigh - High,
            High ? fmt::format(" with {} bytes of global memory", C.GlobalBytes)
                 : ""),
        ExitCode::Usage};
  return Success{};
}

std::string configSchema() {
  Json Schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "Vorion machine configuration"}};
  const auto Describe = [](Json &Object) -> Json & {
    Object["type"] = "object";
    Object["additionalProperties"] = false;
    return Object["properties"];
  };
  Describe(Schema);
  const Config &Default = defaultMachine();
  for (const Key &K : keys()) {
    Json *Properties = &Describe(Schema);
    std::string_view Rest = K.Path;
    for (size_t Dot = 0; (Dot = Rest.find('.')) != std::string_view::npos;
         Rest.remove_prefix(Dot + 1))
      Properties = &Describe((*Properties)[std::string(Rest.substr(0, Dot))]);
    Json &Value = (*Properties)[std::string(Rest)];
    if (K.WordOf || !K.Names.empty()) {
      Value = {{"type", "string"},
               {"default",
                K.Get ? valueOf(K, Default) : Json(nameOf(Default).Name)}};
      if (!K.Names.empty())
        Value["enum"] = K.Names;
      continue;
    }
    Value = {{"type", "integer"},
             {"minimum", K.Low},
             {"maximum", K.High},
             {"default", K.Get(Default)}};
    if (K.Multiple != 1)
      Value["multipleOf"] = K.Multiple;
  }
  return jsonText(Schema, 2) + "\n";
}

Expected<Success> setValue(Config &C, std::string_view Assignment) {
  const size_t Equals = Assignment.find('=');
  const std::string Path(Assignment.substr(0, Equals));
  const auto Fail = [](std::string What) {
    return Error{"configuration", std::move(What), ExitCode::Usage};
  };
  if (Equals == std::string_view::npos)
    return Fail(fmt::format("'{}', expected KEY=VALUE", Assignment));
  const Key *K = findKey(Path);
  if (const auto Names = namesIn(Path + "."); !K && !Names.empty())
    return Fail(fmt::format("'{0}' is no key but holds some, expected '{0}.' "
                            "and one of {1}",
                            Path, fmt::join(Names, ", ")));
  if (!K) {
    // What stands in the innermost object that there is.
    std::string Prefix = Path;
    do
      Prefix.resize(Prefix.find_last_of('.') == std::string::npos
                        ? 0
                        : Prefix.find_last_of('.'));
    while (!Prefix.empty() && namesIn(Prefix + ".").empty());
    const std::string Inside = Prefix.empty() ? "" : Prefix + ".";
    return Fail(
        fmt::format("unknown key '{}', expected {}one of {}{}", Path,
                    Prefix.empty() ? "" : "in " + Prefix + " ",
                    fmt::join(namesIn(Inside), ", "),
                    didYouMean(Path.substr(Inside.size()), namesIn(Inside))));
  }
  const std::string_view Text = Assignment.substr(Equals + 1);
  if (K->WordOf) {
    K->WordOf(C.Timing) = Text;
    return Success{};
  }
  if (!K->Names.empty()) {
    const std::optional<uint64_t> Named = valueOf(*K, Text);
    if (!Named)
      return Fail(wrongName(*K, Text));
    K->Set(C, *Named);
    return Success{};
  }
  uint64_t Value = 0;
  const auto Read =
      std::from_chars(Text.data(), Text.data() + Text.size(), Value);
  if (Read.ec != std::errc() || Read.ptr != Text.data() + Text.size())
    return Fail(fmt::format("{} is '{}', expected a whole number, {} to {}",
                            Path, Text, K->Low, K->High));
  if (std::string Wrong = checkRange(*K, Value); !Wrong.empty())
    return Fail(std::move(Wrong));
  K->Set(C, Value);
  return Success{};
}

/// What a name sets may not undo what another assignment says: those of names
/// come first, in the order of keys(), of which a machine is the first.
static ptrdiff_t placeOf(std::string_view Assignment) {
  const Key *K =
      findKey(std::string(Assignment.substr(0, Assignment.find('='))));
  return K && !K->Names.empty() ? K - keys().data() : std::ssize(keys());
}

Expected<Success> setValues(Config &C, std::string_view List) {
  std::multimap<ptrdiff_t, std::string_view> ByPlace;
  while (!List.empty()) {
    const size_t Comma = std::min(List.find(','), List.size());
    ByPlace.emplace(placeOf(List.substr(0, Comma)), List.substr(0, Comma));
    List.remove_prefix(std::min(Comma + 1, List.size()));
  }
  for (const auto &[Place, Assignment] : ByPlace)
    if (Expected<Success> Ok = setValue(C, Assignment); !Ok)
      return Ok;
  return validate(C);
}

std::string toJson(const Config &C) {
  Json Object;
  for (const Key &K : keys()) {
    if (!K.Get)
      continue;
    Json *In = &Object;
    std::string_view Left = K.Path;
    for (size_t Dot; (Dot = Left.find('.')) != std::string_view::npos;
         Left.remove_prefix(Dot + 1))
      In = &(*In)[std::string(Left.substr(0, Dot))];
    (*In)[std::string(Left)] = valueOf(K, C);
  }
  return jsonText(Object, 2) + "\n";
}

std::vector<std::string> changesOf(const Config &From, const Config &To) {
  std::vector<std::string> Changes;
  Config Now = From;
  // A name that stands for a set of numbers first: it is one change.
  for (const bool Named : {true, false})
    for (const Key &K : keys()) {
      if (!K.Get || !K.Names.empty() != Named || isOfRun(K) ||
          K.Path == "timing.clock_mhz")
        continue;
      const Json Value = valueOf(K, To);
      if (Value == valueOf(K, Now))
        continue;
      Changes.push_back(fmt::format("{}={}", K.Path,
                                    Value.is_string() ? Value.get<std::string>()
                                                      : jsonText(Value)));
      if (Named)
        K.Set(Now, K.Get(To));
    }
  return Changes;
}

Expected<Success> changeConfig(Config &C, std::string_view Text,
                               const std::string &Where) {
  const auto Object = parseJson<Json>(
      Text, Where, "a configuration as --print-default-config writes it");
  if (!Object)
    return Object.error();
  if (std::string Wrong = readObject(*Object, "", C); !Wrong.empty())
    return Error{Where, std::move(Wrong)};
  return Success{};
}

Expected<Config> parseConfig(std::string_view Text, const std::string &Where) {
  Config C = defaultMachine();
  const ExitCode Code =
      Where == GivenText ? ExitCode::Usage : ExitCode::InputFile;
  if (const Expected<Success> Ok = changeConfig(C, Text, Where); !Ok)
    return Error{Ok.error().Where, Ok.error().What, Code};
  if (const Expected<Success> Ok = validate(C); !Ok)
    return Error{Where, Ok.error().What, Code};
  return C;
}

} // namespace vorion::isasim
