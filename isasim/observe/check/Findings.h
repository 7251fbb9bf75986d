/// What the checkers have found, said once for each place in the program.
#pragma once

#include "mem/SourceLines.h"
#include "vorion/isasim/Observer.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace vorion::isasim {

/// Where a finding was made.
struct Culprit {
  unsigned Core = 0, Warp = 0, Lane = 0;
  uint32_t Pc = 0, Word = 0;

  static Culprit of(const Step &S, unsigned Lane) {
    return {S.Core, S.Warp, Lane, S.Pc, S.Word};
  }
};

class Findings {
public:
  /// \p Report receives each report: lines without the last newline.
  explicit Findings(std::function<void(std::string_view)> Report)
      : Report(std::move(Report)) {}

  void useProgram(std::shared_ptr<const Image> Program);

  /// Reports what \p Check found unless the same instruction has been reported
  /// for it. \p Other, if not 0, is a second instruction that takes part.
  void add(std::string_view Check, const Culprit &C, const std::string &What,
           uint32_t Other = 0);

  /// "file:line (function)" of \p Pc.
  std::string place(uint32_t Pc) const { return Source->describe(Pc); }

  /// Says how often what was reported happened, if more than once.
  void reportRepeats();
  uint64_t count() const { return Total; }

private:
  struct Key {
    std::string Check;
    const Image *Program;
    uint32_t Pc, Other;
    auto operator<=>(const Key &) const = default;
  };
  std::function<void(std::string_view)> Report;
  std::shared_ptr<const Image> Program;
  std::unique_ptr<SourceLines> Source;
  std::map<Key, uint64_t> Counts;
  uint64_t Total = 0, Reported = 0;
};

/// What one checker says its findings to, under the checker's name.
class Reporter {
public:
  /// \p All must outlive it, and so must what \p Check names.
  Reporter(Findings &All, std::string_view Check) : All(All), Check(Check) {}

  /// See Findings::add().
  void add(const Culprit &C, const std::string &What, uint32_t Other = 0) {
    All.add(Check, C, What, Other);
  }
  std::string place(uint32_t Pc) const { return All.place(Pc); }

private:
  Findings &All;
  std::string_view Check;
};

} // namespace vorion::isasim
