/// Parsing and writing of JSON. Files are untrusted, so a parsed document has
/// bounded depth and size and no duplicate keys; otherwise the result is a
/// one-line error.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace vorion {

/// Limits of a document. The defaults are far above all known files, and low
/// enough for all hosts.
struct JsonLimits {
  /// Maximum nesting, so that recursive traversal is safe.
  std::size_t Depth = 256;
  /// Maximum size of the text in bytes.
  std::size_t Bytes = std::size_t{64} << 20;
  /// Numbers, strings, lists and so on: each takes 16 bytes or more.
  std::size_t Values = 8'000'000;
  /// Maximum number of keys of an object. An ordered document compares each key
  /// with all previous ones, so this bounds the time per byte of text.
  std::size_t Keys = 256;
};

/// Parses \p Text of the file \p Where. \p Kind is nlohmann::json or
/// nlohmann::ordered_json, which preserves the order of keys. \p Wanted is the
/// expected document in error messages: "an array of cameras".
template <typename Kind>
Expected<Kind> parseJson(std::string_view Text, const std::string &Where,
                         std::string_view Wanted,
                         const JsonLimits &Limits = {});

/// Reads the file \p Path as parseJson() does.
template <typename Kind>
Expected<Kind> readJson(const std::string &Path, std::string_view Wanted,
                        const JsonLimits &Limits = {});

/// The same for a file to which a folder or another file refers
/// (readRegularFile()).
template <typename Kind>
Expected<Kind> readRegularJson(const std::string &Path,
                               std::string_view Wanted);

/// Parses text written by jsonText() in this process; invalid text is a bug and
/// fails an assertion.
template <typename Kind> Kind ownJson(std::string_view Text);

/// \p J as text, indented by \p Indent per level, or on one line if that is
/// negative. Invalid UTF-8, possible in paths, is replaced by U+FFFD.
template <typename Kind> std::string jsonText(const Kind &J, int Indent = -1);

} // namespace vorion
