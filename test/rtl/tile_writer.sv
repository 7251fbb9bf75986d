// Writes a tile to memory, the pixels of a line of memory a cycle: reads their
// banks, and a cycle later sends the line. Pixels have 16 bytes, or 8 in a tile
// of triangles.
module tile_writer #(
    parameter GAUSSIANS = 1,
    parameter TRIANGLES = 1,
    parameter BITS = GAUSSIANS != 0 ? 128 : 64
) (
    input  logic         clk,
    input  logic         active, // from its first line on
    input  logic         is_triangle,
    input  logic [6:0]   width, height,
    input  logic [31:0]  target, pitch,
    output logic         done,
    // The banks: which are read, and their rows; a cycle later their pixels.
    output logic [15:0]   reads,
    output logic [127:0]  rows,
    input  logic [16*BITS-1:0] banks,
    // Memory.
    output logic         writes,
    output logic [31:0]  address,
    output logic [511:0] data,
    output logic [7:0]   parts // eighths of the line, that are written
);
  logic [6:0] row, column, rest;
  logic [31:0] row_address, here;
  logic [2:0] first, first_q;  // place in the line
  logic [3:0] count, count_q;  // pixels of the line
  logic [3:0] bank, bank_q;    // of the first
  logic [3:0] ahead;
  logic [5:0] x;

  always_comb begin
    here = row_address + (is_triangle ? {22'd0, column, 3'd0} : {21'd0, column, 4'd0});
    first = is_triangle ? here[5:3] : {1'b0, here[5:4]};
    rest = width - column;
    count = (is_triangle ? 4'd8 : 4'd4) - 4'(first);
    if (rest < 7'(count)) count = rest[3:0];
    bank = column[3:0] + {row[1:0], 2'b00};
    reads = 0;
    rows = 0;
    for (int b = 0; b < 16; b++) begin
      ahead = 4'(b) - bank;
      x = column[5:0] + 6'(ahead);
      reads[b] = active && row != height && ahead < count;
      rows[8*b+:8] = {row[5:0], x[5:4]};
    end
  end

  // A line of wide pixels, T without its sign, and one of narrow ones.
  logic [511:0] wide, narrow;
  logic [7:0] is_pixel;
  always_comb begin
    wide = 0;
    narrow = 0;
    is_pixel = 0;
    for (int i = 0; i < 8; i++)
      if (3'(i) >= first_q && 4'(i) < 4'(first_q) + count_q) begin
        is_pixel[i] = 1;
        for (int b = 0; b < 16; b++)
          if (4'(b) == 4'(bank_q + 4'(i) - 4'(first_q))) begin
            if (GAUSSIANS != 0 && i < 4) wide[128*i+:128] = 128'(banks[BITS*b+:BITS-1]);
            if (TRIANGLES != 0) narrow[64*i+:64] = banks[BITS*b+:64];
          end
      end
    data = is_triangle ? narrow : wide;
    for (int i = 0; i < 8; i++) parts[i] = is_triangle ? is_pixel[i] : is_pixel[i/2];
    done = active && row == height && !writes;
  end

  always_ff @(posedge clk) begin
    writes <= active && row != height;
    address <= {here[31:6], 6'd0};
    first_q <= first;
    count_q <= count;
    bank_q <= bank;
    if (!active) begin
      row <= 0;
      column <= 0;
      row_address <= target;
    end else if (row != height) begin
      column <= column + 7'(count);
      if (rest == 7'(count)) begin
        column <= 0;
        row <= row + 7'd1;
        row_address <= row_address + pitch;
      end
    end
  end
endmodule
