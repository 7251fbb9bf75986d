// The loss of a picture against a photograph and its gradient: 0.8 of the mean
// absolute difference and 0.2 of 1 - SSIM (Wang et al. 2004, "Image quality
// assessment"), whose window is a Gaussian of 11x11 pixels with sigma 1.5,
// zero outside the picture. The window is separable: every quantity is summed
// along rows, then along columns, and the gradient goes back the same way, as
// the window is its own adjoint. reference/Loss.h is the same in fp64.
//
// A group is a warp and has a channel of a tile, LANES columns by TILE_ROWS
// rows; a tile at the picture's lower side has fewer rows. What the tile's
// windows cover is read once, into local memory, zero where it is beyond the
// picture. A work-item has a column in both sums, so that lanes access
// neighbouring words; along columns it adds up a run of sums together, so that
// a value that was read serves all of them. Only the slopes go through memory.

// Rows of a group's tile.
#pragma vorion choice uint TILE_ROWS
// A launch has some rows of tiles of a picture.
#pragma vorion choice flag DIVIDED

#define LANES 16
#define REACH 5
#define MOMENTS 5
#define SLOPES 3

// Sums that a work-item adds up at a time: as many as registers hold.
#define COLUMN_RUN 7
// Rows that are read before the first of them is stored: the compiler does not
// move a read over a store.
#define PICTURE_AHEAD 2
#define SLOPES_AHEAD 2
#define GRADIENTS_AHEAD 3
#if TILE_ROWS % COLUMN_RUN || TILE_ROWS % GRADIENTS_AHEAD
#error a run of rows leaves the tile
#endif

// Rows that windows cover, and those that are read; columns for two warps. In
// local memory a row's values lie together, a quantity after the other, so that
// constants tell them apart.
#define ROWS (TILE_ROWS + 2 * REACH)
#define ROWS_READ(ahead) ((ROWS + (ahead) - 1) / (ahead) * (ahead))
#define COLUMNS (2 * LANES)
#if LANES < 2 * REACH
#error windows cover more than two tiles
#endif
#define READ_PITCH(quantities) ((quantities) * COLUMNS)
#define SUM_PITCH(quantities) ((quantities) * LANES)

__constant float window[REACH + 1] = {0.2660117248617943f,   0.21300553771125366f,
                                      0.1093606895097f,      0.03600077212843082f,
                                      0.007598758135239184f, 0.0010283800844791099f};

// SSIM's constants for values from 0 to 1.
#define C1 1e-4f
#define C2 9e-4f

// Of channel `c` of a photograph's pixel, 0 to 1.
static float photo_value(uint pixel, uint c) {
  return (float)(pixel >> 8 * c & 0xff) / 255.0f;
}

// The window of values `pitch` apart, for `run` places that follow each other,
// the first REACH values after `v`.
static inline __attribute__((always_inline)) void
window_sums(__local const float *v, uint pitch, int run, float *sums) {
#pragma unroll
  for (int j = 0; j < run + 2 * REACH; ++j) {
    const float value = v[j * pitch];
#pragma unroll
    for (int o = 0; o < run; ++o)
      if (j >= o && j <= o + 2 * REACH) {
        const float weight = window[abs(j - o - REACH)];
        sums[o] = j == o ? weight * value : fma(weight, value, sums[o]);
      }
  }
}

// As window_sums for one place of a row, of v, v^2 and, unless `by` is null,
// v by: a quantity after the other from `to` on.
static inline __attribute__((always_inline)) void
moment_sums(__local const float *v, __local const float *by,
            __local float *to) {
  float plain = 0.0f, square = 0.0f, mixed = 0.0f;
#pragma unroll
  for (int j = 0; j <= 2 * REACH; ++j) {
    const float value = v[j], other = by ? by[j] : 0.0f;
    const float weighted = window[abs(j - REACH)] * value;
    plain = j == 0 ? weighted : plain + weighted;
    square = j == 0 ? weighted * value : fma(weighted, value, square);
    mixed = j == 0 ? weighted * other : fma(weighted, other, mixed);
  }
  to[0] = plain;
  to[LANES] = square;
  if (by)
    to[2 * LANES] = mixed;
}

// The window along columns of sums along rows, which give way to it, for `count`
// rows: only this work-item reads its column.
static inline __attribute__((always_inline)) void
column_sums(__local float *rows, uint count, uint quantities, uint lane) {
  for (uint k = 0; k < quantities; ++k)
    for (uint row = 0; row < count; row += COLUMN_RUN) {
      __local float *own =
          rows + row * SUM_PITCH(quantities) + k * LANES + lane;
      float sums[COLUMN_RUN];
      window_sums(own, SUM_PITCH(quantities), COLUMN_RUN, sums);
#pragma unroll
      for (uint o = 0; o < COLUMN_RUN; ++o)
        own[o * SUM_PITCH(quantities)] = sums[o];
    }
}

