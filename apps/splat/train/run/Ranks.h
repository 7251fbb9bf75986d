/// The processes of one training run, each with its own device.
#pragma once

#include "device/Launcher.h"
#include "vorion/support/Expected.h"

#include <memory>

namespace vorion::splat {

/// Communication of the processes. All calls except the first three are
/// collective: all processes must make them in the same order. Ranks start at
/// 0. Not thread-safe.
class Ranks {
public:
  virtual ~Ranks() = default;

  virtual unsigned rank() const = 0;
  virtual unsigned size() const = 0;
  /// Whether this is the process that writes files and prints.
  bool first() const { return rank() == 0; }

  /// Broadcasts the data at \p Data of process \p From.
  virtual void share(unsigned From, void *Data, std::size_t Bytes) = 0;

  /// Whether \p Mine is true in at least one process.
  bool any(bool Mine);
  /// Returns the error of the first process that has one in all processes, so
  /// that none waits for a failed process. The error names the process unless
  /// it is the first.
  Expected<Success> agree(const Expected<Success> &Mine);
  /// Whether \p Launch has failed in no process. If it has in one, all have its
  /// error.
  bool allSucceeded(Launcher &Launch);
};

/// The only process.
class OneRank : public Ranks {
public:
  unsigned rank() const override { return 0; }
  unsigned size() const override { return 1; }
  void share(unsigned /*From*/, void * /*Data*/,
             std::size_t /*Bytes*/) override {}
};

/// The processes that mpirun started, or the only one. Of several processes,
/// only the first keeps its standard output; all keep standard error, for
/// messages of devices and crashes. An error if mpirun has started several and
/// this build lacks MPI.
Expected<std::unique_ptr<Ranks>> openRanks();

} // namespace vorion::splat
