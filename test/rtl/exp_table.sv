// The exponential unit "table" (docs/lane-units.md, "Exponential units"):
// e^p = 2^-y for p <= 0, y = -p log2(e) in fixed point with 16 bits of fraction,
// of which 4 choose a straight piece and 12 go along it. Three cycles, the last
// of which the caller shares.
module exp_table (
    input  logic        clk,
    input  logic [31:0] power,
    output logic [31:0] y
);
  // 2^16 2^(-i/16), rounded.
  function automatic logic [16:0] table_entry(input logic [4:0] i);
    case (i)
      0: table_entry = 65536;  1: table_entry = 62757;  2: table_entry = 60097;  3: table_entry = 57549;
      4: table_entry = 55109;  5: table_entry = 52773;  6: table_entry = 50535;  7: table_entry = 48393;
      8: table_entry = 46341;  9: table_entry = 44376;  10: table_entry = 42495; 11: table_entry = 40693;
      12: table_entry = 38968; 13: table_entry = 37316; 14: table_entry = 35734; 15: table_entry = 34219;
      default: table_entry = 32768;
    endcase
  endfunction

  // First cycle: y = -p log2(e) 2^16 in fp32, then without its fraction.
  logic [31:0] held, scaled;
  logic [23:0] fixed, fixed_q;
  logic [7:0] shift;
  fp32_mul by_log2e (.a(held), .b(32'h47b8aa3b), .y(scaled));
  always_comb begin
    // At most 90, beyond which every result is 0; without its sign.
    held = power[30:0] > 31'h42b40000 ? 32'h42b40000 : {1'b0, power[30:0]};
    shift = 8'd150 - scaled[30:23];
    fixed = shift > 23 ? 24'd0 : {1'b1, scaled[22:0]} >> shift;
  end

  // Second: the piece and how far along it.
  logic [16:0] first, first_q, drop;
  logic [11:0] fall, fall_q;
  logic [7:0] whole_q;
  always_comb begin
    first = table_entry({1'b0, fixed_q[15:12]});
    drop = first - table_entry(5'(fixed_q[15:12]) + 5'd1);
    fall = 12'((24'(drop[11:0]) * 24'(fixed_q[11:0])) >> 12);
  end

  // Third: the mantissa of 17 bits and its exponent. Results below 2^-126 are 0.
  logic [16:0] mantissa;
  always_comb begin
    mantissa = first_q - 17'(fall_q);
    if (whole_q >= 126) y = 0;
    else if (mantissa[16]) y = {1'b0, 8'(8'd127 - whole_q), 23'd0};
    else y = {1'b0, 8'(8'd126 - whole_q), mantissa[14:0], 8'd0};
  end

  always_ff @(posedge clk) begin
    fixed_q <= fixed;
    first_q <= first;
    fall_q <= fall;
    whole_q <= fixed_q[23:16];
  end
endmodule
