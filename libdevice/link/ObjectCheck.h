/// Which files may become part of a program for the device. Code compiled for
/// scalar RISC-V branches without splits and is wrong under divergence, so
/// the link refuses it (docs/decisions.md, 5).
#pragma once

#include "vorion/support/Expected.h"

#include <cstddef>
#include <span>
#include <string>

namespace vorion::link {

/// The text of Tag_RISCV_arch of an ELF32 RISC-V relocatable or executable
/// file, e.g. "rv32i2p1_m2p0_xvortex1p0". \p Name is used in messages only.
/// RISC-V ABIs specification, chapter "ELF Object Files", "Attributes".
Expected<std::string> readArchAttribute(std::span<const std::byte> File,
                                        const std::string &Name);

/// Success if \p File is an object with XVortex among its extensions, or an
/// archive of such objects only.
Expected<Success> checkInput(std::span<const std::byte> File,
                             const std::string &Name);

} // namespace vorion::link
