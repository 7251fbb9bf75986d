// The tiles that a Gaussian's support meets, ends excluded: in x the columns x0
// and x1 with the rows y0 and y1 in the upper halves, (x0 | y0 << 16,
// x1 | y1 << 16).

static uint2 make_rectangle(uint x0, uint y0, uint x1, uint y1) {
  return (uint2)(x0 | y0 << 16, x1 | y1 << 16);
}

static uint rectangle_width(uint2 r) { return (r.y & 0xffff) - (r.x & 0xffff); }

static uint rectangle_tiles(uint2 r) {
  return rectangle_width(r) * ((r.y >> 16) - (r.x >> 16));
}
