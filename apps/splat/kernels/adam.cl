// One step of Adam (D. P. Kingma, J. Ba 2015) for every plane of a parameter
// buffer: plane p of Gaussian i is at p * count + i. `rates` holds each plane's
// learning rate over 1 - beta1^t, and `correction` is 1 / sqrt(1 - beta2^t),
// both made in double on the host. Every Gaussian takes the step, those that
// the view did not see too: their gradient is 0 and their moments fade.
// MOMENTS_BY_PLANE: `first` and `second` have one plane, `own_plane`.

// The moments' planes are on the host: there is one here, `own_plane`.
#pragma vorion choice flag MOMENTS_BY_PLANE

__kernel void adam(__global float *parameters, __global const float *gradients,
                   __global float *first, __global float *second,
                   __constant const float *rates, uint count, float beta1,
                   float rest1, float beta2, float rest2, float correction,
                   float epsilon
#ifdef MOMENTS_BY_PLANE
                   , uint own_plane
#endif
) {
  const uint gaussian = get_global_id(0);
  if (gaussian >= count)
    return;
#ifdef MOMENTS_BY_PLANE
  const uint plane = own_plane, at = gaussian;
  const uint i = plane * count + gaussian;
#else
  const uint plane = get_global_id(1);
  const uint i = plane * count + gaussian, at = i;
#endif
  const float g = gradients[i];
  const float m = beta1 * first[at] + rest1 * g;
  const float v = beta2 * second[at] + rest2 * g * g;
  first[at] = m;
  second[at] = v;
  parameters[i] -= rates[plane] * m / (sqrt(v) * correction + epsilon);
}
