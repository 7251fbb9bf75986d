/// The machines that `splat explore` tries: what may differ from one of them.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Whether \p Text may be the name of a parameter, a value or a part of a
/// workload, which stand in tables and on pages.
bool isPlainName(std::string_view Text);
inline constexpr const char *PlainName =
    "a name of letters, digits, '-', '_' and '.'";

/// A value that a parameter may have in place of the base machine's.
struct Alternative {
  std::string Name;
  std::string Settings;               ///< as --set takes them; empty for none
  std::vector<std::string> Arguments; ///< of `splat render`
};

struct Parameter {
  std::string Name;
  std::vector<Alternative> Others;
};

using Space = std::vector<Parameter>;

/// Reads the JSON \p Text of \p Where (docs/explore.md, "The space").
Expected<Space> parseSpace(std::string_view Text, const std::string &Where);

/// The same of the file \p File.
Expected<Space> readSpace(const std::string &File);

/// That of --print-space.
std::string_view defaultSpace();

/// A machine of a space: for each parameter 0 if it is as the base machine has
/// it, else the place of the alternative and 1.
using Choices = std::vector<std::size_t>;

/// "base", or "core=forwarding,lanes=8".
std::string nameOf(const Space &S, const Choices &C);
/// As --set takes them.
std::string settingsOf(const Space &S, const Choices &C);
/// Of `splat render`.
std::vector<std::string> argumentsOf(const Space &S, const Choices &C);

/// \p C as work sees it that takes no other options than \p Known: an
/// alternative of another option is as if the base had it.
Choices seenBy(const std::set<std::string> &Known, const Space &S, Choices C);

/// The base machine, then every other value of each parameter alone, then
/// machines drawn at random, each value of a parameter as likely as another,
/// until they are \p Count or the space has no more: the same ones for the same
/// \p Seed, on every host. \p Singles gets how many of them the first two kinds
/// are.
std::vector<Choices> machinesOf(const Space &S, std::size_t Count,
                                uint64_t Seed, std::size_t &Singles);

} // namespace vorion::splat
