// Compiled without doubles, so that floats are printed as floats.
kernel void prints(float x) { printf("%.1f %a %.2v2hlf %d\n", x, x, (float2)(x, 2 * x), 7); }
