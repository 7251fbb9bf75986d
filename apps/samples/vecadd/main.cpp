/// The sum of two vectors, with a grid that is larger than they are.
#include "Sample.h"

static const char *const Source = R"(
kernel void add(global const float *a, global const float *b, global float *c, uint n) {
  uint i = get_global_id(0);
  if (i < n)
    c[i] = a[i] + b[i];
})";

int main() {
  return sample::run("vecadd", Source, [](sample::Device &D) {
    constexpr cl_uint N = 100000, Group = 64;
    std::vector<float> A(N), B(N);
    for (cl_uint I = 0; I < N; ++I) {
      A[I] = static_cast<float>(I) * 0.25F;
      B[I] = static_cast<float>(N - I) * 3.5F;
    }
    const cl::Buffer C = D.allocate<float>(N);
    D.run("add", cl::NDRange((N + Group - 1) / Group * Group),
          cl::NDRange(Group), D.upload(A), D.upload(B), C, N);
    const std::vector<float> Sum = D.download<float>(C, N);
    for (cl_uint I = 0; I < N; ++I)
      if (Sum[I] != A[I] + B[I])
        return false;
    return true;
  });
}
