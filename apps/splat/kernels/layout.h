/// Structures that the host program and its kernels share. Compiled as C++ and
/// as OpenCL C, so only 4-byte members and nothing of either language.
#pragma once

// NOLINTBEGIN(readability-identifier-naming): OpenCL names, as in docs/abi.md.

/// One projected Gaussian. The same bytes as `vx_gaussian` (docs/abi.md), which
/// exists only where the device is a Vorion; rasterize.cl checks that.
typedef struct {
  float mean[2];  ///< centre, px; pixel (i, j) is sampled at (i + 0.5, j + 0.5)
  float conic[3]; ///< inverse covariance xx, xy, yy, 1/px^2
  float opacity;  ///< 0 to 1
  float color[3]; ///< red, green, blue
  float extent[2]; ///< half width and height of the box it may reach, px
  uint tag;        ///< number, and SPANS_TILES where it does
} splat_gaussian;

/// One Gaussian as rays meet it. The same bytes as `vx_ray_gaussian`
/// (docs/primitives.md, "Rays").
typedef struct {
  uint first,
      last;      ///< pixels of the box, both ends included: column | row << 16
  float mean[2]; ///< centre, px from the centre of pixel `first`
  float factor[3]; ///< a, b, c of (a dx + b dy)^2 + (c dy)^2
  float slope[2];  ///< of the plane that is 1 at the mean, 1/px
  float near;      ///< 1 over the square of the distance of the rays' origin
  float opacity;   ///< 0 to 1
  float color[3];  ///< red, green, blue
  uint tag;        ///< number, and SPANS_TILES where it does
  uint unused;
} splat_ray_gaussian;

/// A camera, ready for projection.
typedef struct {
  float rotation[9];     ///< world to camera, row-major
  float position[3];     ///< camera centre, world, as high + low:
  float position_low[3]; ///< p_camera = rotation (p_world - centre)
  float depth_axis[3];   ///< depth = axis . p + offset, each as high + low
  float depth_axis_low[3];
  float depth_offset[2];
  float focal[2];     ///< px
  float center[2];    ///< principal point, px
  float ratio_low[2]; ///< x/z and y/z are clamped to these in the Jacobian
  float ratio_high[2];
  uint size[2];  ///< picture, px
  uint tiles[2]; ///< picture, tiles
  uint effects;  ///< a bit an effect (effects/EffectPlan.h)
} splat_view;

/// What a camera that is no pinhole has beside that; it lies behind the view.
typedef struct {
  float k[13]; ///< in the order of the model's record (lens/)
  /// What is not below it is not seen: a distortion's r^2, a fisheye's angle;
  /// or the least cosine of a latitude at which the Jacobian is taken.
  float limit;
  /// Of the unscented transform: the square of how far a point's place may be
  /// from the mean's, in units of the focal lengths.
  float most_spread;
} splat_lens;

/// What lies behind the lens of a camera that moves while it exposes.
typedef struct {
  float moment[3]; ///< of a pixel (x, y), from the pose's: 1, x, y
  float motion[3]; ///< in a whole exposure, along the pose's axes
  float axis[3];   ///< of its turn, by the pose's axes
  float angle;     ///< of that
} splat_shutter;

/// What places are measured from where fp32 has too few digits for them: the
/// ray through the picture's middle, or through a window's, or the axis if the
/// lens shows nothing there. The picture's lies behind the view, and behind the
/// lens where there is one.
typedef struct {
  float across[2][3];     ///< how far beside that ray, by world axis,
  float across_low[2][3]; ///< as high + low
  float start[2];         ///< of parallel rays: how far that ray passes beside
  float start_low[2];     ///< the axis, as high + low; else 0
  float place[2];         ///< of that ray, px from the picture or the window
  float ray[5];           ///< what the model has to know of it (crop_mean)
} splat_crop;

/// The windows of a wide picture, each of which has its own records (window.h).
typedef struct {
  uint bits;    ///< a window's side is so much a power of 2, px
  uint columns; ///< windows of a row
  uint stride;  ///< records of a window
} splat_windows;

/// A Gaussian as rays meet it. Vectors are in the Gaussian's own axes and in
/// its standard deviations, all of them times its smallest scale.
typedef struct {
  float across[3], down[3], ahead[3]; ///< the camera's unit vectors x, y, z
  float mean[3];                      ///< from the camera
} splat_ray_frame;

/// A Gaussian as traced rays meet it (trace.cl), in the world's axes. Vectors
/// of three have a component for each of its own axes where they are its
/// deviations.
typedef struct {
  float mean[3], mean_low[3]; ///< from the camera, as high + low
  float axes[9];              ///< unit vectors, one after the other
  float scale[3];             ///< deviations over the largest
  float sharpness;            ///< 1 over the square of the largest
  float opacity;              ///< 0 to 1
} splat_traced;

