/// One line for every warp instruction.
#pragma once

#include "vorion/isasim/Image.h"
#include "vorion/isasim/Observer.h"

#include <cstdio>
#include <memory>

namespace vorion::isasim {

class Trace : public Observer {
public:
  /// Writes to \p OutIn, which must outlive the trace. \p ProgramIn names
  /// addresses and may be nullptr.
  Trace(std::FILE *OutIn, std::shared_ptr<const Image> ProgramIn)
      : Out(OutIn), Program(std::move(ProgramIn)) {}

  /// "core.warp pc <symbol> mask instruction -> result", where the result is
  /// one word if all active lanes agree, else the word of each active lane.
  void commit(const Commit &C) override;

private:
  std::FILE *Out;
  std::shared_ptr<const Image> Program;
};

} // namespace vorion::isasim
