// What Bench.cpp runs: the rasterizer, and its arithmetic alone.
module top (
    input  logic         clk, reset, start,
    input  logic [15:0]  origin_x, origin_y,
    input  logic [6:0]   width, height,
    input  logic [31:0]  cutoff, list_at, records, count, target, pitch,
    output logic         done, request, writes,
    output logic [31:0]  address,
    output logic [511:0] data,
    output logic [3:0]   pixels,
    input  logic         answer,
    input  logic [511:0] line,
    output logic [2:0]   state,
    output logic         blends, waits, misses,
    input  logic [31:0]  a, b,
    output logic [31:0]  product, sum, half,
    output logic         less, less_equal
);
  rasterizer rasterizer (.*);
  fp32_mul mul (.a, .b, .y(product));
  fp32_add add (.a, .b, .y(sum));
  minus_half minus (.x(a), .y(half));
  fp32_compare compare (.a, .b, .less, .less_equal);
endmodule
