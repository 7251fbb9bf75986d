/// The processes of one training run, each with a device of its own.
#pragma once

#include "vorion/support/Expected.h"

#include <memory>

namespace vorion::splat {

/// One process's view of all of them. Every call but the first three is made
/// by all processes, in the same order; processes are numbered from 0. Not
/// thread-safe.
class Ranks {
public:
  virtual ~Ranks() = default;

  virtual unsigned rank() const = 0;
  virtual unsigned size() const = 0;
  /// Whether this is the process that writes files and prints.
  bool first() const { return rank() == 0; }

  /// Gives every process what process \p From has at \p Data.
  virtual void share(unsigned From, void *Data, std::size_t Bytes) = 0;

  /// Whether \p Mine is true in any process.
  bool any(bool Mine);
  /// What the first process with an error has, for all of them, so that none
  /// waits for one that has given up; it says which process, unless that is the
  /// first one.
  Expected<Success> agree(const Expected<Success> &Mine);
};

/// The only process.
class OneRank : public Ranks {
public:
  unsigned rank() const override { return 0; }
  unsigned size() const override { return 1; }
  void share(unsigned /*From*/, void * /*Data*/,
             std::size_t /*Bytes*/) override {}
};

/// Those that mpirun started, or the only one. Of several, only the first has a
/// standard output from now on; all have a standard error, for what the device
/// says and for how a process dies. An error where mpirun has started several
/// and this build is without MPI.
Expected<std::unique_ptr<Ranks>> openRanks();

} // namespace vorion::splat
