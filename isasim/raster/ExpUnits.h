/// The numbers of the exponential units that vr_options.exp chooses between.
/// Their code is in ExpVector.h and ScalarUnits.h; what they are and cost is in
/// intrinsics/Units.td.
#pragma once

#include <cstdint>

namespace vorion::raster {

/// What all units but the correctly rounded one share: exp(p) = 2^-y with
/// y = -p log2(e), whole part and fraction treated apart.
namespace base2_exp {
inline constexpr float Log2E = 0x1.715476p0F;
/// Results below 2^-126 are 0: no subnormal numbers in the units.
inline constexpr int SmallestExponent = 126;
/// |p| is held at this, beyond which every result is 0.
inline constexpr float Largest = 90.0F;

constexpr int32_t nearest(double Positive) {
  const auto Down = static_cast<int32_t>(Positive);
  return Positive - Down < 0.5 ? Down : Down + 1;
}
} // namespace base2_exp

/// Numbers of the table units, of 2^EntryBits entries: y in fixed point has a
/// whole part, the number of a table entry, and a rest of RestBits that
/// interpolates to the next entry.
namespace table_exp {
inline constexpr int RestBits = 12;
inline constexpr int DropBits = 12;

template <int EntryBits> struct Table {
  static constexpr int Entries = 1 << EntryBits;
  static constexpr int FractionBits = EntryBits + RestBits;
  static constexpr int StartBits = FractionBits + 1;
  /// Entry i: its start 2^(-i/Entries) * 2^FractionBits, rounded, above
  /// DropBits bits of the drop from there to the next entry's start.
  int32_t Words[Entries];
};

/// Square roots of 1/2 by Newton's method give 2^(-1/Entries) at compile time.
template <int EntryBits> constexpr Table<EntryBits> makeTable() {
  double Step = 0.5;
  for (int I = 0; I != EntryBits; ++I) {
    double Root = 1.0;
    for (int N = 0; N != 40; ++N)
      Root = 0.5 * (Root + Step / Root);
    Step = Root;
  }
  Table<EntryBits> T{};
  double Value = 1 << Table<EntryBits>::FractionBits;
  for (int I = 0; I != Table<EntryBits>::Entries; ++I) {
    const auto Here = base2_exp::nearest(Value);
    Value *= Step;
    T.Words[I] = Here << DropBits | (Here - base2_exp::nearest(Value));
  }
  return T;
}
template <int EntryBits>
inline constexpr Table<EntryBits> TableOf = makeTable<EntryBits>();
} // namespace table_exp

/// Numbers of the polynomial units: 2^-g for 0 <= g < 1 as 1 + C1 g + C2 g^2 +
/// ... in fp32, by Horner's rule. Of all polynomials of the degree that are 1
/// at 0 and 1/2 at 1, so that the unit is continuous and a Gaussian's centre
/// keeps its opacity, those of least relative error (found by Lawson's
/// iteration), rounded to fp32.
template <unsigned Degree> struct ExpPolynomial;
template <> struct ExpPolynomial<2> {
  static constexpr float Coefficients[] = {-0x1.56fae8p-1F, 0x1.5beba0p-3F};
};
template <> struct ExpPolynomial<3> {
  static constexpr float Coefficients[] = {-0x1.62020ap-1F, 0x1.d82da4p-3F,
                                           -0x1.4095eap-5F};
};
template <> struct ExpPolynomial<4> {
  static constexpr float Coefficients[] = {-0x1.62d838p-1F, 0x1.ea4d86p-3F,
                                           -0x1.b338d2p-5F, 0x1.bc31dap-8F};
};

} // namespace vorion::raster
