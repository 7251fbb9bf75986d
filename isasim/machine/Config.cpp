#include "vorion/isasim/Config.h"

#include "machine/ConfigKeys.h"
#include "machine/MachineTexts.h"
#include "timing/memory/DramChannels.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/Json.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>
#include <vector>

namespace vorion::isasim {

namespace {

using Json = nlohmann::ordered_json;

/// Whether \p Path is a key, or an object that holds some.
bool isKnown(const std::string &Path) {
  return std::ranges::any_of(keys(), [&](const Key &K) {
    return K.Path.starts_with(Path) &&
           (K.Path.size() == Path.size() || K.Path[Path.size()] == '.');
  });
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