/// Where the rays of pixels come from: start + x across + y down for pixel
/// (x, y) is a pinhole's direction, with z 1 along the camera's axis, or the
/// origin of a parallel ray; the other of the two is the same for all. In the
/// world's axes from the camera, each as high + low.
typedef struct {
  float start[2][3], across[2][3], down[2][3], same[2][3];
} splat_ray_source;

/// Planes of rays, plane p of ray i at p * rays + i. A ray meets Gaussians
/// between its nearest and its farthest multiple of the direction.
enum {
  RAY_ORIGIN = 0, ///< from the camera, in the world's axes
  RAY_ORIGIN_LOW = 3,
  RAY_DIRECTION = 6, ///< of any length
  RAY_DIRECTION_LOW = 9,
  RAY_NEAREST = 12,
  RAY_FARTHEST = 13,
  RAY_PLANES = 14
};

/// A box of the tree over Gaussians (bvh.cl), low corner and high corner.
enum { BOX_LOW = 0, BOX_HIGH = 3, BOX_WORDS = 6 };

/// That tree: node 1 is the root, the children of node n are 4 n to 4 n + 3.
/// Leaf i in the order of Morton codes is node leaves + i. Of the numbers below
/// leaves nobody has those from gap on, so boxes of leaves lie `gap` earlier.
typedef struct {
  uint leaves; ///< a power of 4, at least 4
  uint count;  ///< of Gaussians
  uint gap;    ///< leaves / 2
} splat_tree;

/// What a ray took.
typedef struct {
  uint nodes;     ///< boxes that were tested
  uint evaluated; ///< Gaussians whose box it meets
  uint blended;   ///< Gaussians
  uint passes;    ///< through the tree: one, and restarts
} splat_ray_work;

/// How the rasterizers blend a picture.
typedef struct {
  uint size[2];  ///< picture, px
  uint tiles_x;  ///< tiles of a row
  uint tiles;    ///< all of them
  uint parts;    ///< depth parts of each tile's list, blended apart
  float cutoff;  ///< transmittance at which a pixel is full
  uint datapath; ///< vr_options of docs/isa.md
  // When a part's list goes on in the pixel unit: so many entries are left,
  // this share of them (over, under), or vr_tail_share of its pixels are full.
  uint tail_count;
  uint tail_last[2];
  uint tail_share;
  uint effects; ///< a bit an effect (effects/EffectPlan.h)
} splat_blend_options;

/// When density control clones, splits and drops a Gaussian; infinities switch
/// a reason off.
typedef struct {
  float gradient;        ///< grows above it: mean over views, half pictures
  float split_log_scale; ///< splits rather than clones above it
  float split_shrink;    ///< of a split's halves, off the log scales
  float least_logit;     ///< dropped below it
  float most_log_scale;  ///< dropped above it
  float most_radius;     ///< dropped above it, px
} splat_density;

/// A scene's parameters lie in planes, plane p of Gaussian i at p * count + i,
/// where they are trained; or, where they are only drawn, in blocks of
/// LINE_WORDS Gaussians: a block has a cache line for each plane, word
/// p * LINE_WORDS + i % LINE_WORDS of block i / LINE_WORDS. Then a warp's lines
/// lie together, at distances that the compiler knows.
enum { LINE_WORDS = 16 };

/// Planes of the geometry buffer.
enum {
  PLANE_MEAN = 0,
  PLANE_LOG_SCALE = 3,
  PLANE_QUATERNION = 6, ///< w, x, y, z of any length
  PLANE_LOGIT = 10,
  GEOMETRY_PLANES = 11
};

/// Planes of the bounds of blocks: plane p of block b at p * blocks + b.
enum {
  BOUND_CENTER = 0, ///< of a sphere that holds the means
  BOUND_RADIUS = 3,
  BOUND_DEVIATION = 4, ///< the largest standard deviation of any Gaussian
  BOUND_PLANES = 5
};

/// Bit of a record's tag and of a list entry: the Gaussian spans several tiles.
/// VR_INTERSECT of docs/isa.md, which rasterize.cl checks.
#define SPANS_TILES 0x80000000U // NOLINT: enumerators of C are signed

/// What is beyond the border of a texture, in the order of mesh/Texture.h.
enum { WRAP_REPEAT, WRAP_MIRROR, WRAP_CLAMP };

/// Bits of splat_material.filters: linear rather than nearest where texels are
/// larger than pixels, and where they are smaller; smaller levels are taken, of
/// which the nearest two are blended.
enum {
  FILTER_LARGER = 1,
  FILTER_SMALLER = 2,
  FILTER_LEVELS = 4,
  FILTER_BETWEEN = 8
};

