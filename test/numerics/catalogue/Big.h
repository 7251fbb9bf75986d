/// Numbers of 256 bits with MPFR's exponents: nothing that a scene holds
/// overflows or cancels in them, so that formulas can stand as in a textbook.
#pragma once

#include <mpfr.h>
#include <utility>

namespace vorion::test {

class Big {
public:
  static constexpr mpfr_prec_t Bits = 256;

  Big(double Value = 0) : Big(Empty()) { mpfr_set_d(V, Value, MPFR_RNDN); }
  Big(const Big &Other) : Big(Empty()) { mpfr_set(V, Other.V, MPFR_RNDN); }
  Big(Big &&Other) noexcept : Big(Empty()) { mpfr_swap(V, Other.V); }
  Big &operator=(const Big &Other) {
    mpfr_set(V, Other.V, MPFR_RNDN);
    return *this;
  }
  Big &operator=(Big &&Other) noexcept {
    mpfr_swap(V, Other.V);
    return *this;
  }
  ~Big() { mpfr_clear(V); }

  static Big pi() {
    Big R;
    mpfr_const_pi(R.V, MPFR_RNDN);
    return R;
  }

  explicit operator double() const { return mpfr_get_d(V, MPFR_RNDN); }
  explicit operator float() const { return mpfr_get_flt(V, MPFR_RNDN); }
  bool finite() const { return mpfr_number_p(V) != 0; }

  friend Big operator+(const Big &A, const Big &B) {
    return binary(mpfr_add, A, B);
  }
  friend Big operator-(const Big &A, const Big &B) {
    return binary(mpfr_sub, A, B);
  }
  friend Big operator*(const Big &A, const Big &B) {
    return binary(mpfr_mul, A, B);
  }
  friend Big operator/(const Big &A, const Big &B) {
    return binary(mpfr_div, A, B);
  }
  friend Big operator-(const Big &A) { return Big() - A; }
  friend bool operator<(const Big &A, const Big &B) {
    return mpfr_less_p(A.V, B.V) != 0;
  }
  friend bool operator<=(const Big &A, const Big &B) {
    return mpfr_lessequal_p(A.V, B.V) != 0;
  }
  friend Big sqrt(const Big &A) { return unary(mpfr_sqrt, A); }
  friend Big exp(const Big &A) { return unary(mpfr_exp, A); }
  friend Big abs(const Big &A) { return unary(mpfr_abs, A); }
  friend Big ceil(const Big &A) { return unary(mpfr_rint_ceil, A); }

private:
  struct Empty {};
  explicit Big(Empty /*Value*/) { mpfr_init2(V, Bits); }

  using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
  static Big unary(Unary F, const Big &A) {
    Big R{Empty()};
    F(R.V, A.V, MPFR_RNDN);
    return R;
  }
  static Big binary(Binary F, const Big &A, const Big &B) {
    Big R{Empty()};
    F(R.V, A.V, B.V, MPFR_RNDN);
    return R;
  }

  mpfr_t V;
};

} // namespace vorion::test
