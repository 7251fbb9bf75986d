/// The keys of a configuration: what they set, and the values that they may
/// have.
#pragma once

#include "core/IsaTables.h"
#include "vorion/isasim/Config.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// 1,024 rasterizers of four cores, whose I/O window is 1 MiB (docs/abi.md,
/// "Memory map"); the product of the three is checked in validate().
inline constexpr uint64_t MaxCores = 4096;
/// In front of the image, and behind it. Stacks take some of the latter;
/// validate() knows how much.
inline constexpr uint64_t MaxHigh = VX_STACK_TOP - VX_HIGH_BASE;

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

/// In declaration order.
const std::vector<Key> &keys();
const Key *findKey(const std::string &Path);
/// Keys of a run: they do not make another machine.
bool isOfRun(const Key &K);
/// What an object may hold; \p Prefix is its path and a dot, or empty.
std::vector<std::string> namesIn(const std::string &Prefix);

/// As the JSON form has it.
nlohmann::ordered_json valueOf(const Key &K, const Config &C);
/// The value of the name \p Name, or nothing.
std::optional<uint64_t> valueOf(const Key &K, std::string_view Name);
/// What is wrong with a number, or with a name that is no value; empty for
/// nothing.
std::string checkRange(const Key &K, uint64_t Value);
std::string wrongName(const Key &K, std::string_view Name);

} // namespace vorion::isasim
