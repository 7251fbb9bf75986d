// Colour from spherical harmonics. Only the bands up to SH_DEGREE exist in the
// program: a scene without them pays nothing. Constants are the real spherical
// harmonics' normalisations, in the sign convention that 3DGS scenes store.

// Coefficient k of channel c of Gaussian i is in plane 3 k + c.
#define SH(k, c) sh[(3 * (k) + (c)) * count + i]

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
                       float3 direction) {
  float3 color = 0.28209479177387814f * (float3)(SH(0, 0), SH(0, 1), SH(0, 2));
#if SH_DEGREE > 0
  const float length_squared = direction.x * direction.x +
                               direction.y * direction.y +
                               direction.z * direction.z;
  if (length_squared > 0.0f) {
    const float length = sqrt(length_squared);
    const float x = direction.x / length;
    const float y = direction.y / length;
    const float z = direction.z / length;
    ADD_SH(1, -0.4886025119029199f * y);
    ADD_SH(2, 0.4886025119029199f * z);
    ADD_SH(3, -0.4886025119029199f * x);
#if SH_DEGREE > 1
    const float xx = x * x, yy = y * y, zz = z * z;
    ADD_SH(4, 1.0925484305920792f * x * y);
    ADD_SH(5, -1.0925484305920792f * y * z);
    ADD_SH(6, 0.31539156525252005f * (2.0f * zz - xx - yy));
    ADD_SH(7, -1.0925484305920792f * x * z);
    ADD_SH(8, 0.5462742152960396f * (xx - yy));
#if SH_DEGREE > 2
    ADD_SH(9, -0.5900435899266435f * y * (3.0f * xx - yy));
    ADD_SH(10, 2.890611442640554f * x * y * z);
    ADD_SH(11, -0.4570457994644658f * y * (4.0f * zz - xx - yy));
    ADD_SH(12, 0.3731763325901154f * z * (2.0f * zz - 3.0f * xx - 3.0f * yy));
    ADD_SH(13, -0.4570457994644658f * x * (4.0f * zz - xx - yy));
    ADD_SH(14, 1.445305721320277f * z * (xx - yy));
    ADD_SH(15, -0.5900435899266435f * x * (xx - 3.0f * yy));
#endif
#endif
  }
#endif
  return fmax(color + 0.5f, 0.0f);
}
