// Somebody else's exponential unit: eight pieces an octave, each a straight
// line between its ends.
#include <cmath>
#include <vorion/isasim/Plugin.h>

using namespace vorion::isasim;

namespace {

constexpr float Log2E = 0x1.715476p0F, Pieces = 8;

float evaluate(float Power) {
  const float Y = -Power * Log2E * Pieces;
  if (Y > 126 * Pieces)
    return 0;
  const float Piece = std::floor(Y), Rest = Y - Piece;
  const float Start = std::exp2(-Piece / Pieces);
  const float End = std::exp2(-(Piece + 1) / Pieces);
  return Start + (End - Start) * Rest;
}

} // namespace

#ifndef REPLACES
#define REPLACES "table"
#endif
const Plugin vorion_plugin = {.Exp = {REPLACES, evaluate}};
