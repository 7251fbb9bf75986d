/// What the numeric sanitizer keeps for each instruction of each program, and
/// the chains that led to values that are not finite.
#pragma once

#include "mem/SourceLines.h"
#include "vorion/isasim/Observer.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vorion::isasim {

/// Where a value comes from: nowhere that is known (0), a site (that of the
/// instruction; of a value that is off, where that was born), or, for values
/// that are not finite, an event.
class Origin {
public:
  constexpr Origin() = default;
  static constexpr Origin site(uint32_t N) { return Origin(N << 1); }
  static constexpr Origin event(uint32_t N) { return Origin(N << 1 | 1); }
  static constexpr Origin fromWord(uint32_t W) { return Origin(W); }
  constexpr uint32_t word() const { return Word; }
  constexpr bool isEvent() const { return (Word & 1) != 0; }
  constexpr bool isKnown() const { return Word != 0; }
  /// Of the site or event.
  constexpr uint32_t number() const { return (Word & ~ResidueBit) >> 1; }
  /// In a word: the value is a residue or what came of one, so that what it is
  /// off by is no error (NumericCounts.def).
  static constexpr uint32_t ResidueBit = 1U << 31;

private:
  explicit constexpr Origin(uint32_t W) : Word(W) {}
  uint32_t Word = 0;
};

/// One execution in one lane, as an example.
struct NumericSample {
  unsigned Core = 0, Warp = 0, Lane = 0;
  unsigned Operands = 0;
  bool IsInteger = false;          ///< the operand is an integer
  std::array<uint32_t, 3> Words{}; ///< bits of the operands
  std::array<double, 3> Shadows{}; ///< of the operands
  std::array<Origin, 3> From{};
  uint32_t Result = 0; ///< bits
  double Shadow = 0;   ///< of the result
};

struct NumericCounts {
#define VORION_NUMERIC_COUNT(MEMBER, NAME, DOC) uint64_t MEMBER = 0;
#include "observe/numerics/NumericCounts.def"
  double ErrorSum =
      0; ///< of the relative errors of Results, each at most 1, but of residues
  double ErrorMax = 0;

  NumericCounts &operator+=(const NumericCounts &Other);
  /// Of a result.
  void add(double Error) {
    ErrorSum += Error;
    ErrorMax = Error > ErrorMax ? Error : ErrorMax;
  }
  /// Whether there is more to say than how many results and how exact.
  bool isReportable() const { return Born || Residues || matters(); }
  /// Whether it shows in what the program does.
  bool matters() const {
    return Reached || Subnormal || Flushed || NotFinite || Decisions ||
           Branches;
  }
  double errorMean() const {
    return Results ? ErrorSum / static_cast<double>(Results) : 0;
  }
};

/// An instruction of a program.
struct Site {
  NumericCounts Counts;
  double WorstBorn = -1;   ///< error of Worst, -1 for none
  NumericSample Worst;     ///< of the results counted as Born
  uint32_t FirstEvent = 0; ///< + 1; a value that is not finite was made here
};

/// A value that is not finite came to be. One a site: its first.
struct NumericEvent {
  uint32_t Site = 0;
  NumericSample What;
};

class NumericSites {
public:
  NumericSites();

  /// The instructions of \p Program are counted from now on.
  void useProgram(const std::shared_ptr<const Image> &Program);

  /// A number for what a unit of its own makes.
  uint32_t unitNumber(std::string Name);

  /// The number of the instruction at \p Pc.
  uint32_t number(uint32_t Pc) const { return First + (Pc - Low) / 4; }
  Site &at(uint32_t Number) { return All[Number]; }

  /// A value from \p From, which is off, has come to where it shows.
  void reach(Origin From) {
    if (From.isKnown())
      ++All[From.isEvent() ? Events[From.number()].Site : From.number()]
            .Counts.Reached;
  }

  /// The event of \p What at a site; the site's first one if it has one.
  uint32_t event(uint32_t Number, const NumericSample &What);
  const std::vector<NumericEvent> &events() const { return Events; }

  /// Instructions that belong to one line, or to a function without lines.
  struct Line {
    std::optional<SourcePlace> Place;
    std::string Name; ///< "file:line (function)", or the function
    NumericCounts Counts;
    double WorstBorn = -1;
    uint32_t WorstSite = 0;
  };
  /// Lines with results, those first that make the largest errors that reach
  /// something; equal ones by name.
  std::vector<Line> lines() const;
  /// "file:line (function)" of a site.
  std::string place(uint32_t Number) const;
  /// Its instruction.
  std::string text(uint32_t Number) const;
  const Site &site(uint32_t Number) const { return All[Number]; }

private:
  struct Program {
    std::string Unit; ///< its name; then there is no code
    std::shared_ptr<const Image> Code;
    std::unique_ptr<SourceLines> Source;
    uint32_t Low = 0, First = 0, Count = 0;
  };
  const Program &programOf(uint32_t Number) const;
  uint32_t pcOf(uint32_t Number) const;

  std::vector<Program> Programs;
  std::vector<Site> All; ///< by number; 0 is nobody's
  std::vector<NumericEvent> Events;
  uint32_t First = 0, Low = 0; ///< of the present program
};

} // namespace vorion::isasim