enum { TEXTURE_LEVELS = 16 };

/// Modes of materials, in the order of mesh/Mesh.h.
enum { MATERIAL_OPAQUE, MATERIAL_MASK, MATERIAL_BLEND };

/// Transparent surfaces of a pixel.
enum { MOST_LAYERS = 8 };

/// How the triangles of a material look (mesh/Mesh.h).
typedef struct {
  uint levels;  ///< of its texture; 0: it has none
  uint size[2]; ///< of the first level, texels
  uint wrap[2]; ///< WRAP_*, across and down
  uint filters; ///< FILTER_*
  uint mode;    ///< MATERIAL_*
  float cutoff; ///< of MATERIAL_MASK, the least alpha that is drawn
  uint first[TEXTURE_LEVELS]; ///< texel of each level
} splat_material;

/// The bits of splat_blend_options.datapath: fields of vr_options, which
/// rasterize.cl checks.
enum {
  DATAPATH_EXP = 0,            ///< first bit of the exponential unit
  DATAPATH_STOP_AT_EQUAL = 16, ///< stop rule
  DATAPATH_SKIP_SATURATED = 32,
  DATAPATH_BLEND = 6,        ///< first bit of the blend arithmetic
  DATAPATH_ALPHA_CUTOFF = 8, ///< first bit of log2(255 times the cut-off)
  DATAPATH_DEGREE4 = 1024,   ///< of rays
  DATAPATH_LOW_PASS = 2048   ///< of surfels
};

/// Bytes of a vx_tail, and of a vx_tail_range behind it where pixels have
/// ranges (docs/isa.md), which rasterize.cl checks.
enum { TAIL_BYTES = 560, TAIL_RANGE_BYTES = 16 };

/// Why no tile sees a Gaussian, in the order in which it is found out.
enum {
  CULL_NEAR,       ///< behind the camera or before the near plane
  CULL_DEGENERATE, ///< no area on the picture: determinant not above 0
  CULL_FAINT,      ///< no pixel can reach an alpha of 1/255
  CULL_OUTSIDE,    ///< its box and the picture have nothing in common
  CULL_NON_FINITE, ///< a number of it is none, or beyond fp32
  CULL_REASONS
};

/// Depth key of a Gaussian that no tile sees, plus the reason; sorts behind
/// every depth.
#define CULLED 0x80000000U // NOLINT: enumerators of C are signed

/// What a work-item of the projection found.
typedef struct {
  uint gaussians;               ///< that a tile sees
  uint culled[CULL_REASONS];    ///< that none does
  uint pairs;                   ///< tiles of the first, saturating
  uint least_key, greatest_key; ///< of the first; ~0 and 0 for none
} splat_seen;

/// What a work-item of trace_shapes.cl found.
typedef struct {
  uint gaussians;            ///< that rays may meet
  uint culled[CULL_REASONS]; ///< that none does
  float distance;            ///< of the first from the camera, the sum
} splat_shapes_seen;

/// Local memory that a group of project.cl is given, and with what lies behind
/// the view.
enum {
  PROJECT_LOCAL_BYTES = 2048,
  LENS_LOCAL_BYTES = 2304,
  RAYS_LOCAL_BYTES = 2560 ///< where records are of rays
};

/// What blending gives back of a Gaussian (docs/abi.md, "Backward"): the words
/// of vr_grad_r to vr_grad_syy.
enum {
  SUM_COLOR = 0,
  SUM_S = 3,
  SUM_SX = 4,  ///< and SUM_SX + 1: y
  SUM_SXX = 6, ///< then xy, yy
  SUM_WORDS = 9,
  /// Of rays the same places have the moments of U and V; then Uq, Vq, qq.
  SUM_UQ = 9,
  SUM_QQ = 11,
  RAY_SUM_WORDS = 12,
  SUM_LOW_PASS = 12, ///< of surfels, on the picture: x, y
  SURFEL_SUM_WORDS = 14
};

/// Planes of the gradients' buffer, as GEOMETRY_PLANES.
enum {
  GRADIENT_MEAN = 0,
  GRADIENT_SCALE = 3,      ///< of the activated or the stored scale
  GRADIENT_QUATERNION = 6, ///< of the stored one
  GRADIENT_OPACITY = 10,   ///< of the activated or the stored opacity
  GRADIENT_MEAN_2D = 11,   ///< px
  GRADIENT_CONIC = 13,     ///< xx, xy (once), yy
  GRADIENT_PLANES = 16
};

// NOLINTEND(readability-identifier-naming)
