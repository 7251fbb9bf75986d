#include "LoadedImage.h"

#include <cassert>

using namespace vorion::runtime;

void LoadedImage::restoreInto(isasim::Machine &Machine) {
  Machine.load(Program);
  if (!Data)
    return;
  [[maybe_unused]] const bool Fits = Machine.setImageData(*Data);
  assert(Fits && "the data are those of this image");
}

void LoadedImage::saveFrom(const isasim::Machine &Machine) {
  Data = Machine.imageData();
}
