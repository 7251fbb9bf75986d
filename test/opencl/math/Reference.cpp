/// Says what the math functions have to give, to tests in other languages.
///
/// It begins with a line for each row of Functions.cpp: expression, and the
/// limits of half, float and double. An empty line ends them. Then it answers
/// requests, of which each is a line:
///
///     arguments FORMAT ROW COUNT   x, y and z of each of COUNT cases
///     errors FORMAT ROW COUNT      reads x, y, z and a result of each case;
///                                  answers the result's error in units of the
///                                  last place, and what is right
///
/// FORMAT is the type's size in bytes. Numbers are doubles as they lie in
/// memory.

#include "Arguments.h"
#include "Functions.h"
#include "Ulp.h"

#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace vorion::test;

void writeNumbers(const std::vector<double> &Numbers) {
  std::cout.write(
      reinterpret_cast<const char *>(Numbers.data()),
      static_cast<std::streamsize>(Numbers.size() * sizeof(double)));
  std::cout.flush();
}

template <typename Real>
void writeArguments(const MathFunction &F, std::size_t Count) {
  const auto Columns = argumentsOf<Real>(F, Count);
  std::vector<double> Numbers;
  for (std::size_t I = 0; I < Count; ++I)
    for (const auto &Column : Columns)
      Numbers.push_back(double(Column[I]));
  writeNumbers(Numbers);
}

template <typename Real>
void writeErrors(const MathFunction &F, std::size_t Count) {
  std::vector<double> Cases(4 * Count), Numbers;
  std::cin.read(reinterpret_cast<char *>(Cases.data()),
                static_cast<std::streamsize>(Cases.size() * sizeof(double)));
  for (std::size_t I = 0; I < Count; ++I) {
    const double *Case = &Cases[4 * I];
    Number X(Case[0]), Y(Case[1]), Z(Case[2]), Exact;
    F.Exact(Exact.get(), X.get(), Y.get(), Z.get());
    const double Right = mpfr_get_d(Exact.get(), MPFR_RNDN);
    Numbers.push_back(ulpError(static_cast<Real>(Case[3]), Exact.get()));
    Numbers.push_back(Right);
  }
  writeNumbers(Numbers);
}

template <typename Real>
void answer(const std::string &Verb, const MathFunction &F, std::size_t Count) {
  if (Verb == "arguments")
    writeArguments<Real>(F, Count);
  else
    writeErrors<Real>(F, Count);
}

} // namespace

int main() {
  for (const MathFunction &F : mathFunctions())
    std::printf("%s\t%g\t%g\t%g\n", F.Expression, F.HalfLimit, F.SingleLimit,
                F.DoubleLimit);
  std::printf("\n");
  std::fflush(stdout);
  std::string Line;
  while (std::getline(std::cin, Line)) {
    std::istringstream Words(Line);
    std::string Verb;
    std::size_t Size = 0, Row = 0, Count = 0;
    Words >> Verb >> Size >> Row >> Count;
    if (!Words || Row >= mathFunctions().size())
      return 1;
    const MathFunction &F = mathFunctions()[Row];
    if (Size == sizeof(_Float16))
      answer<_Float16>(Verb, F, Count);
    else if (Size == sizeof(float))
      answer<float>(Verb, F, Count);
    else
      answer<double>(Verb, F, Count);
  }
}
