/// A file of trace events, which ui.perfetto.dev opens.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace vorion::isasim {

/// What is written is the JSON form of the Trace Event Format. Rows of the
/// picture are threads, which count from 0 in each group; groups of rows are
/// processes, which count from 1.
class TraceEvents {
public:
  /// Writes to \p OutIn, which can be repositioned and must outlive this. A
  /// microsecond of the picture stands for \p UnitIn.
  TraceEvents(std::FILE *OutIn, std::string_view UnitIn)
      : Out(OutIn), Unit(UnitIn) {}

  void nameProcess(unsigned Process, std::string_view Name);
  void nameThread(unsigned Process, unsigned Thread, std::string_view Name);
  /// Something that lasts. \p Args is a JSON object, or empty.
  void slice(unsigned Process, unsigned Thread, std::string_view Name,
             uint64_t From, uint64_t To, std::string_view Args = {});
  /// A figure that is \p Value from \p From on, until it is told again.
  void counter(unsigned Process, std::string_view Name, uint64_t From,
               double Value);

  /// Everything so far is a complete file; what follows writes over its end.
  void complete();
  uint64_t events() const { return Events; }

private:
  /// What a row is called in the file. Perfetto gives a thread 0 the number of
  /// its process, and takes the thread that has this number for the main one:
  /// no row may have either number.
  static unsigned threadId(unsigned Thread) { return 1000 + Thread; }

  void event(const std::string &Json);

  std::FILE *Out;
  std::string Unit;
  uint64_t Events = 0;
};

} // namespace vorion::isasim
