/// Where things lie in a WarpState, for code that is made at run time.
#pragma once

#include "core/State.h"

namespace vorion::isasim::translate {

/// The offset of what \p Member gives a reference to. WarpState is no
/// standard-layout class, so offsetof is not for it.
template <typename Function> int placeOf(Function Member) {
  static const WarpState S = {};
  return static_cast<int>(reinterpret_cast<const std::byte *>(&Member(S)) -
                          reinterpret_cast<const std::byte *>(&S));
}

#define VORION_PLACE(MEMBER)                                                   \
  placeOf([](const WarpState &S) -> const auto & { return S.MEMBER; })

/// Offsets in a Region and in a MemoryView.
inline constexpr int RegionLo = offsetof(Region, Lo),
                     RegionBytes = offsetof(Region, Bytes),
                     RegionHost = offsetof(Region, Host);
inline constexpr int InGlobal = offsetof(MemoryView, Global),
                     InLocal = offsetof(MemoryView, Local),
                     InStack = offsetof(MemoryView, Stack),
                     InImage = offsetof(MemoryView, Image),
                     InHigh = offsetof(MemoryView, High),
                     InRest = offsetof(MemoryView, Rest),
                     InWhole = offsetof(MemoryView, Whole),
                     InShift = offsetof(MemoryView, StackShift),
                     InImageWritable = offsetof(MemoryView, ImageWritable),
                     InNumImageWritable =
                         offsetof(MemoryView, NumImageWritable);

} // namespace vorion::isasim::translate
