// The tiles that a Gaussian's support meets, ends excluded: columns x0 to x1,
// rows y0 to y1, in two words. The second is x1 | y1 << 16. The first has
// everything where the rectangle is small, since rectangles are read in the
// order of depths, a word from a line of its own, and each such line is a
// message. From its lowest bits on: 12 of x0, 12 of y0, four each of the width
// and the height less one. All ones of those say that the second word is
// needed. A picture has at most 4096 tiles a side (render/Pipeline.cpp).
#pragma once

enum { LONG_RECTANGLE = 0xff };

static uint2 make_rectangle(uint x0, uint y0, uint x1, uint y1) {
  const uint width = x1 - x0 - 1, height = y1 - y0 - 1;
  const uint size =
      max(width, height) < 16 ? width | height << 4 : (uint)LONG_RECTANGLE;
  return (uint2)(x0 | y0 << 12 | size << 24, x1 | y1 << 16);
}

static uint first_column(uint2 r) { return r.x & 0xfff; }
static uint first_row(uint2 r) { return r.x >> 12 & 0xfff; }

static uint rectangle_tiles(uint2 r) {
  return ((r.y & 0xffff) - first_column(r)) * ((r.y >> 16) - first_row(r));
}
