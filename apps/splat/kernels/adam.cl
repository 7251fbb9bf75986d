// One step of Adam (D. P. Kingma, J. Ba 2015) for every plane of a parameter
// buffer: plane p of Gaussian i is at p * count + i. `rates` holds each plane's
// learning rate over 1 - beta1^t, and `correction` is 1 / sqrt(1 - beta2^t),
// both made in double on the host. Every Gaussian takes the step, those that
// the view did not see too: their gradient is 0 and their moments fade.

__kernel void adam(__global float *parameters, __global const float *gradients,
                   __global float *first, __global float *second,
                   __constant const float *rates, uint count, float beta1,
                   float rest1, float beta2, float rest2, float correction,
                   float epsilon) {
  const uint gaussian = get_global_id(0);
  if (gaussian >= count)
    return;
  const uint plane = get_global_id(1);
  const uint i = plane * count + gaussian;
  const float g = gradients[i];
  const float m = beta1 * first[i] + rest1 * g;
  const float v = beta2 * second[i] + rest2 * g * g;
  first[i] = m;
  second[i] = v;
  parameters[i] -= rates[plane] * m / (sqrt(v) * correction + epsilon);
}
