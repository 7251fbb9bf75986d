/// The decoded code of programs with what has been translated of it, kept for
/// programs that are loaded again: those of an OpenCL process take turns. A
/// cache is one machine's, since host code has places in a table of
/// instructions that changes while this machine's cores stand still, and
/// another's need not.
#pragma once

#include "core/CodeTable.h"
#include "translate/Translator.h"

#include <list>
#include <memory>

namespace vorion::isasim {

struct CachedCode {
  std::shared_ptr<const Image> Program;
  const ExecTable *Exec;
  CodeTable Code;
  std::unique_ptr<Translator> Translated; ///< nullptr where it is not wanted
  size_t bytes() const;
};

class CodeCache {
public:
  /// \p CostOfInsn and \p Unit: see Translator.
  explicit CodeCache(uint64_t CostOfInsn = Translator::UsualCost,
                     VectorUnit Unit = Translator::unitOfHost())
      : CostOfInsn(CostOfInsn), Unit(Unit) {}

  /// \p Program for \p Exec. Valid until the next call: the programs that were
  /// not wanted for longest give way.
  CachedCode &get(const std::shared_ptr<const Image> &Program,
                  const ExecTable &Exec, bool IsTranslated);

private:
  const uint64_t CostOfInsn;
  const VectorUnit Unit;
  std::list<CachedCode> All; ///< wanted last first
};

} // namespace vorion::isasim
