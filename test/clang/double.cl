// OpenCL C has no double here: its type is an error that names the line, and a
// constant without f is single, with a warning, so that printf's values are.
// REQUIRES: vorion-clang
// RUN: not vorion-clang -fsyntax-only %s 2>&1 | FileCheck %s --check-prefix=CLANG
// RUN: vorion-clang -fsyntax-only -DFLOAT %s 2>&1 | FileCheck %s --check-prefix=FLOAT
// RUN: vorion-clang -O2 -S -emit-llvm -w -DFLOAT %s -o - | FileCheck %s --check-prefix=IR --implicit-check-not="fmul double"
// IR: fmul float {{.*}}, 5.000000e-01

#ifdef FLOAT
typedef float number;
#else
// CLANG: double.cl:[[@LINE+1]]:9: error: use of type 'double' requires cl_khr_fp64
typedef double number;
#endif

kernel void halve(global float *p) {
  number x = p[0];
  // FLOAT: double.cl:[[@LINE+1]]:14: warning: double precision constant requires cl_khr_fp64, casting to single precision
  p[0] = x * 0.5;
}
