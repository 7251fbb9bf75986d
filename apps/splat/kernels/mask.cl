// A loss in which some pixels do not count: there picture and photograph are 0,
// and nothing goes back. The fourth byte of a photograph's pixel is 1 if the
// pixel counts, else 0.

__kernel void mask_picture(__global const float4 *picture,
                           __global const uchar4 *photo,
                           __global float4 *masked, uint pixels) {
  const uint i = get_global_id(0);
  if (i < pixels)
    masked[i] = photo[i].w ? picture[i] : (float4)(0.0f);
}

__kernel void mask_gradient(__global const uchar4 *photo,
                            __global float *gradient, uint pixels) {
  const uint i = get_global_id(0);
  if (i >= pixels || photo[i].w)
    return;
  for (uint c = 0; c < 3; ++c)
    gradient[3 * i + c] = 0.0f;
}
