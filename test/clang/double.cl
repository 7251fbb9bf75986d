// OpenCL C has doubles, which are software: a constant without f is one, and its
// arithmetic is calls of libdevice.
// REQUIRES: vorion-clang
// RUN: vorion-clang -O2 -S %s -o - | FileCheck %s
#ifndef cl_khr_fp64
#error cl_khr_fp64
#endif

// CHECK-LABEL: halve:
// CHECK: __extendsfdf2
// CHECK: __muldf3
// CHECK: __truncdfsf2
kernel void halve(global float *p) {
  const double x = p[0];
  p[0] = x * 0.3;
}

// CHECK-LABEL: fuse:
// CHECK: {{(call|tail).*[^_]}}fma
// CHECK: {{(call|tail).*[^_]}}sqrt
kernel void fuse(global double *p) {
  p[0] = __builtin_sqrt(__builtin_fma(p[0], p[1], p[2]));
}
