// Colour from spherical harmonics. Bands are effects (effects/ShBands.cpp): what
// is not done is neither in the buffer nor, without flags, in the program. Signs
// are those of the convention that 3DGS scenes store.

// The normalisations (sh_basis.h), kept where activate.cl says.
typedef struct {
  float c0, c1, c2xy, c2zz, c2xx, c3y, c3xyz, c3xzz, c3zzz, c3zxx;
} sh_constants;

// Of the bands that are done.
static void make_sh_constants(CONSTANTS sh_constants *n, uint effects) {
  n->c0 = SH_C0;
  if (USE_SH1)
    n->c1 = SH_C1;
  if (USE_SH2) {
    n->c2xy = SH_C2XY;
    n->c2zz = SH_C2ZZ;
    n->c2xx = SH_C2XX;
  }
  if (USE_SH3) {
    n->c3y = SH_C3Y;
    n->c3xyz = SH_C3XYZ;
    n->c3xzz = SH_C3XZZ;
    n->c3zzz = SH_C3ZZZ;
    n->c3zxx = SH_C3ZXX;
  }
}

// Adds basis * coefficient k of every channel.
#define ADD_SH(k, basis)                                                       \
  do {                                                                         \
    const float b = (basis);                                                   \
    color.x += b * SH(k, 0);                                                   \
    color.y += b * SH(k, 1);                                                   \
    color.z += b * SH(k, 2);                                                   \
  } while (0)

// Colour of Gaussian i seen along `direction`, from the camera to its mean, of
// any length; of zero length leaves the constant band alone.
static float3 sh_color(CONSTANTS const sh_constants *n,
                       __global const float *sh, uint count, uint i,
                       float3 direction, uint effects) {
  float3 color = n->c0 * (float3)(SH(0, 0), SH(0, 1), SH(0, 2));
  if (USE_VIEW_COLOR) {
    const float length_squared = squared_length(direction);
    if (length_squared > 0.0f) {
      const float length = sqrt(length_squared);
      const float x = direction.x / length;
      const float y = direction.y / length;
      const float z = direction.z / length;
      const float xx = x * x, yy = y * y, zz = z * z;
      uint k = 1; // where the next band's coefficients begin
      if (USE_SH1) {
        ADD_SH(k, -n->c1 * y);
        ADD_SH(k + 1, n->c1 * z);
        ADD_SH(k + 2, -n->c1 * x);
        k += 3;
      }
      if (USE_SH2) {
        ADD_SH(k, n->c2xy * x * y);
        ADD_SH(k + 1, -n->c2xy * y * z);
        ADD_SH(k + 2, n->c2zz * (2.0f * zz - xx - yy));
        ADD_SH(k + 3, -n->c2xy * x * z);
        ADD_SH(k + 4, n->c2xx * (xx - yy));
        k += 5;
      }
      if (USE_SH3) {
        ADD_SH(k, -n->c3y * y * (3.0f * xx - yy));
        ADD_SH(k + 1, n->c3xyz * x * y * z);
        ADD_SH(k + 2, -n->c3xzz * y * (4.0f * zz - xx - yy));
        ADD_SH(k + 3, n->c3zzz * z * (2.0f * zz - 3.0f * xx - 3.0f * yy));
        ADD_SH(k + 4, -n->c3xzz * x * (4.0f * zz - xx - yy));
        ADD_SH(k + 5, n->c3zxx * z * (xx - yy));
        ADD_SH(k + 6, -n->c3y * x * (xx - 3.0f * yy));
      }
    }
  }
  return fmax(color + 0.5f, 0.0f);
}
