// Colour from spherical harmonics. Bands are effects (effects/ShBands.cpp): what
// is not done is neither in the buffer nor, without flags, in the program.
// Constants are the real spherical harmonics' normalisations, in the sign
// convention that 3DGS scenes store.

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
static float3 sh_color(__global const float *sh, uint count, uint i,
                       float3 direction, uint effects) {
  float3 color = 0.28209479177387814f * (float3)(SH(0, 0), SH(0, 1), SH(0, 2));
  if (USE_VIEW_COLOR) {
    const float length_squared = direction.x * direction.x +
                                 direction.y * direction.y +
                                 direction.z * direction.z;
    if (length_squared > 0.0f) {
      const float length = sqrt(length_squared);
      const float x = direction.x / length;
      const float y = direction.y / length;
      const float z = direction.z / length;
      const float xx = x * x, yy = y * y, zz = z * z;
      uint k = 1; // where the next band's coefficients begin
      if (USE_SH1) {
        ADD_SH(k, -0.4886025119029199f * y);
        ADD_SH(k + 1, 0.4886025119029199f * z);
        ADD_SH(k + 2, -0.4886025119029199f * x);
        k += 3;
      }
      if (USE_SH2) {
        ADD_SH(k, 1.0925484305920792f * x * y);
        ADD_SH(k + 1, -1.0925484305920792f * y * z);
        ADD_SH(k + 2, 0.31539156525252005f * (2.0f * zz - xx - yy));
        ADD_SH(k + 3, -1.0925484305920792f * x * z);
        ADD_SH(k + 4, 0.5462742152960396f * (xx - yy));
        k += 5;
      }
      if (USE_SH3) {
        ADD_SH(k, -0.5900435899266435f * y * (3.0f * xx - yy));
        ADD_SH(k + 1, 2.890611442640554f * x * y * z);
        ADD_SH(k + 2, -0.4570457994644658f * y * (4.0f * zz - xx - yy));
        ADD_SH(k + 3,
               0.3731763325901154f * z * (2.0f * zz - 3.0f * xx - 3.0f * yy));
        ADD_SH(k + 4, -0.4570457994644658f * x * (4.0f * zz - xx - yy));
        ADD_SH(k + 5, 1.445305721320277f * z * (xx - yy));
        ADD_SH(k + 6, -0.5900435899266435f * x * (xx - 3.0f * yy));
      }
    }
  }
  return fmax(color + 0.5f, 0.0f);
}
