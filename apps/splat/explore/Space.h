/// The design space of `splat explore`.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Whether \p Text is a valid name of a parameter, a value or a part of a
/// workload, for tables and pages.
bool isPlainName(std::string_view Text);
inline constexpr const char *PlainName =
    "a name of letters, digits, '-', '_' and '.'";

/// An alternative to the base machine's value of a parameter.
struct Alternative {
  std::string Name;
  std::string Settings;               ///< in the syntax of --set; empty for
                                      ///< none
  std::vector<std::string> Arguments; ///< of `splat render`
};

struct Parameter {
  std::string Name;
  std::vector<Alternative> Others;
};

using Space = std::vector<Parameter>;

/// Parses the JSON \p Text of \p Where (docs/explore.md, "The space").
Expected<Space> parseSpace(std::string_view Text, const std::string &Where);

/// The same for the file \p File.
Expected<Space> readSpace(const std::string &File);

/// The space of --print-space.
std::string_view defaultSpace();

/// A machine of a space: for each parameter 0 for the value of the base
/// machine, otherwise the index of the alternative plus 1.
using Choices = std::vector<std::size_t>;

/// "base", or "core=forwarding,lanes=8".
std::string nameOf(const Space &S, const Choices &C);
/// The settings in the syntax of --set.
std::string settingsOf(const Space &S, const Choices &C);
/// The arguments of `splat render`.
std::vector<std::string> argumentsOf(const Space &S, const Choices &C);

/// \p C for work with the options \p Known: alternatives of other options are
/// replaced by the base.
Choices seenBy(const std::set<std::string> &Known, const Space &S, Choices C);

/// The base machine, all single changes, and random machines with uniformly
/// distributed values, up to \p Count machines or all of the space. The result
/// depends only on the space and \p Seed. \p Singles receives the number of
/// machines before the random ones.
std::vector<Choices> machinesOf(const Space &S, std::size_t Count,
                                uint64_t Seed, std::size_t &Singles);

} // namespace vorion::splat
