/* Sine, cosine and tangent of arguments beyond the range of SLEEF's. */
#pragma once

/* x is finite and abs(x) >= LARGE_ANGLE. Results are within 0.51 ulp. */
#define LARGE_ANGLE 32768.0f
float large_sinf(float x);
float large_cosf(float x);
float large_tanf(float x);
