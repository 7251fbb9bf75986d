/* read_image and write_image. An image and a sampler are what the driver makes
   of them: dev_image_t of PoCL in device memory, and the value of a sampler in
   OpenCL C. The formulas are those of the standard's chapter "Image Addressing
   and Filtering". */

typedef const global dev_image_t *image_p;

#define IMAGE(I) __builtin_astype(I, image_p)
#define SAMPLER(S) __builtin_astype(S, dev_sampler_t)

#define ADDRESSING                                                             \
  (CLK_ADDRESS_CLAMP_TO_EDGE | CLK_ADDRESS_CLAMP | CLK_ADDRESS_REPEAT |        \
   CLK_ADDRESS_MIRRORED_REPEAT)

/* What is known of an image from its type: it has DIMS dimensions in which
   samplers address, and if LAYERED is not 0, one more, which numbers the layers
   of an array. */
#define SHAPE int dims, int layered

/* Texels along each dimension, 1 where the image has none. */
static int4 extent(image_p image, SHAPE) {
  int4 size = (int4)(image->_width, 1, 1, 0);
  if (dims > 1)
    size.y = image->_height;
  else if (layered)
    size.y = image->_image_array_size;
  if (dims > 2)
    size.z = image->_depth;
  else if (dims == 2 && layered)
    size.z = image->_image_array_size;
  return size;
}

static int inside(int4 at, int4 size) {
  return (uint)at.x < (uint)size.x && (uint)at.y < (uint)size.y &&
         (uint)at.z < (uint)size.z;
}

static uchar *address(image_p image, int4 at) {
  return (uchar *)image->_data + at.z * image->_slice_pitch +
         at.y * image->_row_pitch +
         at.x * image->_num_channels * image->_elem_size;
}

/* --- Texels: the bits of their channels as red, green, blue, alpha. Intensity
   stands for all four, luminance for the first three. */

#define LOAD_CHANNELS(TYPE)                                                    \
  bits.x = ((const TYPE *)from)[0];                                            \
  if (channels > 1)                                                            \
    bits.y = ((const TYPE *)from)[1];                                          \
  if (channels > 2) {                                                          \
    bits.z = ((const TYPE *)from)[2];                                          \
    bits.w = ((const TYPE *)from)[3];                                          \
  }

static int is_srgb(image_p image) {
  return image->_order == CLK_sRGBA || image->_order == CLK_sBGRA;
}

/* Of a texel that is not in the image, 0: with opaque(), its colour is the
 * border's. */
static uint4 texel(image_p image, int4 at, int4 size) {
  uint4 bits = 0;
  if (!inside(at, size))
    return bits;
  const uchar *from = address(image, at);
  const int channels = image->_num_channels;
  switch (image->_elem_size) {
  case 1:
    LOAD_CHANNELS(uchar)
    break;
  case 2:
    LOAD_CHANNELS(ushort)
    break;
  default:
    LOAD_CHANNELS(uint)
  }
  switch (image->_order) {
  case CLK_BGRA:
  case CLK_sBGRA:
    return bits.zyxw;
  case CLK_INTENSITY:
    return bits.xxxx;
  case CLK_LUMINANCE:
    return bits.xxxw;
  default:
    return bits;
  }
}

/* Formats without alpha are read with an alpha of 1. */
static int opaque(image_p image) {
  return image->_num_channels < 4 && image->_order != CLK_INTENSITY;
}

static int4 extend_sign(uint4 bits, int bytes) {
  const int unused = 32 - 8 * bytes;
  return as_int4(bits << unused) >> unused;
}

/* The linear values of a channel of sRGB in half steps, n / 510: each second is
   that of a channel's bits, and those between are where rounding changes. */
constant float srgb_steps[511] = {
#include "srgb_steps.h"
};

static float4 from_srgb(uint4 bits) {
  return (float4)(srgb_steps[2 * bits.x], srgb_steps[2 * bits.y],
                  srgb_steps[2 * bits.z], (float)bits.w / 255.0f);
}

/* The channel's bits that are nearest: as many as borders between two lie
   below. */
static uint to_srgb(float value) {
  uint bits = 0;
  for (uint part = 128; part; part /= 2)
    bits += value >= srgb_steps[2 * (bits + part) - 1] ? part : 0;
  return bits;
}

