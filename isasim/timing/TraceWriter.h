/// Writing a core's trace, and reading it back.
#pragma once

#include "core/State.h"
#include "timing/TraceAppend.h"

#include <cstddef>
#include <span>
#include <vector>

namespace vorion::isasim {

/// A trace that is appended at one end and consumed at the other. One thread at
/// a time: the core's while it runs, the clock's while all are parked.
class TraceBuffer : public CoreTrace {
public:
  TraceBuffer();
  TraceBuffer(const TraceBuffer &) = delete;
  TraceBuffer &operator=(const TraceBuffer &) = delete;

  /// Makes room for at least one more run and access.
  void grow();
  /// Forgets everything.
  void clear();

  /// \name Reading
  /// @{
  bool empty() const { return Runs.data() + RunsRead == RunAt; }
  size_t size() const {
    return static_cast<size_t>(RunAt - Runs.data()) - RunsRead;
  }
  const RunRecord &front() const { return Runs[RunsRead]; }
  /// The one behind front(), or nullptr if it has not been written yet.
  void pop() { ++RunsRead; }
  uint32_t word(size_t N = 0) const { return Words[WordsRead + N]; }
  const uint32_t *words() const { return Words.data() + WordsRead; }
  void popWords(size_t N) { WordsRead += N; }
  /// Gives back the room of what has been read.
  void compact();
  /// @}

private:
  void place(size_t NumRuns, size_t NumWords);

  std::vector<RunRecord> Runs;
  std::vector<uint32_t> Words;
  size_t RunsRead = 0, WordsRead = 0;
};

/// Appends words of an instruction that did not park.
void traceWords(WarpState *S, std::span<const uint32_t> Words);
/// Appends that the parked instruction \p I, with no access, completed.
void traceParked(WarpState *S, const Insn *I, Event E,
                 std::span<const uint32_t> Words = {});

} // namespace vorion::isasim
