/// A stable radix sort of keys with values, four bits a pass: digits are
/// counted by block, the counts become places, and every work-item moves its
/// own run.
#include "Sample.h"

#include <algorithm>
#include <numeric>

static const char *const Source = R"(
#define DIGITS 16

// Each work-item has `run` keys that follow each other; counts lie digit by digit.
kernel void count(global const uint *keys, global uint *counts, uint n, uint run, uint shift) {
  uint item = get_global_id(0), items = get_global_size(0);
  uint mine[DIGITS];
  for (uint d = 0; d < DIGITS; d++)
    mine[d] = 0;
  for (uint i = item * run; i < min(n, item * run + run); i++)
    mine[keys[i] >> shift & (DIGITS - 1)]++;
  for (uint d = 0; d < DIGITS; d++)
    counts[d * items + item] = mine[d];
}

// One group turns counts into the places where each run of a digit begins.
kernel void places(global uint *counts, uint n, local uint *sums) {
  uint l = get_local_id(0), size = get_local_size(0), each = (n + size - 1) / size;
  uint first = min(n, l * each), last = min(n, first + each), sum = 0;
  for (uint i = first; i < last; i++)
    sum += counts[i];
  sums[l] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint before = 0;
  for (uint i = 0; i < l; i++)
    before += sums[i];
  for (uint i = first; i < last; i++) {
    uint here = counts[i];
    counts[i] = before;
    before += here;
  }
}

kernel void move(global const uint *keys, global const uint *values, global uint *keys_out,
                 global uint *values_out, global uint *counts, uint n, uint run, uint shift) {
  uint item = get_global_id(0), items = get_global_size(0);
  for (uint i = item * run; i < min(n, item * run + run); i++) {
    uint digit = keys[i] >> shift & (DIGITS - 1);
    uint to = counts[digit * items + item]++;
    keys_out[to] = keys[i];
    values_out[to] = values[i];
  }
})";

int main() {
  return sample::run("radixsort", Source, [](sample::Device &D) {
    constexpr cl_uint N = 50000, Items = 512, Group = 64, Digits = 16, Bits = 4;
    constexpr cl_uint Run = (N + Items - 1) / Items;
    std::vector<cl_uint> Keys(N), Values(N);
    for (cl_uint I = 0; I < N; ++I)
      Keys[I] = I * 2654435761U ^ I << 7;
    for (cl_uint I = 0; I < N; I += 5)
      Keys[I] = Keys[I / 2]; // equal keys keep their order
    std::iota(Values.begin(), Values.end(), 0U);

    cl::Buffer FromKeys = D.upload(Keys), FromValues = D.upload(Values);
    cl::Buffer ToKeys = D.allocate<cl_uint>(N),
               ToValues = D.allocate<cl_uint>(N);
    const cl::Buffer Counts = D.allocate<cl_uint>(Digits * Items);
    const cl::NDRange All(Items), One(Group);
    for (cl_uint Shift = 0; Shift < 32; Shift += Bits) {
      D.run("count", All, One, FromKeys, Counts, N, Run, Shift);
      D.run("places", One, One, Counts, Digits * Items,
            cl::Local(Group * sizeof(cl_uint)));
      D.run("move", All, One, FromKeys, FromValues, ToKeys, ToValues, Counts, N,
            Run, Shift);
      std::swap(FromKeys, ToKeys);
      std::swap(FromValues, ToValues);
    }

    std::vector<cl_uint> Order = Values;
    std::sort(Order.begin(), Order.end(), [&Keys](cl_uint A, cl_uint B) {
      return Keys[A] != Keys[B] ? Keys[A] < Keys[B] : A < B;
    });
    const std::vector<cl_uint> SortedKeys = D.download<cl_uint>(FromKeys, N);
    const std::vector<cl_uint> SortedValues =
        D.download<cl_uint>(FromValues, N);
    for (cl_uint I = 0; I < N; ++I)
      if (SortedValues[I] != Order[I] || SortedKeys[I] != Keys[Order[I]])
        return false;
    return true;
  });
}