static float4 texel_f(image_p image, int4 at, int4 size) {
  const uint4 bits = texel(image, at, size);
  float4 color;
  switch (image->_data_type) {
  case CLK_UNORM_INT8:
    color = is_srgb(image) ? from_srgb(bits) : convert_float4(bits) / 255.0f;
    break;
  case CLK_UNORM_INT16:
    color = convert_float4(bits) / 65535.0f;
    break;
  case CLK_SNORM_INT8:
    color = fmax(convert_float4(extend_sign(bits, 1)) / 127.0f, -1.0f);
    break;
  case CLK_SNORM_INT16:
    color = fmax(convert_float4(extend_sign(bits, 2)) / 32767.0f, -1.0f);
    break;
  case CLK_HALF_FLOAT: {
    const ushort4 halves = convert_ushort4(bits);
    color = vload_half4(0, (const half *)&halves);
    break;
  }
  default:
    color = as_float4(bits);
  }
  if (opaque(image))
    color.w = 1;
  return color;
}

static int4 texel_i(image_p image, int4 at, int4 size) {
  int4 color = extend_sign(texel(image, at, size), image->_elem_size);
  if (opaque(image))
    color.w = 1;
  return color;
}

static uint4 texel_ui(image_p image, int4 at, int4 size) {
  uint4 color = texel(image, at, size);
  if (opaque(image))
    color.w = 1;
  return color;
}

static half4 texel_h(image_p image, int4 at, int4 size) {
  return convert_half4(texel_f(image, at, size));
}

/* --- Addressing. A texel that stays outside is of the border: so
   CLK_ADDRESS_CLAMP and CLK_ADDRESS_NONE, for which the standard promises
   nothing there, are the same. */

static int texel_along(int i, int size, uint sampler) {
  return (sampler & ADDRESSING) == CLK_ADDRESS_CLAMP_TO_EDGE
             ? clamp(i, 0, size - 1)
             : i;
}

static int wrap(int i, int size) {
  return i < 0 ? i + size : i >= size ? i - size : i;
}

/* The texels on both sides of a coordinate. Filters mix them, the second with
 * this weight. */
typedef struct {
  int first, second;
  float weight;
} sides;

static sides sides_along(float u, int size, uint sampler) {
  const float length = size;
  const uint mode = sampler & ADDRESSING;
  if (sampler & CLK_NORMALIZED_COORDS_TRUE) {
    if (mode == CLK_ADDRESS_REPEAT)
      u -= floor(u);
    else if (mode == CLK_ADDRESS_MIRRORED_REPEAT)
      u = fabs(u - 2.0f * rint(0.5f * u));
    u *= length;
  }
  if (sampler & CLK_FILTER_LINEAR)
    u -= 0.5f;
  const float below = floor(u);
  sides s;
  s.weight = u - below;
  /* Far outside is as good as outside, and every number is an int. */
  s.first = (int)fmin(fmax(below, -2.0f), length);
  s.second = s.first + 1;
  if (mode == CLK_ADDRESS_REPEAT) {
    s.first = wrap(s.first, size);
    s.second = wrap(s.second, size);
  } else if (mode == CLK_ADDRESS_CLAMP_TO_EDGE ||
             mode == CLK_ADDRESS_MIRRORED_REPEAT) {
    s.first = clamp(s.first, 0, size - 1);
    s.second = clamp(s.second, 0, size - 1);
  }
  return s;
}

static int layer_at(float w, int layers) {
  return (int)fmin(fmax(rint(w), 0.0f), layers - 1.0f);
}

/* The sides of a coordinate in each dimension. A layer has the same on both. */
typedef struct {
  sides x, y, z;
} neighbours;

static neighbours neighbours_of(float4 coord, int4 size, uint sampler, SHAPE) {
  neighbours n;
  n.x = sides_along(coord.x, size.x, sampler);
  n.y = n.z = (sides){0, 0, 0.0f};
  if (dims > 1)
    n.y = sides_along(coord.y, size.y, sampler);
  else if (layered)
    n.y.first = n.y.second = layer_at(coord.y, size.y);
  if (dims > 2)
    n.z = sides_along(coord.z, size.z, sampler);
  else if (dims == 2 && layered)
    n.z.first = n.z.second = layer_at(coord.z, size.z);
  return n;
}

static int4 nearest(neighbours n) {
  return (int4)(n.x.first, n.y.first, n.z.first, 0);
}

