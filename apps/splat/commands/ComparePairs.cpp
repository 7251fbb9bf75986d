#include "commands/Compare.h"

#include "io/Npz.h"
#include "vorion/support/Diagnostics.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace vorion::splat {

Expected<Success> comparePairs(const CompareArguments &A) {
  const auto First = readNpz(A.Reference);
  if (!First)
    return First.error();
  const auto Second = readNpz(A.Picture);
  if (!Second)
    return Second.error();
  for (const char *Name : {"tile", "depth_bits", "index"}) {
    for (const auto &[Path, Arrays] :
         {std::pair(&A.Reference, &*First), std::pair(&A.Picture, &*Second)})
      if (!Arrays->contains(Name) || Arrays->at(Name).Type != "i4")
        return Error{*Path, fmt::format("no int32 array {}, expected what "
                                        "--dump-pairs writes",
                                        Name)};
    const auto X = First->at(Name).toDoubles();
    const auto Y = Second->at(Name).toDoubles();
    if (X == Y)
      continue;
    const auto At = std::mismatch(X.begin(), X.end(), Y.begin(), Y.end());
    return Error{A.Picture,
                 fmt::format("{} pairs, {} differs from place {} on, expected "
                             "the {} pairs of {}",
                             Y.size(), Name, At.first - X.begin(), X.size(),
                             A.Reference),
                 ExitCode::GuestFailed};
  }
  printOut("equal: {} pairs\n", First->at("tile").elements());
  return Success{};
}

} // namespace vorion::splat
