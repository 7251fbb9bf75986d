/// Host code for what the interpreter is found in most: the interpreter goes
/// on in it, and it in the interpreter (docs/adr/0008-translator.md).
#pragma once

#include "core/CodeTable.h"

#include <memory>
#include <set>
#include <vector>

namespace vorion::isasim {

namespace translate {
class HostCode;
}

class Translator {
public:
  /// Whether this build and this host have what it needs.
  static bool isThere();
  /// That, in words.
  static const char *needs();

  /// Translates parts of \p Code, which \p Exec executes otherwise. Both live
  /// longer.
  Translator(CodeTable &Code, const ExecTable &Exec);
  ~Translator();
  Translator(const Translator &) = delete;
  Translator &operator=(const Translator &) = delete;

  /// A warp has been found in front of \p At, after a jump most likely. Its
  /// surroundings are translated, if that has not been tried yet. No core may
  /// be running.
  void seen(const Insn *At);

  /// How many pieces have been translated.
  unsigned regions() const { return Regions; }

private:
  unsigned Regions = 0;
  // Without the translator nobody uses them.
  [[maybe_unused]] CodeTable &Code;
  [[maybe_unused]] const ExecTable &Exec;
  std::unique_ptr<translate::HostCode> Host;
  std::set<const Insn *> Tried;
  /// As the host's cache has them, so that constants lie as they will.
  struct alignas(64) Line {
    uint8_t Bytes[64];
  };
  std::vector<Line> Buffer;
};

} // namespace vorion::isasim
