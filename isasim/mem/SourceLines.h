/// Where in its source an instruction comes from: the program's DWARF, through
/// elfutils (docs/decisions.md, 12).
#pragma once

#include "vorion/isasim/Image.h"
#include "vorion/isasim/SourcePlace.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

struct Dwarf;
struct Elf;

namespace vorion::isasim {

class SourceLines {
public:
  /// Of \p Program, which it keeps. One without DWARF, or with DWARF that
  /// cannot be read, has no lines.
  explicit SourceLines(std::shared_ptr<const Image> Program);
  ~SourceLines();
  SourceLines(const SourceLines &) = delete;
  SourceLines &operator=(const SourceLines &) = delete;

  bool empty() const { return Info == nullptr; }
  /// Nothing where the program has no line for \p Pc.
  std::optional<SourcePlace> find(uint32_t Pc) const;
  /// The same place, or the nearest before it, then for each inlining that of
  /// the call. Empty where the program has neither. Slow: for reports, not for
  /// counting.
  std::vector<SourcePlace> chain(uint32_t Pc) const;
  /// "file:line (function)", "near file:line (function)" or the symbol, or the
  /// address.
  std::string describe(uint32_t Pc) const;

private:
  const std::optional<SourcePlace> &nearest(uint32_t Pc) const;

  std::shared_ptr<const Image> Program;
  std::string Bytes; ///< elfutils wants memory that it might write
  Elf *File = nullptr;
  Dwarf *Info = nullptr;
  mutable std::map<uint32_t, std::optional<SourcePlace>> Known;
};

} // namespace vorion::isasim