// The row of tiles of a group, and the number of rows in the picture.
#ifdef DIVIDED
#define ROW_OF_TILES (first_row + get_group_id(1))
#define ROWS_OF_TILES rows_of_tiles
#else
#define ROW_OF_TILES get_group_id(1)
#define ROWS_OF_TILES get_num_groups(1)
#endif

// Where the slopes of row y begin: a quantity of the `columns` of all tiles,
// then the next.
static uint slopes_at(uint c, uint y, uint columns, uint rows_of_tiles) {
  return (c * rows_of_tiles * TILE_ROWS + y) * SLOPES * columns;
}

// Rows of the tile from row y on that are in the picture.
static uint rows_from(uint y, uint height) {
  return min((uint)TILE_ROWS, height - y);
}

// SSIM of every pixel and channel, and its slopes by the windows' means of x,
// x^2 and x y, x being the picture and y the photograph. `totals` gets each
// group's sums of |x - y| and SSIM.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
loss_slopes(__global const float *picture, __global const uint *photo,
            __global float *slopes, __global float *totals,
#ifdef DIVIDED
            uint first_row, uint rows_of_tiles,
#endif
            uint width, uint height) {
  __local float values[ROWS_READ(PICTURE_AHEAD) * READ_PITCH(2)];
  __local float rows[ROWS * SUM_PITCH(MOMENTS)];
  __local float parts[2 * LANES];

  const uint lane = get_local_id(0);
  const uint x0 = get_group_id(0) * LANES, y0 = ROW_OF_TILES * TILE_ROWS;
  const uint c = get_group_id(2);
  const uint columns = get_num_groups(0) * LANES;
  const uint own_rows = rows_from(y0, height);
  const uint read_rows = own_rows + 2 * REACH;

  for (uint first = 0; first < read_rows; first += PICTURE_AHEAD) {
    float own[2 * PICTURE_AHEAD];
    uint pixel[2 * PICTURE_AHEAD];
    int inside[2 * PICTURE_AHEAD];
#pragma unroll
    for (uint k = 0; k < 2 * PICTURE_AHEAD; ++k) {
      // Before the picture's sides a place wraps to a large one.
      const uint x = x0 + k % 2 * LANES + lane - REACH;
      const uint y = y0 + first + k / 2 - REACH;
      inside[k] = (x < width) & (y < height);
      const uint at = inside[k] ? y * width + x : 0;
      own[k] = picture[4 * at + c];
      pixel[k] = photo[at];
    }
#pragma unroll
    for (uint k = 0; k < 2 * PICTURE_AHEAD; ++k) {
      __local float *to =
          values + (first + k / 2) * READ_PITCH(2) + k % 2 * LANES + lane;
      to[0] = select(0.0f, own[k], inside[k]);
      to[COLUMNS] = select(0.0f, photo_value(pixel[k], c), inside[k]);
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  for (uint row = 0; row < read_rows; ++row) {
    __local const float *x = values + row * READ_PITCH(2) + lane;
    __local float *to = rows + row * SUM_PITCH(MOMENTS) + lane;
    moment_sums(x, x + COLUMNS, to);
    moment_sums(x + COLUMNS, 0, to + 3 * LANES);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  column_sums(rows, own_rows, MOMENTS, lane);

  float absolute = 0.0f, total = 0.0f;
#pragma unroll 3
  for (uint row = 0; row < own_rows; ++row) {
    __local const float *m = rows + row * SUM_PITCH(MOMENTS) + lane;
    const float mean_x = m[0], mean_y = m[3 * LANES];
    const float variance_x = fma(-mean_x, mean_x, m[LANES]);
    const float variance_y = fma(-mean_y, mean_y, m[4 * LANES]);
    const float covariance = fma(-mean_x, mean_y, m[2 * LANES]);
    const float a = 2.0f * mean_x * mean_y + C1;
    const float b = 2.0f * covariance + C2;
    const float p = mean_x * mean_x + mean_y * mean_y + C1;
    const float q = variance_x + variance_y + C2;
    const float inverse = 1.0f / (p * q);
    const float ssim = a * b * inverse;
    // Of ssim = a b / (p q), with the variances' own dependence on the mean.
    const float by_mean = 2.0f * (mean_y * (b - a) * inverse +
                                  mean_x * ssim * (1.0f / q - 1.0f / p));
    const int inside = x0 + lane < width;
    __global float *to =
        slopes + slopes_at(c, y0 + row, columns, ROWS_OF_TILES) + x0 + lane;
    to[0] = select(0.0f, by_mean, inside);
    to[columns] = select(0.0f, -ssim / q, inside);
    to[2 * columns] = select(0.0f, 2.0f * a * inverse, inside);
    __local const float *own =
        values + (row + REACH) * READ_PITCH(2) + lane + REACH;
    absolute += fabs(own[0] - own[COLUMNS]);
    total += select(0.0f, ssim, inside);
  }

  parts[lane] = absolute;
  parts[LANES + lane] = total;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < 2) {
    float sum = 0.0f;
    for (uint k = 0; k < LANES; ++k)
      sum += parts[lane * LANES + k];
    const uint group = (c * ROWS_OF_TILES + ROW_OF_TILES) * get_num_groups(0) +
                       get_group_id(0);
    totals[2 * group + lane] = sum;
  }
}

// dL/d(picture): `per_absolute` and `per_ssim` are the shares of one pixel's
// channel in the loss. The sign of 0 is 0. Three floats a pixel, of up to
// GRADIENTS_AHEAD - 1 more rows, which have no meaning.
__kernel __attribute__((reqd_work_group_size(LANES, 1, 1))) void
loss_gradient(__global const float *picture, __global const uint *photo,
              __global const float *slopes, __global float *gradient,
#ifdef DIVIDED
              uint first_row, uint rows_of_tiles,
#endif
              uint width, uint height, float per_absolute, float per_ssim) {
  __local float values[ROWS_READ(SLOPES_AHEAD) * READ_PITCH(SLOPES)];
  __local float rows[ROWS * SUM_PITCH(SLOPES)];

  const uint lane = get_local_id(0);
  const uint x0 = get_group_id(0) * LANES, y0 = ROW_OF_TILES * TILE_ROWS;
  const uint c = get_group_id(2);
  const uint columns = get_num_groups(0) * LANES;
  const uint own_rows = rows_from(y0, height);
  const uint read_rows = own_rows + 2 * REACH;

  for (uint first = 0; first < read_rows; first += SLOPES_AHEAD) {
    float slope[2 * SLOPES_AHEAD][SLOPES];
    int inside[2 * SLOPES_AHEAD];
#pragma unroll
    for (uint k = 0; k < 2 * SLOPES_AHEAD; ++k) {
      const uint x = x0 + k % 2 * LANES + lane - REACH;
      const uint y = y0 + first + k / 2 - REACH;
      inside[k] = (x < columns) & (y < height);
      __global const float *from =
          slopes + (inside[k] ? slopes_at(c, y, columns, ROWS_OF_TILES) + x : 0);
#pragma unroll
      for (uint p = 0; p < SLOPES; ++p)
        slope[k][p] = from[p * columns];
    }
#pragma unroll
    for (uint k = 0; k < 2 * SLOPES_AHEAD; ++k)
#pragma unroll
      for (uint p = 0; p < SLOPES; ++p)
        values[(first + k / 2) * READ_PITCH(SLOPES) + p * COLUMNS +
               k % 2 * LANES + lane] = select(0.0f, slope[k][p], inside[k]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  for (uint row = 0; row < read_rows; ++row)
#pragma unroll
    for (uint p = 0; p < SLOPES; ++p) {
      float sum;
      window_sums(values + row * READ_PITCH(SLOPES) + p * COLUMNS + lane, 1, 1,
                  &sum);
      rows[row * SUM_PITCH(SLOPES) + p * LANES + lane] = sum;
    }
  barrier(CLK_LOCAL_MEM_FENCE);
  column_sums(rows, own_rows, SLOPES, lane);

  if (x0 + lane >= width)
    return;
  for (uint row = 0; row < own_rows; row += GRADIENTS_AHEAD) {
    float own[GRADIENTS_AHEAD];
    uint pixel[GRADIENTS_AHEAD];
#pragma unroll
    for (uint o = 0; o < GRADIENTS_AHEAD; ++o) {
      const uint y = min(y0 + row + o, height - 1);
      const uint at = y * width + x0 + lane;
      own[o] = picture[4 * at + c];
      pixel[o] = photo[at];
    }
#pragma unroll
    for (uint o = 0; o < GRADIENTS_AHEAD; ++o) {
      __local const float *s = rows + (row + o) * SUM_PITCH(SLOPES) + lane;
      const float x = own[o], y = photo_value(pixel[o], c);
      const float ssim = s[0] + 2.0f * x * s[LANES] + y * s[2 * LANES];
      const float side = x > y ? 1.0f : x < y ? -1.0f : 0.0f;
      gradient[3 * ((y0 + row + o) * width + x0 + lane) + c] =
          per_absolute * side - per_ssim * ssim;
    }
  }
}
