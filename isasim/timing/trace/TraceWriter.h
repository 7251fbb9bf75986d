/// Writing a core's trace, and reading it back.
#pragma once

#include "core/State.h"
#include "timing/trace/TraceRecords.h"

#include <cstddef>
#include <span>
#include <vector>

namespace vorion::isasim {

/// A trace that is appended at one end and consumed at the other. The core's
/// thread may write while the clock's reads what was published before.
class TraceBuffer : public CoreTrace {
public:
  TraceBuffer();
  TraceBuffer(const TraceBuffer &) = delete;
  TraceBuffer &operator=(const TraceBuffer &) = delete;

  /// Makes room for at least one more run and access.
  void grow();
  /// Forgets everything.
  void clear();
  /// What has been written can be read from now on. Neither end is in use.
  void publish();

  /// \name Reading
  /// @{
  bool empty() const { return Runs.empty(); }
  size_t size() const { return Runs.size(); }
  size_t bytes() const {
    return Runs.size() * sizeof(RunRecord) + Words.size() * sizeof(uint32_t);
  }
  const RunRecord &front() const { return *Runs.front(); }
  void pop() { ++Runs.Read; }
  uint32_t word(size_t N = 0) const { return Words.front()[N]; }
  const uint32_t *words() const { return Words.front(); }
  void popWords(size_t N) { Words.Read += N; }
  /// @}

private:
  /// Records from \c Read up to \c Count are there to be read.
  template <typename Record> struct Published {
    std::vector<Record> All;
    size_t Read = 0, Count = 0;

    bool empty() const { return Read == Count; }
    size_t size() const { return Count - Read; }
    const Record *front() const { return All.data() + Read; }
    /// Takes the first \p More of \p Written, whose room may be another then.
    void take(std::vector<Record> &Written, size_t More);
  };

  size_t runsWritten() const {
    return static_cast<size_t>(RunAt - WrittenRuns.data());
  }
  size_t wordsWritten() const {
    return static_cast<size_t>(WordAt - WrittenWords.data());
  }
  void place(size_t RunsInUse, size_t WordsInUse);

  std::vector<RunRecord> WrittenRuns;
  std::vector<uint32_t> WrittenWords;
  // In lines of their own: another thread reads than writes.
  alignas(64) Published<RunRecord> Runs;
  Published<uint32_t> Words;
};

/// Appends words of an instruction that did not park.
void traceWords(WarpState *S, std::span<const uint32_t> Words);
/// Appends that the parked instruction \p I, with no access, completed.
void traceParked(WarpState *S, const Insn *I, Event E,
                 std::span<const uint32_t> Words = {});

} // namespace vorion::isasim