static int4 texel_of(int4 coord, int4 size, uint sampler, SHAPE) {
  int4 at = (int4)(texel_along(coord.x, size.x, sampler), 0, 0, 0);
  if (dims > 1)
    at.y = texel_along(coord.y, size.y, sampler);
  else if (layered)
    at.y = clamp(coord.y, 0, size.y - 1);
  if (dims > 2)
    at.z = texel_along(coord.z, size.z, sampler);
  else if (dims == 2 && layered)
    at.z = clamp(coord.z, 0, size.z - 1);
  return at;
}

/* --- Reading. Images of integers are not filtered. */

static float4 filtered(image_p image, neighbours n, int4 size, int dims) {
  float4 sum = 0;
  for (int corner = 0; corner < 1 << dims; ++corner) {
    const int right = corner & 1, down = corner & 2, back = corner & 4;
    const int4 at =
        (int4)(right ? n.x.second : n.x.first, down ? n.y.second : n.y.first,
               back ? n.z.second : n.z.first, 0);
    sum += (right ? n.x.weight : 1 - n.x.weight) *
           (down ? n.y.weight : 1 - n.y.weight) *
           (back ? n.z.weight : 1 - n.z.weight) * texel_f(image, at, size);
  }
  return sum;
}

static float4 sample_f(image_p image, uint sampler, float4 coord, SHAPE) {
  const int4 size = extent(image, dims, layered);
  const neighbours n = neighbours_of(coord, size, sampler, dims, layered);
  if (sampler & CLK_FILTER_LINEAR)
    return filtered(image, n, size, dims);
  return texel_f(image, nearest(n), size);
}

static half4 sample_h(image_p image, uint sampler, float4 coord, SHAPE) {
  return convert_half4(sample_f(image, sampler, coord, dims, layered));
}

#define SAMPLE_INTEGERS(COLOR, SUFFIX)                                         \
  static COLOR sample_##SUFFIX(image_p image, uint sampler, float4 coord,      \
                               SHAPE) {                                        \
    const int4 size = extent(image, dims, layered);                            \
    const uint unfiltered = sampler & ~CLK_FILTER_LINEAR;                      \
    return texel_##SUFFIX(                                                     \
        image, nearest(neighbours_of(coord, size, unfiltered, dims, layered)), \
        size);                                                                 \
  }
SAMPLE_INTEGERS(int4, i)
SAMPLE_INTEGERS(uint4, ui)

#define LOOK_UP(COLOR, SUFFIX)                                                 \
  static COLOR look_up_##SUFFIX(image_p image, uint sampler, int4 coord,       \
                                SHAPE) {                                       \
    const int4 size = extent(image, dims, layered);                            \
    return texel_##SUFFIX(                                                     \
        image, texel_of(coord, size, sampler, dims, layered), size);           \
  }
LOOK_UP(float4, f)
LOOK_UP(half4, h)
LOOK_UP(int4, i)
LOOK_UP(uint4, ui)

/* --- Writing. What lies outside is not written. */

static uint4 bits_f(float4 color, image_p image) {
  switch (image->_data_type) {
  case CLK_UNORM_INT8: {
    const uint4 bits = convert_uint4(convert_uchar4_sat_rte(color * 255.0f));
    return is_srgb(image) ? (uint4)(to_srgb(color.x), to_srgb(color.y),
                                    to_srgb(color.z), bits.w)
                          : bits;
  }
  case CLK_UNORM_INT16:
    return convert_uint4(convert_ushort4_sat_rte(color * 65535.0f));
  case CLK_SNORM_INT8:
    return as_uint4(convert_int4(convert_char4_sat_rte(color * 127.0f)));
  case CLK_SNORM_INT16:
    return as_uint4(convert_int4(convert_short4_sat_rte(color * 32767.0f)));
  case CLK_HALF_FLOAT: {
    ushort4 halves;
    vstore_half4(color, 0, (half *)&halves);
    return convert_uint4(halves);
  }
  default:
    return as_uint4(color);
  }
}

static uint4 bits_h(half4 color, image_p image) {
  return bits_f(convert_float4(color), image);
}

static uint4 bits_i(int4 color, image_p image) {
  switch (image->_data_type) {
  case CLK_SIGNED_INT8:
    return as_uint4(clamp(color, CHAR_MIN, CHAR_MAX));
  case CLK_SIGNED_INT16:
    return as_uint4(clamp(color, SHRT_MIN, SHRT_MAX));
  default:
    return as_uint4(color);
  }
}

