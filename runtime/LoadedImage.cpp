#include "LoadedImage.h"

#include <cassert>

using namespace vorion::runtime;

void LoadedImage::restoreInto(isasim::Machine &Machine) {
  Machine.load(Program);
  auto Saved = Data.begin();
  for (const auto &Segment : Program->segments()) {
    if (!Segment.Writable || Saved == Data.end())
      continue;
    [[maybe_unused]] const bool Wrote =
        Machine.write(Segment.Address, *Saved++);
    assert(Wrote && "a segment of the loaded image is writable by the host");
  }
}

void LoadedImage::saveFrom(const isasim::Machine &Machine) {
  Data.clear();
  for (const auto &Segment : Program->segments()) {
    if (!Segment.Writable)
      continue;
    auto &Bytes = Data.emplace_back(Segment.MemBytes);
    [[maybe_unused]] const bool Read = Machine.read(Segment.Address, Bytes);
    assert(Read && "a segment of the loaded image is readable by the host");
  }
}
