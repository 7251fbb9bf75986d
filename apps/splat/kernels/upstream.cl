// What blending's way back starts from: a pixel's gradient by the colour in
// front of the background, and by the final transmittance, through which the
// background shows and which alpha is 1 minus.

__kernel void upstream(__global const float *by_render,
                       __global const float *by_alpha,
                       __global float4 *gradients, uint count, float red,
                       float green, float blue) {
  const uint i = get_global_id(0);
  if (i >= count)
    return;
  const float r = by_render[3 * i];
  const float g = by_render[3 * i + 1];
  const float b = by_render[3 * i + 2];
  gradients[i] =
      (float4)(r, g, b, (red * r + green * g + blue * b) - by_alpha[i]);
}