static uint4 bits_ui(uint4 color, image_p image) {
  switch (image->_data_type) {
  case CLK_UNSIGNED_INT8:
    return min(color, (uint)UCHAR_MAX);
  case CLK_UNSIGNED_INT16:
    return min(color, (uint)USHRT_MAX);
  default:
    return color;
  }
}

#define STORE_CHANNELS(TYPE)                                                   \
  ((TYPE *)to)[0] = bits.x;                                                    \
  if (channels > 1)                                                            \
    ((TYPE *)to)[1] = bits.y;                                                  \
  if (channels > 2) {                                                          \
    ((TYPE *)to)[2] = bits.z;                                                  \
    ((TYPE *)to)[3] = bits.w;                                                  \
  }

static void write_texel(image_p image, int4 at, uint4 bits, SHAPE) {
  if (!inside(at, extent(image, dims, layered)))
    return;
  uchar *to = address(image, at);
  const int channels = image->_num_channels;
  if (image->_order == CLK_BGRA || image->_order == CLK_sBGRA)
    bits = bits.zyxw;
  switch (image->_elem_size) {
  case 1:
    STORE_CHANNELS(uchar)
    break;
  case 2:
    STORE_CHANNELS(ushort)
    break;
  default:
    STORE_CHANNELS(uint)
  }
}

/* --- The built-in functions. */

static int4 _CL_OVERLOADABLE widen(int at) { return (int4)(at, 0, 0, 0); }
static int4 _CL_OVERLOADABLE widen(int2 at) { return (int4)(at, 0, 0); }
static int4 _CL_OVERLOADABLE widen(int4 at) { return at; }
static float4 _CL_OVERLOADABLE widen(float at) { return (float4)(at, 0, 0, 0); }
static float4 _CL_OVERLOADABLE widen(float2 at) { return (float4)(at, 0, 0); }
static float4 _CL_OVERLOADABLE widen(float4 at) { return at; }

#define READ_WITH_SAMPLER(TYPE, INTS, FLOATS, DIMS, LAYERED, COLOR, SUFFIX)    \
  COLOR _CL_OVERLOADABLE read_image##SUFFIX(TYPE image, sampler_t sampler,     \
                                            INTS coord) {                      \
    return look_up_##SUFFIX(IMAGE(image), SAMPLER(sampler), widen(coord),      \
                            DIMS, LAYERED);                                    \
  }                                                                            \
  COLOR _CL_OVERLOADABLE read_image##SUFFIX(TYPE image, sampler_t sampler,     \
                                            FLOATS coord) {                    \
    return sample_##SUFFIX(IMAGE(image), SAMPLER(sampler), widen(coord), DIMS, \
                           LAYERED);                                           \
  }
#define READ(TYPE, INTS, DIMS, LAYERED, COLOR, SUFFIX)                         \
  COLOR _CL_OVERLOADABLE read_image##SUFFIX(TYPE image, INTS coord) {          \
    return look_up_##SUFFIX(IMAGE(image), CLK_ADDRESS_NONE, widen(coord),      \
                            DIMS, LAYERED);                                    \
  }
