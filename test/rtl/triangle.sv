// What a lane and a tile have of triangles alone (docs/primitives.md).

// Whether a pixel of the tile is covered: three edges, in integers.
module edges #(
    parameter STEP = 32, // bits of a step
    parameter SUM = 40   // bits of a value
) (
    input  logic [5:0] x, y,
    // Of each edge, its steps and the value at the tile's first pixel.
    input  logic [3*STEP-1:0] a, b,
    input  logic [3*SUM-1:0]  corner,
    output logic       covered
);
  logic signed [6:0] column, row;
  assign column = signed'({1'b0, x});
  assign row = signed'({1'b0, y});
  logic [2:0] negative;
  for (genvar k = 0; k < 3; k = k + 1) begin : one
    logic signed [STEP-1:0] step_x, step_y;
    logic signed [SUM-1:0] sum;
    assign step_x = signed'(a[STEP * k +: STEP]);
    assign step_y = signed'(b[STEP * k +: STEP]);
    assign sum = signed'(corner[SUM * k +: SUM]) + SUM'(step_x) * SUM'(column) + SUM'(step_y) * SUM'(row);
    assign negative[k] = sum[SUM-1];
  end
  assign covered = negative == 0;
endmodule

module depth_test (
    input  logic [31:0] depth, stored,
    input  logic [2:0]  compare, // less, equal, greater
    output logic        passes
);
  logic less, less_equal, more, unused;
  fp32_compare nearer (.a(depth), .b(stored), .less(less), .less_equal(less_equal));
  fp32_compare farther (.a(stored), .b(depth), .less(more), .less_equal(unused));
  always_comb begin
    if (less) passes = compare[0];
    else if (less_equal) passes = compare[1];
    else if (more) passes = compare[2];
    else passes = compare == 5 || compare == 7;  // a NaN
  end
endmodule

// A number of six bits.
module fp32_small (
    input  logic [5:0]  n,
    output logic [31:0] y
);
  logic [5:0] zeros, normal;
  leading_zeros lz (.x({n, 42'd0}), .n(zeros));
  always_comb begin
    normal = n << zeros;
    y = n == 0 ? 32'd0 : {1'b0, 8'(8'd132 - 8'(zeros)), normal[4:0], 18'd0};
  end
endmodule

// An integer of at most 2^24.
module fp32_integer (
    input  logic signed [25:0] n,
    output logic [31:0] y
);
  logic [24:0] size, normal;
  logic [5:0] zeros;
  assign size = 25'(n[25] ? -n : n);
  leading_zeros lz (.x({size, 23'd0}), .n(zeros));
  always_comb begin
    normal = size << zeros;
    y = size == 0 ? 32'd0 : {n[25], 8'(8'd151 - 8'(zeros)), normal[23:1]};
  end
endmodule

// Restates a triangle at the tile's first pixel, in two cycles: columns, then
// rows, with one multiplier an edge. A record stays for both cycles, since its
// 72 bytes come in two lines.
module restate #(
    parameter FP_EDGES = 0
) (
    input  logic         clk,
    input  logic         valid, // the first cycle
    input  logic [15:0]  origin_x, origin_y,
    input  logic [575:0] record,
    // The second cycle: values at the tile's first pixel, and steps as the lanes
    // take them; in fp32 of at most 2^24 with FP_EDGES.
    output logic [119:0] corner,
    output logic [95:0]  a, b,
    output logic [31:0]  depth
);
  logic second;
  logic [15:0] origin;
  logic [191:0] half;
  assign origin = second ? origin_y : origin_x;
  for (genvar k = 0; k < 3; k = k + 1) begin : one
    logic signed [31:0] step;
    logic signed [48:0] product;
    logic signed [63:0] from, sum;
    assign step = signed'(second ? record[96 + 32 * k +: 32] : record[32 * k +: 32]);
    assign product = step * signed'({1'b0, origin});
    assign from = signed'(second ? half[64 * k +: 64] : {record[288 + 32 * k +: 32], record[192 + 32 * k +: 32]});
    assign sum = from + 64'(product);
    always_ff @(posedge clk) half[64 * k +: 64] <= sum;
    if (FP_EDGES == 0) begin : kind
      // Within -2^38 to 2^38, beyond which no sign changes in a tile.
      logic is_small;
      assign is_small = sum[63:38] == 0 || &sum[63:38];
      assign corner[40 * k +: 40] = is_small ? sum[39:0] : sum[63] ? 40'hc000000000 : 40'h4000000000;
      assign a[32 * k +: 32] = record[32 * k +: 32];
      assign b[32 * k +: 32] = record[96 + 32 * k +: 32];
    end else begin : kind
      logic is_small;
      logic [31:0] step_fp, first_step;
      assign is_small = sum[63:24] == 0 || &sum[63:24];
      fp32_integer of_corner (
          .n(is_small ? sum[25:0] : sum[63] ? 26'h3000000 : 26'h1000000), .y(corner[32 * k +: 32]));
      fp32_integer of_step (.n(step[25:0]), .y(step_fp));
      always_ff @(posedge clk) first_step <= step_fp;
      assign a[32 * k +: 32] = first_step;
      assign b[32 * k +: 32] = step_fp;
    end
  end
  if (FP_EDGES != 0) assign corner[119:96] = 0;

  logic [31:0] half_depth, distance, along;
  logic [15:0] first;
  assign first = second ? record[511:496] : record[495:480];
  fp32_integer to_fp (.n(26'(signed'({1'b0, origin} - {1'b0, first}))), .y(distance));
  fp32_mul times (.a(second ? record[479:448] : record[447:416]), .b(distance), .y(along));
  fp32_add plus (.a(second ? half_depth : record[415:384]), .b(along), .y(depth));
  always_ff @(posedge clk) begin
    second <= valid;
    half_depth <= depth;
  end
endmodule
