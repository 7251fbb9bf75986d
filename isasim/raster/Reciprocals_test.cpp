// Every unit for 1 / (1 - alpha) against MPFR over its whole range: the errors
// that the paper and docs/rasterizer.md name.
#include "raster/Backward.h"
#include "raster/UnitTables.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <mpfr.h>
#include <vector>

namespace vorion::raster {
namespace {

constexpr float Least = 1.0F / 255.0F, Most = 0.99F;

/// 1 / (1 - Alpha) of the exact numbers, to 100 bits, as a double.
double exactReciprocal(float Alpha) {
  mpfr_t V;
  mpfr_init2(V, 100);
  mpfr_set_flt(V, Alpha, MPFR_RNDN);
  mpfr_ui_sub(V, 1, V, MPFR_RNDN);
  mpfr_ui_div(V, 1, V, MPFR_RNDN);
  const double Result = mpfr_get_d(V, MPFR_RNDN);
  mpfr_clear(V);
  return Result;
}

/// Alphas from \p From to \p To in steps of \p Step floats, both ends included.
std::vector<float> alphas(float From, float To, int Step) {
  std::vector<float> All;
  for (float A = From; A < To;) {
    All.push_back(A);
    int32_t Bits = 0;
    std::memcpy(&Bits, &A, 4);
    Bits += Step;
    std::memcpy(&A, &Bits, 4);
  }
  do
    All.push_back(To);
  while (All.size() % 16 != 0);
  return All;
}

std::vector<float> evaluate(const BackwardDatapath &Level, Reciprocal Unit,
                            std::vector<float> Alphas) {
  Level.Reciprocals(Unit, Alphas.data(), Alphas.size());
  return Alphas;
}

struct Errors {
  double Worst = 0;    ///< relative
  double At = 0;       ///< alpha
  double Highest = -1; ///< signed
};

Errors errors(Reciprocal Unit, float From, float To) {
  const auto In = alphas(From, To, 1999);
  const auto Out = evaluate(*backwardDatapaths().back(), Unit, In);
  Errors E;
  for (std::size_t I = 0; I != In.size(); ++I) {
    const double Exact = exactReciprocal(In[I]);
    const double Error = double(Out[I]) / Exact - 1;
    E.Highest = std::max(E.Highest, Error);
    if (std::fabs(Error) > E.Worst) {
      E.Worst = std::fabs(Error);
      E.At = In[I];
    }
  }
  return E;
}

TEST(Reciprocals, UnitsStayWithinTheirBounds) {
  for (const ReciprocalUnit &U : ReciprocalUnits) {
    const Errors E = errors(static_cast<Reciprocal>(U.Option), Least, Most);
    RecordProperty(std::string(U.Name), std::to_string(E.Worst));
    EXPECT_LE(E.Worst, U.MaxRelativeError) << U.Name;
    // The bound says something: it is nearly reached.
    EXPECT_GE(E.Worst, 0.6 * U.MaxRelativeError) << U.Name;
  }
}

TEST(Reciprocals, TaylorEndsAtThePapersError) {
  // The sum to alpha^4 leaves alpha^5 of the whole.
  for (const Reciprocal Unit : {Reciprocal::EvenLeft, Reciprocal::LogBest}) {
    const Errors E = errors(Unit, Least, std::nextafter(0.5F, 0.0F));
    EXPECT_NEAR(E.Worst, 0.03125, 1e-5);
    EXPECT_NEAR(E.At, 0.5, 1e-4);
  }
}

TEST(Reciprocals, SpacingOfTheTableDecidesTheUpperHalf) {
  const auto Upper = [](Reciprocal Unit) {
    return errors(Unit, 0.5F, Most).Worst;
  };
  EXPECT_NEAR(Upper(Reciprocal::EvenLeft), 0.546, 1e-3);
  EXPECT_NEAR(Upper(Reciprocal::EvenBest), 0.323, 1e-3);
  EXPECT_NEAR(Upper(Reciprocal::LogLeft), 0.0224, 1e-4);
  EXPECT_NEAR(Upper(Reciprocal::LogBest), 0.0033, 1e-4);
}

TEST(Reciprocals, ApproximationsAreTooSmallButForRounding) {
  for (const ReciprocalUnit &U : ReciprocalUnits)
    EXPECT_LE(errors(static_cast<Reciprocal>(U.Option), Least, Most).Highest,
              1.7e-7)
        << U.Name;
}

TEST(Reciprocals, SameBitsOnEveryLevel) {
  const auto In = alphas(Least, Most, 49999);
  for (const ReciprocalUnit &U : ReciprocalUnits) {
    const auto Unit = static_cast<Reciprocal>(U.Option);
    const auto Expected = evaluate(*backwardDatapaths().front(), Unit, In);
    for (const BackwardDatapath *Level : backwardDatapaths())
      EXPECT_EQ(evaluate(*Level, Unit, In), Expected)
          << U.Name << " " << Level->Name;
  }
}

} // namespace
} // namespace vorion::raster
