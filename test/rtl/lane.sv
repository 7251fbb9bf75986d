// A lane: draws a primitive into a pixel, a pixel a cycle. Of a Gaussian it
// blends (docs/abi.md, "Rasterizer"): cycle 1 behind dispatch power, 2 to 4
// exponential and alpha, 5 blend; the bank writes in cycle 6. Of a triangle it
// tests (docs/primitives.md): cycle 1 edges and depth, 2 the depth test; the
// bank writes in cycle 3.
//
// What both kinds need is there once: a triangle's depth takes multipliers and
// adders of the power. Its edges have integers of their own, or with FP_EDGES
// the fp32 units of power and blending, which are exact for steps of at most
// 133,152 (docs/unification.md).
module lane #(
    parameter GAUSSIANS = 1,
    parameter TRIANGLES = 1,
    parameter FP_EDGES = 0,
    parameter BITS = TRIANGLES != 0 ? (FP_EDGES != 0 ? 416 : 440) : 288
) (
    input  logic        clk, reset,
    input  logic        draws_triangles, // a command's kind
    // Cycle 1: the pixel, in the picture and in the tile, and the primitive
    // (cut.sv has its fields).
    input  logic        valid,
    input  logic [16:0] column, row,
    input  logic [5:0]  x, y,
    input  logic [BITS-1:0] shape,
    // Cycle 2: the triangle.
    input  logic [31:0] tag,
    input  logic [2:0]  compare, // less, equal, greater
    input  logic        writes_depth,
    // Cycle 4: the Gaussian.
    input  logic [31:0] opacity,
    // For the backward mode: alpha, and before it is limited.
    output logic        reaches,
    output logic [31:0] alpha, wanted,
    // Cycle 1 of a triangle, 4 of a Gaussian: the pixel is to be read.
    output logic        reads,
    // A cycle later: the pixel {T, b, g, r}, whose T is negative when it is
    // closed, or {tag, depth}.
    input  logic [127:0] pixel,
    // Cycle 5: the Gaussian.
    input  logic [31:0] red, green, blue,
    input  logic [31:0] cutoff,
    // Cycle 3 or 6: the new pixel.
    output logic         writes,
    output logic         closes,
    output logic [127:0] updated
);
  /*verilator hier_block*/ // compiled once for all lanes
  localparam logic [31:0] LARGEST_ALPHA = 32'h3f7d70a4;  // 0.99
  localparam logic [31:0] SMALLEST_ALPHA = 32'h3b808081; // 1/255
  localparam logic [31:0] ONE = 32'h3f800000;
  localparam logic [31:0] SIGN = 32'h80000000;

  logic is_triangle;
  assign is_triangle = TRIANGLES != 0 && (GAUSSIANS == 0 || draws_triangles);

  // Cycle 1: power = -0.5 (a dx dx + c dy dy) - b dx dy, or a triangle's edges
  // and depth.
  logic [31:0] px, py, dx, dy, column_fp, row_fp, gx, gy;
  logic [31:0] adx, adxdx, cdy, cdydy, bdx, bdxdy, sum, half, power;
  // Operands that depend on the kind.
  logic [31:0] sub_x_b, sub_y_a, sub_y_b, square_a, square_b, cross_a;
  logic [31:0] squares_a, squares_b, last_a, last_b;
  fp32_centre centre_x (.n(column), .y(px));
  fp32_centre centre_y (.n(row), .y(py));
  fp32_small to_x (.n(x), .y(column_fp));
  fp32_small to_y (.n(y), .y(row_fp));
  fp32_add sub_x (.a(shape[31:0]), .b(sub_x_b), .y(dx));
  fp32_add sub_y (.a(sub_y_a), .b(sub_y_b), .y(dy));
  assign gx = is_triangle ? column_fp : dx;
  assign gy = is_triangle ? row_fp : dy;
  fp32_mul mul_adx (.a(shape[95:64]), .b(gx), .y(adx));
  fp32_mul mul_adxdx (.a(square_a), .b(gx), .y(adxdx));
  fp32_mul mul_cdy (.a(shape[159:128]), .b(gy), .y(cdy));
  fp32_mul mul_cdydy (.a(square_b), .b(gy), .y(cdydy));
  fp32_mul mul_bdx (.a(shape[127:96]), .b(gx), .y(bdx));
  fp32_mul mul_bdxdy (.a(cross_a), .b(gy), .y(bdxdy));
  fp32_add add_squares (.a(squares_a), .b(squares_b), .y(sum));
  minus_half times (.x(sum), .y(half));
  fp32_add sub_cross (.a(last_a), .b(last_b), .y(power));
  logic near;
  logic unused_1;
  fp32_compare not_above (.a(power), .b(32'd0), .less(unused_1), .less_equal(near));

  // Cycle 5: T' = T (1 - alpha), C += color (alpha T).
  logic [31:0] alpha_5, rest, next_t, taken, r, g, b, add_r, add_g, add_b;
  logic [31:0] rest_a, rest_b, r_a, r_b, g_a, g_b, sum_r_a, sum_r_b, sum_g_a, sum_g_b, sum_b_a, sum_b_b;
  logic valid_5, is_open, stops, unused_4;
  fp32_add sub_alpha (.a(rest_a), .b(rest_b), .y(rest));
  fp32_mul mul_t (.a(pixel[127:96]), .b(rest), .y(next_t));
  fp32_mul mul_taken (.a(alpha_5), .b(pixel[127:96]), .y(taken));
  fp32_mul mul_r (.a(r_a), .b(r_b), .y(add_r));
  fp32_mul mul_g (.a(g_a), .b(g_b), .y(add_g));
  fp32_mul mul_b (.a(blue), .b(taken), .y(add_b));
  fp32_add sum_r (.a(sum_r_a), .b(sum_r_b), .y(r));
  fp32_add sum_g (.a(sum_g_a), .b(sum_g_b), .y(g));
  fp32_add sum_b (.a(sum_b_a), .b(sum_b_b), .y(b));
  fp32_compare stop (.a(next_t), .b(cutoff), .less(stops), .less_equal(unused_4));
  assign is_open = valid_5 && !pixel[127];

  logic [31:0] depth;
  logic covered;
  always_comb begin
    sub_x_b = px ^ SIGN;
    sub_y_a = shape[63:32];
    sub_y_b = py ^ SIGN;
    square_a = adx;
    square_b = cdy;
    cross_a = bdx;
    squares_a = adxdx;
    squares_b = cdydy;
    last_a = half;
    last_b = bdxdy ^ SIGN;
    rest_a = ONE;
    rest_b = alpha_5 ^ SIGN;
    r_a = red;
    r_b = taken;
    g_a = green;
    g_b = taken;
    sum_r_a = pixel[31:0];
    sum_r_b = add_r;
    sum_g_a = pixel[63:32];
    sum_g_b = add_g;
    sum_b_a = pixel[95:64];
    sum_b_b = add_b;
    if (is_triangle && FP_EDGES == 0) begin
      // (corner + step x * column) + step y * row
      squares_a = shape[31:0];
      squares_b = adx;
      last_a = sum;
      last_b = cdy;
    end
    if (is_triangle && FP_EDGES != 0) begin
      // Edge k: (A x + B y) + corner, of which the last sum alone may be rounded,
      // which changes no sign.
      rest_a = adx;
      rest_b = cdy;
      sum_r_a = shape[63:32];
      sum_r_b = rest;
      square_a = shape[191:160];
      square_b = shape[255:224];
      sum_g_a = shape[BITS-33-:32];
      sum_g_b = sum;
      cross_a = shape[287:256];
      last_a = bdx;
      last_b = bdxdy;
      sum_b_a = shape[BITS-1-:32];
      sum_b_b = power;
      // Depth.
      r_a = shape[BITS-97-:32];
      r_b = column_fp;
      g_a = shape[BITS-65-:32];
      g_b = row_fp;
      sub_x_b = add_r;
      sub_y_a = dx;
      sub_y_b = add_g;
    end
  end
  generate
    if (TRIANGLES == 0) begin : kind
      assign covered = 0;
      assign depth = power;
    end else if (FP_EDGES != 0) begin : kind
      assign covered = !r[31] && !g[31] && !b[31];
      assign depth = is_triangle ? dy : power;
    end else begin : kind
      edges three (
          .x, .y, .a({shape[191:160], shape[127:96], shape[63:32]}), .b(shape[319:224]),
          .corner(shape[BITS-1-:120]), .covered);
      assign depth = power;
    end
  endgenerate

  logic [31:0] power_2; // or depth
  logic valid_2, valid_3, valid_4, valid_test;

  // Cycle 2 of a triangle: the test.
  logic passes;
  depth_test test (.depth(power_2), .stored(pixel[31:0]), .compare, .passes);

  // Cycles 2 to 4: alpha = min(0.99, opacity e^power).
  logic [31:0] falloff, wanted_4, alpha_4;
  logic enough, low, unused_2;
  exp_table exponential (.clk, .power(power_2), .y(falloff));
  fp32_mul mul_opacity (.a(opacity), .b(falloff), .y(wanted_4));
  fp32_compare seen (.a(SMALLEST_ALPHA), .b(wanted_4), .less(unused_2), .less_equal(enough));
  logic unused_3;
  fp32_compare limit (.a(wanted_4), .b(LARGEST_ALPHA), .less(low), .less_equal(unused_3));
  assign alpha_4 = low ? wanted_4 : LARGEST_ALPHA;
  assign reaches = GAUSSIANS != 0 && valid_4 && enough;
  assign wanted = GAUSSIANS != 0 ? wanted_4 : 32'd0;
  assign alpha = GAUSSIANS != 0 ? alpha_4 : 32'd0;
  assign reads = is_triangle ? valid : valid_4;

  always_ff @(posedge clk) begin
    power_2 <= depth;
    alpha_5 <= alpha_4;
    if (is_triangle) updated <= {64'd0, tag, power_2};
    else updated <= stops ? {1'b1, pixel[126:0]} : {next_t, b, g, r};
    if (reset) begin
      valid_test <= 0;
      valid_2 <= 0;
      valid_3 <= 0;
      valid_4 <= 0;
      valid_5 <= 0;
      writes <= 0;
      closes <= 0;
    end else begin
      valid_test <= valid && is_triangle && covered;
      valid_2 <= valid && !is_triangle && near;
      valid_3 <= valid_2;
      valid_4 <= valid_3;
      valid_5 <= reaches;
      writes <= is_triangle ? valid_test && passes && writes_depth : is_open;
      closes <= is_open && stops;
    end
  end
endmodule

// -x / 2: the exponent falls, and only a subnormal result is rounded.
module minus_half (
    input  logic [31:0] x,
    output logic [31:0] y
);
  logic [23:0] mantissa;
  always_comb begin
    mantissa = {x[30:23] != 0, x[22:0]};
    if (x[30:23] == 8'hff) y = x ^ 32'h80000000;
    else if (x[30:23] > 1) y = {!x[31], 8'(x[30:23] - 8'd1), x[22:0]};
    else y = {!x[31], 31'(mantissa[23:1]) + 31'(mantissa[0] && mantissa[1])};
  end
endmodule
