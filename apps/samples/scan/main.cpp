/// An exclusive prefix sum in three kernels: sums of blocks, their prefix sum
/// by one group, and the blocks again from there (Blelloch 1990).
#include "Sample.h"

static const char *const Source = R"(
// The prefix sum of a group's values, each work-item giving one; Hillis and Steele.
uint scan_group(uint value, local uint *t) {
  uint l = get_local_id(0), n = get_local_size(0);
  t[l] = value;
  for (uint step = 1; step < n; step *= 2) {
    barrier(CLK_LOCAL_MEM_FENCE);
    uint before = l >= step ? t[l - step] : 0;
    barrier(CLK_LOCAL_MEM_FENCE);
    t[l] += before;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  return t[l];
}

kernel void block_sums(global const uint *in, global uint *sums, uint n, local uint *t) {
  uint i = get_global_id(0);
  uint sum = scan_group(i < n ? in[i] : 0, t);
  if (get_local_id(0) == get_local_size(0) - 1)
    sums[get_group_id(0)] = sum;
}

// One group: sums[i] becomes what lies before block i.
kernel void scan_sums(global uint *sums, uint n, local uint *t) {
  uint l = get_local_id(0), size = get_local_size(0), before = 0;
  for (uint start = 0; start < n; start += size) {
    uint value = start + l < n ? sums[start + l] : 0;
    uint sum = scan_group(value, t);
    if (start + l < n)
      sums[start + l] = before + sum - value;
    before += t[size - 1];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}

kernel void scan_blocks(global const uint *in, global const uint *sums, global uint *out, uint n, local uint *t) {
  uint i = get_global_id(0);
  uint value = i < n ? in[i] : 0;
  uint sum = scan_group(value, t);
  if (i < n)
    out[i] = sums[get_group_id(0)] + sum - value;
})";

int main() {
  return sample::run("scan", Source, [](sample::Device &D) {
    constexpr cl_uint N = 100003, Group = 256;
    constexpr cl_uint Blocks = (N + Group - 1) / Group;
    std::vector<cl_uint> In(N);
    for (cl_uint I = 0; I < N; ++I)
      In[I] = I * 2654435761U >> 20;
    const cl::Buffer DeviceIn = D.upload(In),
                     Sums = D.allocate<cl_uint>(Blocks),
                     Out = D.allocate<cl_uint>(N);
    const cl::NDRange All(Blocks * Group), One(Group);
    const auto Scratch = cl::Local(Group * sizeof(cl_uint));
    D.run("block_sums", All, One, DeviceIn, Sums, N, Scratch);
    D.run("scan_sums", One, One, Sums, Blocks, Scratch);
    D.run("scan_blocks", All, One, DeviceIn, Sums, Out, N, Scratch);
    const std::vector<cl_uint> Scanned = D.download<cl_uint>(Out, N);
    for (cl_uint I = 0, Before = 0; I < N; Before += In[I++])
      if (Scanned[I] != Before)
        return false;
    return true;
  });
}
