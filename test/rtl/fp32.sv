// fp32 units of one cycle: IEEE 754, rounded to nearest even, with subnormal
// numbers. A result that is no number is the canonical one.

// The number of zeros above the highest one of 48 bits; 48 for none.
module leading_zeros (
    input  logic [47:0] x,
    output logic [5:0]  n
);
  always_comb begin
    n = 48;
    for (int i = 0; i < 48; i++)
      if (x[i]) n = 6'(47 - i);
  end
endmodule

module fp32_mul (
    input  logic [31:0] a, b,
    output logic [31:0] y
);
  logic sign, a_zero, b_zero, a_top, b_top, nan;
  logic [23:0] ma, mb;
  logic [47:0] product, normal, kept;
  logic [5:0] zeros;
  logic signed [10:0] exponent;
  logic [10:0] right;
  logic sticky, up;
  logic [31:0] rounded;

  leading_zeros lz (.x(product), .n(zeros));

  always_comb begin
    sign = a[31] ^ b[31];
    a_zero = a[30:0] == 0;
    b_zero = b[30:0] == 0;
    a_top = &a[30:23];
    b_top = &b[30:23];
    nan = (a_top && a[22:0] != 0) || (b_top && b[22:0] != 0) || (a_top && b_zero) || (b_top && a_zero);
    ma = {a[30:23] != 0, a[22:0]};
    mb = {b[30:23] != 0, b[22:0]};
    product = ma * mb;
  end

  always_comb begin
    // Of a product whose highest bit is 47.
    exponent = 11'(a[30:23]) + 11'(a[30:23] == 0) + 11'(b[30:23]) + 11'(b[30:23] == 0) - 11'd126 - 11'(zeros);
    normal = product << zeros;
    right = exponent > 0 ? 11'd0 : 11'd1 - exponent;
    if (right > 26) right = 26; // below half of the smallest number: sticky
    kept = normal >> right;
    sticky = kept[22:0] != 0 || (kept << right) != normal;
    up = kept[23] && (sticky || kept[24]);
    // The highest bit, where it is there, is worth one more exponent.
    rounded = {1'b0, exponent > 0 ? 8'(exponent - 11'sd1) : 8'd0, 23'd0} + {8'd0, kept[47:24]} + 32'(up);
    if (nan) y = 32'h7fc00000;
    else if (a_top || b_top || exponent > 254 || rounded[30:23] == 8'hff)
      y = product == 0 && !a_top && !b_top ? {sign, 31'd0} : {sign, 8'hff, 23'd0};
    else y = product == 0 ? {sign, 31'd0} : {sign, rounded[30:0]};
  end
endmodule

module fp32_add (
    input  logic [31:0] a, b,
    output logic [31:0] y
);
  logic swap, subtract, nan, sticky, up;
  logic [31:0] larger, smaller;
  logic [7:0] exponent, distance;
  logic [26:0] ml, ms, shifted;
  logic [27:0] sum, normal;
  logic [5:0] zeros;
  logic [7:0] left;
  logic [31:0] rounded;

  leading_zeros lz (.x({sum, 20'd0}), .n(zeros));

  always_comb begin
    swap = b[30:0] > a[30:0];
    larger = swap ? b : a;
    smaller = swap ? a : b;
    subtract = a[31] ^ b[31];
    nan = (&larger[30:23] && larger[22:0] != 0) || (&smaller[30:23] && subtract);
    exponent = larger[30:23] == 0 ? 8'd1 : larger[30:23];
    distance = exponent - (smaller[30:23] == 0 ? 8'd1 : smaller[30:23]);
    ml = {larger[30:23] != 0, larger[22:0], 3'd0};
    ms = {smaller[30:23] != 0, smaller[22:0], 3'd0};
    if (distance > 26) distance = 26;
    shifted = ms >> distance;
    sticky = (shifted << distance) != ms;
    shifted[0] = shifted[0] | sticky;
    sum = subtract ? {1'b0, ml} - {1'b0, shifted} : {1'b0, ml} + {1'b0, shifted};
  end

  always_comb begin
    // A sum of two has its highest bit at 27 or 26; below, at most down to the
    // smallest exponent.
    left = 8'(zeros) > exponent ? exponent : 8'(zeros);
    normal = sum << left;
    up = normal[3] && (normal[4] || normal[2:0] != 0);
    rounded = {1'b0, 8'(exponent - left), 23'd0} + {8'd0, normal[27:4]} + 32'(up);
    if (nan) y = 32'h7fc00000;
    else if (&larger[30:23]) y = {larger[31], 8'hff, 23'd0};
    else if (sum == 0) y = {a[31] & b[31], 31'd0};
    else if (rounded[31] || &rounded[30:23]) y = {larger[31], 8'hff, 23'd0};
    else y = {larger[31], rounded[30:0]};
  end
endmodule

// a < b and a <= b; neither where one is no number.
module fp32_compare (
    input  logic [31:0] a, b,
    output logic less, less_equal
);
  logic ordered, equal;
  always_comb begin
    ordered = a[30:0] <= 31'h7f800000 && b[30:0] <= 31'h7f800000;
    equal = a == b || (a[30:0] == 0 && b[30:0] == 0);
    if (a[31] != b[31]) less = a[31] && !equal;
    else less = a[31] ? b[30:0] < a[30:0] : a[30:0] < b[30:0];
    less = ordered && less;
    less_equal = less || (ordered && equal);
  end
endmodule

// The centre of pixel n: n + 0.5.
module fp32_centre (
    input  logic [16:0] n,
    output logic [31:0] y
);
  logic [5:0] zeros;
  logic [17:0] twice, normal;
  assign twice = {n, 1'b1};
  leading_zeros lz (.x({twice, 30'd0}), .n(zeros));
  always_comb begin
    normal = twice << zeros;
    // Bit 17 of twice is worth 2^16.
    y = {1'b0, 8'(8'd143 - 8'(zeros)), normal[16:0], 6'd0};
  end
endmodule
