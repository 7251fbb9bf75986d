/// The image's code, decoded once for all cores.
#pragma once

#include "core/Exec.h"
#include "vorion/isasim/Image.h"

#include <memory>
#include <vector>

namespace vorion::isasim {

/// Every word from the first to the last executable segment as an Insn, and one
/// more that traps behind the last. Code cannot be written (docs/abi.md), so it
/// never changes.
class CodeTable {
public:
  CodeTable(const Image &Program, const ExecTable &Exec);

  const Insn *begin() const { return Insns.data(); }
  uint32_t low() const { return Lo; }
  uint32_t count() const { return static_cast<uint32_t>(Insns.size() - 1); }
  /// The instruction at \p Pc, or the one that traps if there is no code.
  const Insn *find(uint32_t Pc) const;
  /// Executes \p I by \p Run from now on, with all lanes active (\p Full 1) or
  /// some (0). No core may be running.
  void setHandler(const Insn *I, unsigned Full, Handler Run) {
    Insns[static_cast<size_t>(I - begin())].Run[Full] = Run;
  }

private:
  Insn decodeAt(uint32_t Pc, uint32_t Word, const ExecTable &Exec) const;

  uint32_t Lo = 0;
  std::vector<Insn> Insns;
};

} // namespace vorion::isasim
