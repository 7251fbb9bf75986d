/// One checker of `--check`. A new one is its own files and one line of
/// Checks.def (docs/adding-a-checker.md).
#pragma once

#include "observe/check/Findings.h"
#include "observe/check/Places.h"

#include <memory>

namespace vorion::isasim {

class Check : public Observer {
public:
  /// Bytes that are to stay free behind each buffer.
  virtual uint64_t guardBytes() const { return 0; }
};

/// What makes each checker, which says to \p Out what it finds. \p Where must
/// outlive it.
#define VORION_CHECK(NAME, MAKE)                                               \
  std::unique_ptr<Check> MAKE(Reporter Out, const Places &Where);
#include "observe/check/Checks.def"

} // namespace vorion::isasim
