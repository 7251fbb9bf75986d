// Built with -cl-std=CL3.0.
global int count = 40;
global int *global counts[2] = {&count, &count};

kernel void add(global int *out) { *out = atomic_add(counts[1], 2) + 1; }
kernel void plain(global int *out) { *out = 7; }
