/// The one way into and out of JSON. A file may hold anything, so whoever reads
/// one gets a document of bounded depth and size, whose objects have no key
/// twice, or an error of one line.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace vorion {

/// What a document may be at most. The defaults are far above every file that
/// we know of, and low enough for any machine that we run on.
struct JsonLimits {
  /// Lists and objects in each other. What walks a document may recurse.
  std::size_t Depth = 256;
  /// Of text.
  std::size_t Bytes = std::size_t{64} << 20;
  /// Numbers, strings, lists and so on: each takes 16 bytes or more.
  std::size_t Values = 8'000'000;
  /// Of one object. An ordered document compares each key with all before it,
  /// so that this bounds the time for a byte of text.
  std::size_t Keys = 256;
};

/// Reads \p Text, which comes from \p Where. \p Kind is nlohmann::json or
/// nlohmann::ordered_json, whose keys stay in the text's order. \p Wanted ends
/// the message about what is no JSON: "an array of cameras".
template <typename Kind>
Expected<Kind> parseJson(std::string_view Text, const std::string &Where,
                         std::string_view Wanted,
                         const JsonLimits &Limits = {});

/// Reads the file \p Path as parseJson() does.
template <typename Kind>
Expected<Kind> readJson(const std::string &Path, std::string_view Wanted,
                        const JsonLimits &Limits = {});

/// The same of a file that a folder or another file names
/// (readRegularFile()).
template <typename Kind>
Expected<Kind> readRegularJson(const std::string &Path,
                               std::string_view Wanted);

/// What this process has just written by jsonText() itself; anything else is a
/// bug and ends in an assertion.
template <typename Kind> Kind ownJson(std::string_view Text);

/// \p J as text; every level is indented by \p Indent, or all is one line if
/// that is negative. Bytes that are no UTF-8 (a path may hold any) become
/// U+FFFD.
template <typename Kind> std::string jsonText(const Kind &J, int Indent = -1);

} // namespace vorion
