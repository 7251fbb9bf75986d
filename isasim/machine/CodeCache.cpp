#include "machine/CodeCache.h"

#include <algorithm>
#include <iterator>

namespace vorion::isasim {

/// A renderer has some ten programs, each some hundred thousand bytes here.
static constexpr size_t MostPrograms = 32;
static constexpr size_t MostBytes = 64 << 20;

/// Whether they have the same code at the same places.
static bool hasSameCode(const Image &A, const Image &B) {
  const auto IsSame = [](const Image::Segment &X, const Image::Segment &Y) {
    return X.Executable == Y.Executable &&
           (!X.Executable || (X.Address == Y.Address &&
                              X.MemBytes == Y.MemBytes && X.Bytes == Y.Bytes));
  };
  return &A == &B || std::ranges::equal(A.segments(), B.segments(), IsSame);
}

size_t CachedCode::bytes() const {
  return size_t{Code.count()} * sizeof(Insn) +
         (Translated ? Translated->bytes() : 0);
}

CachedCode &CodeCache::get(const std::shared_ptr<const Image> &Program,
                           const ExecTable &Exec, bool IsTranslated) {
  const auto At = std::ranges::find_if(All, [&](const CachedCode &C) {
    return C.Exec == &Exec && (C.Translated != nullptr) == IsTranslated &&
           hasSameCode(*C.Program, *Program);
  });
  if (At != All.end()) {
    All.splice(All.begin(), All, At);
    return All.front();
  }
  CachedCode &New =
      All.emplace_front(Program, &Exec, CodeTable(*Program, Exec), nullptr);
  if (IsTranslated)
    New.Translated =
        std::make_unique<Translator>(New.Code, Exec, CostOfInsn, Unit);
  size_t Bytes = 0, Kept = 0;
  for (const CachedCode &C : All) {
    Bytes += C.bytes();
    if (Kept == MostPrograms || (Kept != 0 && Bytes > MostBytes))
      break;
    ++Kept;
  }
  All.erase(std::next(All.begin(), static_cast<std::ptrdiff_t>(Kept)),
            All.end());
  return New;
}

} // namespace vorion::isasim
