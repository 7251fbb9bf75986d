// What Bench.cpp runs: the rasterizer, its arithmetic alone, and lanes alone of
// the two designs of edges (docs/unification.md).
module top (
    input  logic         clk, reset, start,
    input  logic         draws_triangles, writes_depth,
    input  logic [2:0]   compare,
    input  logic [31:0]  clear_depth,
    input  logic [15:0]  origin_x, origin_y,
    input  logic [6:0]   width, height,
    input  logic [31:0]  cutoff, list_at, records, count, target, pitch,
    output logic         done, request, writes,
    output logic [31:0]  address,
    output logic [511:0] data,
    output logic [7:0]   parts,
    input  logic         answer,
    input  logic [511:0] line,
    output logic [2:0]   state,
    output logic         blends, waits, misses,
    input  logic [31:0]  a, b,
    output logic [31:0]  product, sum, half,
    output logic         less, less_equal,
    // A triangle's record, which two lanes draw into a pixel of the tile: edges
    // in integers, and in fp32.
    input  logic         tries,
    input  logic [5:0]   x, y,
    input  logic [575:0] record,
    input  logic [31:0]  stored,
    output logic         writes_integer, writes_fp,
    output logic [63:0]  integer_pixel, fp_pixel
);
  rasterizer rasterizer (.*);
  fp32_mul mul (.a, .b, .y(product));
  fp32_add add (.a, .b, .y(sum));
  minus_half minus (.x(a), .y(half));
  fp32_compare comparator (.a, .b, .less, .less_equal);

  for (genvar d = 0; d < 2; d++) begin : tried
    localparam BITS = d == 0 ? 440 : 416;
    logic is_cut, reaches, reads, closes, is_written;
    logic [31:0] alpha, wanted;
    logic [BITS-1:0] shape;
    logic [6:0] first_x, end_x, first_y, end_y;
    logic [127:0] updated;
    cut #(.GAUSSIANS(0), .FP_EDGES(d)) cuts (
        .clk, .reset, .is_triangle(1'b1), .origin_x, .origin_y, .valid(tries), .record, .done(is_cut), .shape, .first_x, .end_x,
        .first_y, .end_y);
    lane #(.FP_EDGES(d)) lane (
        .clk, .reset, .draws_triangles(1'b1), .valid(is_cut), .column(17'd0), .row(17'd0), .x, .y, .shape,
        .tag(record[575:544]), .compare, .writes_depth(1'b1), .opacity(32'd0), .reaches, .alpha, .wanted, .reads, .pixel({96'd0, stored}), .red(32'd0),
        .green(32'd0), .blue(32'd0), .cutoff(32'd0), .writes(is_written), .closes, .updated);
  end
  assign writes_integer = tried[0].is_written;
  assign writes_fp = tried[1].is_written;
  assign integer_pixel = tried[0].updated[63:0];
  assign fp_pixel = tried[1].updated[63:0];
endmodule
