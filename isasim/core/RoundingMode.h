/// Rounding modes of the instruction word and of frm (RISC-V F, "Rounding
/// modes"). Every vector level includes this.
#pragma once

namespace vorion::isasim {

enum RoundingMode : unsigned { Rne = 0, Rtz = 1, Rdn = 2, Rup = 3, Rmm = 4 };

/// The instruction word's "as frm says".
inline constexpr unsigned DynamicRm = 7;

} // namespace vorion::isasim
