/// What --set takes in place of a key: a word, the end of a key, or a number
/// that several keys make.
#pragma once

#include "vorion/isasim/Config.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// One word.
struct ShortKey {
  std::string_view Name;
  /// The key that it stands for; empty if Set makes it.
  std::string_view Key;
  /// Sets what makes \p Number; returns what is wrong. \p KeepsSockets: the
  /// number of sockets is given, too.
  std::string (*Set)(Config &C, uint64_t Number, bool KeepsSockets);
  std::string_view Meaning;
};
/// Those that are made come last, each behind those that it goes by.
std::span<const ShortKey> shortKeys();
const ShortKey *findShortKey(std::string_view Name);

/// The keys of \p All that end with ".\p End".
std::vector<std::string> keysEndingWith(std::string_view End,
                                        const std::vector<std::string> &All);

} // namespace vorion::isasim
