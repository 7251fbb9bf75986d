/* In C, because OpenCL C has no local variables outside kernels. */
extern unsigned long long vorion_scratch[];

void *vorion_group_scratch(void) { return vorion_scratch; }
