// Gives the pixels of a box to the lanes, row by row, as many a cycle as have
// banks of their own: pixel (x, y) of the tile has bank x + 4 y modulo 16, and a
// lane serves one bank. A pixel whose last value is still being computed waits
// for it, and the pixels behind it with it.
module dispatch (
    input  logic        clk, reset,
    input  logic        valid, // a Gaussian is there
    input  logic [6:0]  first_x, end_x, first_y, end_y,
    output logic        takes, // the Gaussian's last pixels go, or it has none
    output logic        blends, waits, // what the cycle was, for counters
    // By lane, a cycle later: pixel (x, y) is row {y, x / 16} of its bank.
    output logic [15:0]  lanes,
    output logic [127:0] rows
);
  logic missed, starts, ends, stopped;
  logic [5:0] at_x, at_y, x, y, left, right, bottom;
  logic [15:0] chosen;
  logic [127:0] chosen_rows;
  logic [3:0] bank;
  logic conflict;

  always_comb begin
    missed = first_x >= end_x || first_y >= end_y;
    left = first_x[5:0];
    right = 6'(end_x - 7'd1);
    bottom = 6'(end_y - 7'd1);
    x = starts ? left : at_x;
    y = starts ? first_y[5:0] : at_y;
    chosen = 0;
    chosen_rows = 0;
    stopped = 0;
    ends = 0;
    for (int n = 0; n < 16; n++) begin
      bank = x[3:0] + {y[1:0], 2'b00};
      if (chosen[bank]) stopped = 1;
      if (!stopped) begin
        for (int b = 0; b < 16; b++)
          if (bank == b[3:0]) begin
            chosen[b] = 1;
            chosen_rows[8*b+:8] = {y, x[5:4]};
          end
        if (x != right) x = x + 6'd1;
        else if (y != bottom) begin
          x = left;
          y = y + 6'd1;
        end else begin
          ends = 1;
          stopped = 1;
        end
      end
    end
    conflict = 0;
    for (int b = 0; b < 16; b++)
      if (chosen[b] && lanes[b] && chosen_rows[8*b+:8] == rows[8*b+:8]) conflict = 1;
    waits = valid && !missed && conflict;
    blends = valid && !missed && !conflict;
    takes = valid && (missed || (blends && ends));
  end

  always_ff @(posedge clk) begin
    if (reset) begin
      starts <= 1;
      lanes <= 0;
    end else begin
      lanes <= blends ? chosen : 16'd0;
      rows <= chosen_rows;
      if (takes) starts <= 1;
      else if (blends) starts <= 0;
      if (blends) begin
        at_x <= x;
        at_y <= y;
      end
    end
  end
endmodule
