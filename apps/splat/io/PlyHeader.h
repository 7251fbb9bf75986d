/// The header of a PLY file: its elements, and the offsets of their properties.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"
#include "vorion/support/FileKind.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

enum class PlyType { Char, UChar, Short, UShort, Int, UInt, Float, Double };

/// Bytes of a number of type \p Type in a binary file.
std::size_t sizeOf(PlyType Type);

enum class PlyEncoding { LittleEndian, BigEndian, Text };

/// A property: a number, or a list of numbers with their count before them.
struct PlyProperty {
  std::string Name;
  PlyType Type;
  std::optional<PlyType> CountType; ///< of a list
  std::size_t Offset = 0;           ///< in each row, if the element has no list
};

/// Offset and type (float or double) of a number in a row.
struct PlyReal {
  std::size_t Offset;
  bool IsDouble;
};

struct PlyElement {
  std::string Name;
  std::size_t Count = 0;
  std::size_t Stride = 0; ///< bytes of a row; rows with lists have none
  std::size_t Start = 0;  ///< of the first row, in PlyFile's rows
  bool HasLists = false;
  std::vector<PlyProperty> Properties;

  /// Appends a property; false if there is one of its name.
  bool add(PlyProperty Property);
  const PlyProperty *find(std::string_view Property) const;
  /// The offsets in a row of \p Names, which must all have type \p Type.
  Expected<std::vector<std::size_t>>
  offsets(const std::string &Where, const std::vector<std::string> &Names,
          PlyType Type) const;
  /// The same for \p Names that must have type float or double.
  Expected<std::vector<PlyReal>>
  reals(const std::string &Where, const std::vector<std::string> &Names) const;

private:
  std::map<std::string, std::size_t, std::less<>> Places; ///< in Properties
};

struct PlyHeader {
  PlyEncoding Encoding = PlyEncoding::LittleEndian;
  std::size_t Size = 0;       ///< bytes of the header
  std::size_t LineNumber = 0; ///< of its last line, from 1
  std::vector<PlyElement> Elements;
  std::vector<std::string> Comments; ///< without their keyword

  /// Appends an element; null if there is one of its name.
  PlyElement *add(std::string_view Element);
  const PlyElement *find(std::string_view Element) const;

private:
  std::map<std::string, std::size_t, std::less<>> Places; ///< in Elements
};

/// Whether \p File has the magic bytes of PLY.
inline bool isPlyFile(Bytes File) { return hasMark(FileKind::Ply, File); }

/// Parses the header of a PLY. Errors name the line. Runs in linear time,
/// because a header may declare any number of elements and properties.
Expected<PlyHeader> readPlyHeader(const std::string &Where, Bytes File);

} // namespace vorion::splat
