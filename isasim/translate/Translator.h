/// Host code for what the interpreter is found in most: the interpreter goes
/// on in it, and it in the interpreter (docs/adr/0008-translator.md).
#pragma once

#include "core/CodeTable.h"
#include "translate/VectorUnit.h"

#include <cstdint>
#include <memory>
#include <set>

namespace vorion::isasim {

namespace translate {
class HostCode;
}

class Translator {
public:
  /// The best that this build and this host have for it.
  static VectorUnit unitOfHost();
  /// Whether they have what it needs.
  static bool isThere() { return unitOfHost() != VectorUnit::None; }
  /// That, in words.
  static const char *needs();

  /// What is to be executed for each instruction that is translated: two to
  /// three times what the interpreter does meanwhile, which is some 3 us
  /// against 2 ns. So translations that turn out to be useless cost little of
  /// what programs take.
  static constexpr uint64_t UsualCost = 4000;

  /// Translates parts of \p Code, which \p Exec executes otherwise, for \p
  /// Unit, which the host has. Code and Exec live longer.
  Translator(CodeTable &Code, const ExecTable &Exec,
             uint64_t CostOfInsn = UsualCost, VectorUnit Unit = unitOfHost());
  ~Translator();
  Translator(const Translator &) = delete;
  Translator &operator=(const Translator &) = delete;

  /// A warp has been found in front of \p At, most likely after a jump, when it
  /// had executed \p Instructions. The surroundings of such places are
  /// translated once what was executed around them is worth it. No core may be
  /// running. \p Warp is that warp, which may stand elsewhere by now, or
  /// nullptr.
  void seen(const Insn *At, uint64_t Instructions,
            const WarpState *Warp = nullptr);

  /// How many pieces have been translated.
  unsigned regions() const { return Regions; }
  /// Loads of these that are guessed to read one word for all lanes.
  unsigned guesses() const { return Guesses; }
  /// How much memory their code takes.
  size_t bytes() const;

private:
  unsigned Regions = 0, Guesses = 0;
  // Without the translator nobody uses them.
  [[maybe_unused]] CodeTable &Code;
  [[maybe_unused]] const ExecTable &Exec;
  [[maybe_unused]] uint64_t CostOfInsn;
  [[maybe_unused]] VectorUnit Unit;
  std::unique_ptr<translate::HostCode> Host;
  /// Places that a region begins at, or is not worth to.
  std::set<const Insn *> Done;
  /// Instructions that have been executed around other places since the last
  /// translation, and how many the next one costs as far as it is known.
  [[maybe_unused]] uint64_t Credit = 0, Cost = 0;
  /// How often a translation has been put off because one lane of several was
  /// active, and the most.
  [[maybe_unused]] unsigned Alone = 0;
  static constexpr unsigned MostAlone = 4;
};

} // namespace vorion::isasim
