// A lane: blends a Gaussian into a pixel, a pixel a cycle (docs/abi.md,
// "Rasterizer"). Cycles behind dispatch: 1 power, 2 to 4 exponential and alpha,
// 5 blend; the bank writes in cycle 6.
module lane (
    input  logic        clk, reset,
    // Cycle 1: the pixel and the Gaussian.
    input  logic        valid,
    input  logic [16:0] column, row, // in the picture
    input  logic [31:0] mean_x, mean_y, conic_a, conic_b, conic_c,
    // Cycle 4: the Gaussian. The pixel is to be read.
    input  logic [31:0] opacity,
    output logic        reads,
    // Cycle 5: the Gaussian, and the pixel {T, b, g, r}. Its T is negative when
    // the pixel is closed.
    input  logic [31:0] red, green, blue,
    input  logic [127:0] pixel,
    input  logic [31:0] cutoff,
    // Cycle 6: the new pixel.
    output logic         writes,
    output logic         closes,
    output logic [127:0] updated
);
  /*verilator hier_block*/ // compiled once for all lanes
  localparam logic [31:0] LARGEST_ALPHA = 32'h3f7d70a4;  // 0.99
  localparam logic [31:0] SMALLEST_ALPHA = 32'h3b808081; // 1/255
  localparam logic [31:0] ONE = 32'h3f800000;

  // Cycle 1: power = -0.5 (a dx dx + c dy dy) - b dx dy.
  logic [31:0] px, py, dx, dy, adx, adxdx, cdy, cdydy, bdx, bdxdy, sum, half, power;
  fp32_centre centre_x (.n(column), .y(px));
  fp32_centre centre_y (.n(row), .y(py));
  fp32_add sub_x (.a(mean_x), .b(px ^ 32'h80000000), .y(dx));
  fp32_add sub_y (.a(mean_y), .b(py ^ 32'h80000000), .y(dy));
  fp32_mul mul_adx (.a(conic_a), .b(dx), .y(adx));
  fp32_mul mul_adxdx (.a(adx), .b(dx), .y(adxdx));
  fp32_mul mul_cdy (.a(conic_c), .b(dy), .y(cdy));
  fp32_mul mul_cdydy (.a(cdy), .b(dy), .y(cdydy));
  fp32_mul mul_bdx (.a(conic_b), .b(dx), .y(bdx));
  fp32_mul mul_bdxdy (.a(bdx), .b(dy), .y(bdxdy));
  fp32_add add_squares (.a(adxdx), .b(cdydy), .y(sum));
  minus_half times (.x(sum), .y(half));
  fp32_add sub_cross (.a(half), .b(bdxdy ^ 32'h80000000), .y(power));
  logic near;
  logic unused_1;
  fp32_compare not_above (.a(power), .b(32'd0), .less(unused_1), .less_equal(near));

  logic [31:0] power_2;
  logic valid_2, valid_3, valid_4;

  // Cycles 2 to 4: alpha = min(0.99, opacity e^power).
  logic [31:0] falloff, wanted, alpha;
  logic enough, low, unused_2;
  exp_table exponential (.clk, .power(power_2), .y(falloff));
  fp32_mul mul_opacity (.a(opacity), .b(falloff), .y(wanted));
  fp32_compare seen (.a(SMALLEST_ALPHA), .b(wanted), .less(unused_2), .less_equal(enough));
  logic unused_3;
  fp32_compare limit (.a(wanted), .b(LARGEST_ALPHA), .less(low), .less_equal(unused_3));
  assign alpha = low ? wanted : LARGEST_ALPHA;
  assign reads = valid_4;

  // Cycle 5: T' = T (1 - alpha), C += color (alpha T).
  logic [31:0] alpha_5, rest, next_t, taken, r, g, b, add_r, add_g, add_b;
  logic valid_5, is_open, stops, unused_4;
  fp32_add sub_alpha (.a(ONE), .b(alpha_5 ^ 32'h80000000), .y(rest));
  fp32_mul mul_t (.a(pixel[127:96]), .b(rest), .y(next_t));
  fp32_mul mul_taken (.a(alpha_5), .b(pixel[127:96]), .y(taken));
  fp32_mul mul_r (.a(red), .b(taken), .y(add_r));
  fp32_mul mul_g (.a(green), .b(taken), .y(add_g));
  fp32_mul mul_b (.a(blue), .b(taken), .y(add_b));
  fp32_add sum_r (.a(pixel[31:0]), .b(add_r), .y(r));
  fp32_add sum_g (.a(pixel[63:32]), .b(add_g), .y(g));
  fp32_add sum_b (.a(pixel[95:64]), .b(add_b), .y(b));
  fp32_compare stop (.a(next_t), .b(cutoff), .less(stops), .less_equal(unused_4));
  assign is_open = valid_5 && !pixel[127];

  always_ff @(posedge clk) begin
    power_2 <= power;
    alpha_5 <= alpha;
    updated <= stops ? {1'b1, pixel[126:0]} : {next_t, b, g, r};
    if (reset) begin
      valid_2 <= 0;
      valid_3 <= 0;
      valid_4 <= 0;
      valid_5 <= 0;
      writes <= 0;
      closes <= 0;
    end else begin
      valid_2 <= valid && near;
      valid_3 <= valid_2;
      valid_4 <= valid_3;
      valid_5 <= valid_4 && enough;
      writes <= is_open;
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
