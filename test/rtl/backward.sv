// The backward mode (docs/abi.md, "Backward"): a pair of lanes takes a pixel. The
// even one computes alpha as in a render (lane.sv), the odd one the gradients,
// and the gather sums them over the tile.

// a / b, rounded to nearest even, where b is 1 - alpha: 0.01 to 1.
module fp32_div (
    input  logic [31:0] a, b,
    output logic [31:0] y
);
  logic [23:0] mb;
  logic [5:0] zeros;
  logic signed [10:0] exponent;
  logic [10:0] right;
  logic [24:0] left, quotient, rest;
  logic [47:0] normal, kept;
  logic [31:0] rounded;
  logic sticky, up;
  leading_zeros lz (.x({a[30:23] != 0, a[22:0], 24'd0}), .n(zeros));
  always_comb begin
    mb = {1'b1, b[22:0]};
    left = {1'b0, a[30:23] != 0, a[22:0]} << zeros;
    exponent = 11'(a[30:23]) + 11'(a[30:23] == 0) - 11'(zeros) - 11'(b[30:23]) + 11'd127;
    rest = left;
    if (left < 25'(mb)) begin
      rest = left << 1;
      exponent = exponent - 11'd1;
    end
    quotient = 0;
    for (int i = 0; i < 25; i++) begin
      quotient = quotient << 1;
      if (rest >= 25'(mb)) begin
        quotient[0] = 1;
        rest = rest - 25'(mb);
      end
      rest = rest << 1;
    end
  end
  always_comb begin
    normal = {quotient, rest != 0, 22'd0};
    right = exponent > 0 ? 11'd0 : 11'd1 - exponent;
    if (right > 26) right = 26;
    kept = normal >> right;
    sticky = kept[22:0] != 0 || (kept << right) != normal;
    up = kept[23] && (sticky || kept[24]);
    rounded = {1'b0, exponent > 0 ? 8'(exponent - 11'sd1) : 8'd0, 23'd0} + {8'd0, kept[47:24]} + 32'(up);
    if (&a[30:23]) y = a[22:0] != 0 ? 32'h7fc00000 : a;
    else if (a[30:0] == 0) y = a;
    else if (exponent > 254 || &rounded[30:23]) y = {a[31], 8'hff, 23'd0};
    else y = {a[31], rounded[30:0]};
  end
endmodule

// What the odd lane does in the backward mode. Cycle 5: the pixel; 6: the terms;
// they are given in cycle 7.
module gradients (
    input  logic         clk, reset,
    // Cycle 4, of the even lane: whether the Gaussian reaches the pixel, alpha,
    // and opacity times falloff.
    input  logic         reaches,
    input  logic [31:0]  alpha, wanted,
    // Cycle 5: the pixel's place, the Gaussian, and the pixel {last, behind, T, b,
    // g, r} with the loss's gradients by the colours.
    input  logic [16:0]  column, row,
    input  logic [31:0]  mean_x, mean_y, red, green, blue, entry,
    input  logic         clamp_stops,
    input  logic [191:0] pixel,
    // Cycle 6.
    output logic         writes,
    output logic [63:0]  updated, // {behind, T}
    // Cycle 7: by colour r, g, b; s, s x, s y, s x x, s x y, s y y.
    output logic         valid,
    output logic [287:0] terms
);
  localparam logic [31:0] LARGEST_ALPHA = 32'h3f7d70a4;  // 0.99
  localparam logic [31:0] SIGN = 32'h80000000;
  logic reaches_5, counts;
  logic [31:0] alpha_5, wanted_5, gr, gg, gb, t, behind;
  assign {behind, t, gb, gg, gr} = pixel[159:0];
  assign counts = reaches_5 && pixel[191:160] > entry;

  logic [31:0] rest, next_t, light_r, light_g, light_b, light_rg, light, gain, more, next_behind, weight, scaled, s;
  logic stops, unused;
  fp32_add sub_alpha (.a(32'h3f800000), .b(alpha_5 ^ SIGN), .y(rest));
  fp32_div divide (.a(t), .b(rest), .y(next_t));
  fp32_mul mul_r (.a(red), .b(gr), .y(light_r));
  fp32_mul mul_g (.a(green), .b(gg), .y(light_g));
  fp32_mul mul_b (.a(blue), .b(gb), .y(light_b));
  fp32_add add_rg (.a(light_r), .b(light_g), .y(light_rg));
  fp32_add add_light (.a(light_rg), .b(light_b), .y(light));
  fp32_add sub_behind (.a(light), .b(behind ^ SIGN), .y(gain));
  fp32_mul mul_more (.a(alpha_5), .b(gain), .y(more));
  fp32_add add_behind (.a(behind), .b(more), .y(next_behind));
  fp32_mul mul_weight (.a(alpha_5), .b(next_t), .y(weight));
  fp32_mul mul_gain (.a(next_t), .b(gain), .y(scaled));
  fp32_mul mul_s (.a(wanted_5), .b(scaled), .y(s));
  fp32_compare limit (.a(LARGEST_ALPHA), .b(wanted_5), .less(stops), .less_equal(unused));

  // From the mean to the pixel.
  logic [31:0] px, py, x, y;
  fp32_centre centre_x (.n(column), .y(px));
  fp32_centre centre_y (.n(row), .y(py));
  fp32_add sub_x (.a(mean_x), .b(px ^ SIGN), .y(x));
  fp32_add sub_y (.a(mean_y), .b(py ^ SIGN), .y(y));

  logic counts_6;
  logic [31:0] weight_6, s_6, r_6, g_6, b_6, x_6, y_6;
  logic [31:0] by_r, by_g, by_b, sx, sy, sxx, sxy, syy;
  fp32_mul term_r (.a(weight_6), .b(r_6), .y(by_r));
  fp32_mul term_g (.a(weight_6), .b(g_6), .y(by_g));
  fp32_mul term_b (.a(weight_6), .b(b_6), .y(by_b));
  fp32_mul term_x (.a(s_6), .b(x_6), .y(sx));
  fp32_mul term_y (.a(s_6), .b(y_6), .y(sy));
  fp32_mul term_xx (.a(sx), .b(x_6), .y(sxx));
  fp32_mul term_xy (.a(sx), .b(y_6), .y(sxy));
  fp32_mul term_yy (.a(sy), .b(y_6), .y(syy));

  assign writes = counts_6;
  always_ff @(posedge clk) begin
    reaches_5 <= !reset && reaches;
    alpha_5 <= alpha;
    wanted_5 <= wanted;
    counts_6 <= !reset && counts;
    updated <= {next_behind, next_t};
    weight_6 <= weight;
    s_6 <= clamp_stops && stops ? 32'd0 : s;
    {b_6, g_6, r_6} <= pixel[95:0];
    x_6 <= x ^ SIGN;
    y_6 <= y ^ SIGN;
    valid <= !reset && counts_6;
    terms <= {syy, sxy, sxx, sy, sx, s_6, by_b, by_g, by_r};
  end
endmodule

// The gather's part for the columns of a tile that are equal modulo 8. Each of
// its columns modulo 16 has a sum of the current row, and sums of the rows before
// as a binary tree holds them: of 2^l rows at level l, where bit l of the row is
// set. It does one addition of nine terms a cycle.
module gather_columns (
    input  logic         clk, reset, // of a Gaussian
    input  logic         valid,
    input  logic         column, // which of the two
    input  logic [5:0]   row,
    input  logic [287:0] terms,
    output logic         takes,
    input  logic         ends, // no more come
    output logic         ended,
    // Sums of both columns, and of another unit's columns: for the last levels.
    input  logic         adds_columns, adds_other,
    input  logic [287:0] other,
    output logic [287:0] total
);
  logic [287:0] current[2];
  logic [287:0] levels[16]; // {column, level}
  logic [5:0] full[2], rows[2];
  logic used[2];

  logic at; // column
  logic [5:0] below, due, level_bits;
  logic [2:0] level, top;
  logic moves, merges, same;
  assign at = ends ? !ended_columns[0] ? 1'b0 : 1'b1 : column;
  logic [1:0] ended_columns;
  assign ended_columns[0] = full[0] == 0;
  assign ended_columns[1] = full[1] == 0;
  assign ended = ends && &ended_columns;
  always_comb begin
    same = used[at] && rows[at] == row;
    // The highest bit in which the rows differ: all levels below end.
    top = 0;
    for (int l = 0; l < 6; l++)
      if (rows[at][l] != row[l]) top = 3'(l);
    below = ends ? 6'b111111 : (6'd1 << top) - 6'd1;
    due = used[at] ? full[at] & below : 6'd0;
    level = 0;
    for (int l = 5; l >= 0; l--)
      if (due[l]) level = 3'(l);
    level_bits = 6'd1 << level;
    merges = due != 0 && (ends ? !ended : valid && !same);
    moves = valid && !ends && !same && !merges;
    takes = valid && !ends && !merges;
  end

  // What is added to what: a level to the rows behind it, a term to its row.
  logic [287:0] left, right, sum;
  always_comb begin
    left = current[at];
    right = terms;
    if (merges) begin
      left = levels[{at, level}];
      right = current[at];
    end else if (adds_columns) begin
      left = current[0];
      right = current[1];
    end else if (adds_other) begin
      left = current[0];
      right = other;
    end else if (moves) left = 0;
  end
  for (genvar k = 0; k < 9; k++) begin : one
    fp32_add add (.a(left[32*k+:32]), .b(right[32*k+:32]), .y(sum[32*k+:32]));
  end
  assign total = current[0];

  always_ff @(posedge clk) begin
    if (moves && used[at]) levels[{at, top}] <= current[at];
    if (reset) begin
      for (int c = 0; c < 2; c++) begin
        used[c] <= 0;
        full[c] <= 0;
        current[c] <= 0;
      end
    end else if (adds_columns || adds_other) current[0] <= sum;
    else begin
      if (merges || takes) current[at] <= sum;
      if (merges) full[at] <= full[at] & ~level_bits;
      if (moves) begin
        if (used[at]) full[at] <= full[at] | 6'd1 << top;
        used[at] <= 1;
        rows[at] <= row;
      end
    end
  end
endmodule

// Sums nine terms over a Gaussian's pixels. A unit takes a pixel a cycle, as long
// as no rows wait to be added; the last levels, across columns, take four cycles.
module gather (
    input  logic          clk, reset,
    // By column modulo 8.
    input  logic [7:0]    valid, column,
    input  logic [47:0]   row,
    input  logic [2303:0] terms,
    output logic [7:0]    takes,
    input  logic          ends, // until it is done
    output logic          done,
    output logic [287:0]  sums
);
  logic [7:0] ended;
  logic [2303:0] totals;
  logic [2:0] stage; // of the columns: 16, 8, 4, 2, 1
  for (genvar u = 0; u < 8; u++) begin : unit
    logic [287:0] other;
    if (u < 4) assign other = stage == 1 ? totals[288*(u+4)+:288] : u < 2 && stage == 2 ? totals[288*(u%2+2)+:288] : totals[288+:288];
    else assign other = 0;
    gather_columns columns (
        .clk, .reset, .valid(valid[u]), .column(column[u]), .row(row[6*u+:6]), .terms(terms[288*u+:288]), .takes(takes[u]),
        .ends, .ended(ended[u]), .adds_columns(&ended && stage == 0), .adds_other(&ended && u < 4 && stage != 0 && stage != 4),
        .other, .total(totals[288*u+:288]));
  end
  assign done = stage == 4;
  assign sums = totals[287:0];
  always_ff @(posedge clk) begin
    if (reset) stage <= 0;
    else if (&ended && stage != 4) stage <= stage + 3'd1;
  end
endmodule
