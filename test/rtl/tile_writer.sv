// Writes a tile to memory, the pixels of a line of memory a cycle: reads their
// banks, and a cycle later sends the line.
module tile_writer (
    input  logic         clk,
    input  logic         active, // from its first line on
    input  logic [6:0]   width, height,
    input  logic [31:0]  target, pitch,
    output logic         done,
    // The banks: which are read, and their rows; a cycle later their pixels.
    output logic [15:0]   reads,
    output logic [127:0]  rows,
    input  logic [2047:0] banks,
    // Memory.
    output logic         writes,
    output logic [31:0]  address,
    output logic [511:0] data,
    output logic [3:0]   pixels
);
  logic [6:0] row, column, rest;
  logic [31:0] row_address, here;
  logic [1:0] first, first_q;  // place in the line
  logic [2:0] count, count_q;  // pixels of the line
  logic [3:0] bank, bank_q;    // of the first
  logic [3:0] ahead;
  logic [5:0] x;

  always_comb begin
    here = row_address + {21'd0, column, 4'd0};
    first = here[5:4];
    rest = width - column;
    count = 3'd4 - 3'(first);
    if (rest < 7'(count)) count = rest[2:0];
    bank = column[3:0] + {row[1:0], 2'b00};
    reads = 0;
    rows = 0;
    for (int b = 0; b < 16; b++) begin
      ahead = 4'(b) - bank;
      x = column[5:0] + 6'(ahead);
      reads[b] = active && row != height && ahead < 4'(count);
      rows[8*b+:8] = {row[5:0], x[5:4]};
    end
  end

  always_comb begin
    data = 0;
    pixels = 0;
    for (int i = 0; i < 4; i++)
      if (3'(i) >= 3'(first_q) && 3'(i) < 3'(first_q) + count_q) begin
        pixels[i] = 1;
        for (int b = 0; b < 16; b++)
          if (4'(b) == 4'(bank_q + 4'(i) - 4'(first_q))) data[128*i+:128] = {1'b0, banks[128*b+:127]}; // T without its sign
      end
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
