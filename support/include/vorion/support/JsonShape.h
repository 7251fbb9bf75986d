/// What a document of JSON must look like, said once and checked as a whole, so
/// that the code behind the check takes values without asking again.
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace vorion {

struct JsonField;

/// The shape of one value.
class JsonShape {
public:
  static JsonShape anything();
  static JsonShape boolean();
  static JsonShape text();
  /// A number, whole or not.
  static JsonShape number();
  /// A whole number from \p Least to \p Most.
  static JsonShape whole(uint64_t Least = 0,
                         uint64_t Most = std::numeric_limits<uint64_t>::max());
  /// \p Least to \p Most values of the shape \p Of.
  static JsonShape list(JsonShape Of, uint64_t Least = 0,
                        uint64_t Most = std::numeric_limits<uint64_t>::max());
  /// An object with \p Fields and, unless closed(), others.
  static JsonShape object(std::vector<JsonField> Fields);

  /// The same, or null.
  JsonShape orNull() const;
  /// The same object without other keys than its fields'.
  JsonShape closed() const;

  /// The first thing of \p J, which comes from \p Where, that is not so: "key
  /// time.cycles is a string, expected a number". \p Kind is nlohmann::json or
  /// nlohmann::ordered_json.
  template <typename Kind>
  Expected<Success> check(const Kind &J, const std::string &Where) const;

private:
  enum class Type { Anything, Boolean, Text, Number, Whole, List, Object };

  explicit JsonShape(Type What);
  /// "a whole number from 1 to 3".
  std::string name() const;
  /// What is wrong with \p J, the value at \p Path ("points[3].time").
  template <typename Kind>
  std::string problem(const Kind &J, const std::string &Path) const;
  template <typename Kind> bool hasType(const Kind &J) const;

  Type What;
  bool MayBeNull = false;
  bool IsClosed = false;
  uint64_t Least = 0;
  uint64_t Most = std::numeric_limits<uint64_t>::max();
  std::vector<JsonField> Fields;
  /// Of a list's values: one, in a vector since the type holds itself.
  std::vector<JsonShape> Elements;
};

/// A key of an object.
struct JsonField {
  std::string Name;
  JsonShape Shape;
  bool Required = true;
};

} // namespace vorion