#define WRITE(TYPE, INTS, DIMS, LAYERED, COLOR, SUFFIX)                        \
  void _CL_OVERLOADABLE write_image##SUFFIX(TYPE image, INTS coord,            \
                                            COLOR color) {                     \
    write_texel(IMAGE(image), widen(coord),                                    \
                bits_##SUFFIX(color, IMAGE(image)), DIMS, LAYERED);            \
  }
#define FOR_EACH_COLOR(MACRO, ...)                                             \
  MACRO(__VA_ARGS__, float4, f)                                                \
  MACRO(__VA_ARGS__, half4, h)                                                 \
  MACRO(__VA_ARGS__, int4, i)                                                  \
  MACRO(__VA_ARGS__, uint4, ui)

#define FUNCTIONS(TYPE, INTS, ...)                                             \
  FOR_EACH_COLOR(READ, read_only TYPE, INTS, __VA_ARGS__)                      \
  FOR_EACH_COLOR(WRITE, write_only TYPE, INTS, __VA_ARGS__)                    \
  FOR_EACH_COLOR(READ, read_write TYPE, INTS, __VA_ARGS__)                     \
  FOR_EACH_COLOR(WRITE, read_write TYPE, INTS, __VA_ARGS__)
#define FUNCTIONS_WITH_SAMPLERS(TYPE, INTS, FLOATS, ...)                       \
  FUNCTIONS(TYPE, INTS, __VA_ARGS__)                                           \
  FOR_EACH_COLOR(READ_WITH_SAMPLER, read_only TYPE, INTS, FLOATS, __VA_ARGS__)

FUNCTIONS(image1d_buffer_t, int, 1, 0)
FUNCTIONS_WITH_SAMPLERS(image1d_t, int, float, 1, 0)
FUNCTIONS_WITH_SAMPLERS(image1d_array_t, int2, float2, 1, 1)
FUNCTIONS_WITH_SAMPLERS(image2d_t, int2, float2, 2, 0)
FUNCTIONS_WITH_SAMPLERS(image2d_array_t, int4, float4, 2, 1)
FUNCTIONS_WITH_SAMPLERS(image3d_t, int4, float4, 3, 0)

/* --- Images of depths: of one channel, which is the whole colour. */

#define READ_DEPTH(TYPE, INTS, LAYERED)                                        \
  float _CL_OVERLOADABLE read_imagef(TYPE image, INTS coord) {                 \
    return look_up_f(IMAGE(image), CLK_ADDRESS_NONE, widen(coord), 2, LAYERED) \
        .x;                                                                    \
  }
#define READ_DEPTH_WITH_SAMPLER(TYPE, INTS, FLOATS, LAYERED)                   \
  float _CL_OVERLOADABLE read_imagef(TYPE image, sampler_t sampler,            \
                                     INTS coord) {                             \
    return look_up_f(IMAGE(image), SAMPLER(sampler), widen(coord), 2, LAYERED) \
        .x;                                                                    \
  }                                                                            \
  float _CL_OVERLOADABLE read_imagef(TYPE image, sampler_t sampler,            \
                                     FLOATS coord) {                           \
    return sample_f(IMAGE(image), SAMPLER(sampler), widen(coord), 2, LAYERED)  \
        .x;                                                                    \
  }
#define WRITE_DEPTH(TYPE, INTS, LAYERED)                                       \
  void _CL_OVERLOADABLE write_imagef(TYPE image, INTS coord, float depth) {    \
    write_texel(IMAGE(image), widen(coord),                                    \
                bits_f((float4)(depth), IMAGE(image)), 2, LAYERED);            \
  }
/* PoCL has these of all other types. */
#define QUERY(TYPE, RESULT, NAME, VALUE)                                       \
  RESULT _CL_OVERLOADABLE NAME(TYPE image) {                                   \
    const image_p of = IMAGE(image);                                           \
    return VALUE;                                                              \
  }
#define QUERIES(TYPE)                                                          \
  QUERY(TYPE, int, get_image_width, of->_width)                                \
  QUERY(TYPE, int, get_image_height, of->_height)                              \
  QUERY(TYPE, int2, get_image_dim, (int2)(of->_width, of->_height))            \
  QUERY(TYPE, int, get_image_channel_data_type, of->_data_type)                \
  QUERY(TYPE, int, get_image_channel_order, of->_order)
#define QUERY_LAYERS(TYPE)                                                     \
  QUERY(TYPE, size_t, get_image_array_size, of->_image_array_size)

#define DEPTH_FUNCTIONS(TYPE, INTS, FLOATS, LAYERED)                           \
  READ_DEPTH(read_only TYPE, INTS, LAYERED)                                    \
  READ_DEPTH_WITH_SAMPLER(read_only TYPE, INTS, FLOATS, LAYERED)               \
  WRITE_DEPTH(write_only TYPE, INTS, LAYERED)                                  \
  READ_DEPTH(read_write TYPE, INTS, LAYERED)                                   \
  WRITE_DEPTH(read_write TYPE, INTS, LAYERED)                                  \
  QUERIES(read_only TYPE)                                                      \
  QUERIES(write_only TYPE)                                                     \
  QUERIES(read_write TYPE)

DEPTH_FUNCTIONS(image2d_depth_t, int2, float2, 0)
DEPTH_FUNCTIONS(image2d_array_depth_t, int4, float4, 1)
QUERY_LAYERS(read_only image2d_array_depth_t)
QUERY_LAYERS(write_only image2d_array_depth_t)
QUERY_LAYERS(read_write image2d_array_depth_t)
