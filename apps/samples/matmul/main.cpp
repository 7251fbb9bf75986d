/// A matrix product by 16x16 tiles in local memory. The host adds in the same
/// order, so that the results are equal to the last bit.
#include "Sample.h"

static const char *const Source = R"(
#define TILE 16
kernel __attribute__((reqd_work_group_size(TILE, TILE, 1)))
void multiply(global const float *a, global const float *b, global float *c, uint n) {
  local float ta[TILE][TILE], tb[TILE][TILE];
  uint x = get_local_id(0), y = get_local_id(1);
  uint column = get_global_id(0), row = get_global_id(1);
  float sum = 0;
  for (uint k = 0; k < n; k += TILE) {
    ta[y][x] = a[row * n + k + x];
    tb[y][x] = b[(k + y) * n + column];
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint i = 0; i < TILE; i++)
      sum += ta[y][i] * tb[i][x];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  c[row * n + column] = sum;
})";

int main() {
  return sample::run("matmul", Source, [](sample::Device &D) {
    constexpr cl_uint N = 128, Tile = 16;
    std::vector<float> A(N * N), B(N * N);
    for (cl_uint I = 0; I < N * N; ++I) {
      A[I] = static_cast<float>(I % 37) * 0.125F - 2;
      B[I] = static_cast<float>(I % 53) * 0.0625F - 1;
    }
    const cl::Buffer C = D.allocate<float>(N * N);
    D.run("multiply", cl::NDRange(N, N), cl::NDRange(Tile, Tile), D.upload(A),
          D.upload(B), C, N);
    const std::vector<float> Product = D.download<float>(C, N * N);
    for (cl_uint Row = 0; Row < N; ++Row)
      for (cl_uint Column = 0; Column < N; ++Column) {
        float Sum = 0;
        for (cl_uint K = 0; K < N; ++K)
          Sum += A[Row * N + K] * B[K * N + Column];
        if (Product[Row * N + Column] != Sum)
          return false;
      }
    return true;
  });
}
