/// A region for warps of which one lane is active, in the host's scalar
/// instructions.
#pragma once

#include "core/Exec.h"
#include "translate/Region.h"

#include <map>
#include <span>

namespace vorion::isasim::translate {

/// Where such code begins, by the instruction that it is entered at. rdi, rsi
/// and rdx are as a Handler has them.
struct OneLaneCode {
  size_t Bytes = 0;
  std::map<const Insn *, const uint8_t *> Entries;
};

/// Writes the code of \p Region to \p Buffer, and may be moved from there with
/// all that lies around it. It leaves to the interpreter what changes the
/// active lanes. Throws Xbyak::Error where the buffer is too small.
OneLaneCode writeForOneLane(const ExecTable &Exec, const CodeTable &Code,
                            const std::vector<GuestInsn> &Region,
                            std::span<uint8_t> Buffer);

} // namespace vorion::isasim::translate
