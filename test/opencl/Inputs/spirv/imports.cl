// Calls what another program of the link has.
int twice(int x);

kernel void imports(global int *out) { out[0] = twice(out[1]); }
