// A Gaussian rasterizer that executes one tile command: fetch, box cut, Gaussian
// buffer, dispatch, 16 lanes with a bank of the pixel buffer each, and the
// writing of the tile. docs/rtl.md says what it leaves out.
module rasterizer #(
    parameter int ENTRIES = 16 // of the Gaussian buffer
) (
    input  logic         clk, reset,
    // A command, which stays until it is done.
    input  logic         start,
    input  logic [15:0]  origin_x, origin_y,
    input  logic [6:0]   width, height,
    input  logic [31:0]  cutoff, list_at, records, count, target, pitch,
    output logic         done,
    // Memory: a request a cycle, answers to reads in order.
    output logic         request, writes,
    output logic [31:0]  address,
    output logic [511:0] data,
    output logic [3:0]   pixels, // of the line, that are written
    input  logic         answer,
    input  logic [511:0] line,
    // What the cycle went to, for counters.
    output logic [2:0]   state,
    output logic         blends, waits, misses
);
  localparam logic [2:0] IDLE = 0, TAKE = 1, CLEAR = 2, BLEND = 3, EMPTY = 4, WRITE = 5;
  logic [1:0] taken; // of a command's 15 words, in fours
  logic [5:0] clear_row;
  logic [1:0] clear_column;
  logic [12:0] open; // pixels that are not closed
  logic [31:0] left; // Gaussians to be dispatched
  logic [5:0] busy; // cycles behind dispatch that hold pixels
  logic begins, is_over;

  // Fetch, cut and the Gaussian buffer.
  logic fetched, cut_done, used, quiet, fetch_request;
  logic [31:0] fetch_address;
  logic [351:0] gaussian;
  logic [287:0] cut_gaussian;
  logic [6:0] first_x, end_x, first_y, end_y;
  logic [315:0] buffer[ENTRIES];
  logic [$clog2(ENTRIES)-1:0] buffer_in, buffer_out;
  logic [$clog2(ENTRIES):0] buffered;
  logic [315:0] head;
  assign begins = state == TAKE && taken == 3;
  assign is_over = state >= EMPTY || (state == BLEND && open == 0);
  fetch #(.ENTRIES(ENTRIES)) fetches (
      .clk, .reset, .start(begins), .stop(is_over), .list_at, .records, .count, .quiet, .request(fetch_request),
      .address(fetch_address), .answer, .line, .valid(fetched), .gaussian, .used);
  cut cuts (
      .clk, .reset(reset || begins), .origin_x, .origin_y, .valid(fetched), .gaussian, .done(cut_done), .cut_gaussian,
      .first_x, .end_x, .first_y, .end_y);
  assign head = buffer[buffer_out];

  // Dispatch. What goes to the lanes takes its Gaussian along.
  logic [15:0] lanes;
  logic [127:0] rows;
  logic [6:0] tile_end_x, tile_end_y;
  logic [287:0] gaussian_1, gaussian_2, gaussian_3, gaussian_4, gaussian_5;
  logic [127:0] rows_2, rows_3, rows_4, rows_5, rows_6;
  assign tile_end_x = head[301:295] < width ? head[301:295] : width;
  assign tile_end_y = head[315:309] < height ? head[315:309] : height;
  dispatch dispatches (
      .clk, .reset(reset || begins), .valid(state == BLEND && buffered != 0 && open != 0), .first_x(head[294:288]),
      .end_x(tile_end_x), .first_y(head[308:302]), .end_y(tile_end_y), .takes(used), .blends, .waits, .lanes, .rows);
  assign misses = used && !blends;

  // Lanes and banks.
  logic [15:0] reads, lane_writes, closes, line_reads;
  logic [127:0] line_rows;
  logic [2047:0] bank_pixels;
  for (genvar n = 0; n < 16; n++) begin : slice
    logic [5:0] x, y;
    logic [127:0] updated;
    assign y = rows[8*n+2+:6];
    assign x = {rows[8*n+:2], 4'(4'(n) - {y[1:0], 2'b00})};
    lane lane (
        .clk, .reset(reset || begins), .valid(lanes[n]), .column(17'(origin_x) + 17'(x)), .row(17'(origin_y) + 17'(y)),
        .mean_x(gaussian_1[31:0]), .mean_y(gaussian_1[63:32]), .conic_a(gaussian_1[95:64]),
        .conic_b(gaussian_1[127:96]), .conic_c(gaussian_1[159:128]), .opacity(gaussian_4[191:160]), .reads(reads[n]),
        .red(gaussian_5[223:192]), .green(gaussian_5[255:224]), .blue(gaussian_5[287:256]),
        .pixel(bank_pixels[128*n+:128]), .cutoff, .writes(lane_writes[n]), .closes(closes[n]), .updated);
    pixel_bank bank (
        .clk, .reads(reads[n] || line_reads[n]), .read_address(line_reads[n] ? line_rows[8*n+:8] : rows_4[8*n+:8]),
        .read_data(bank_pixels[128*n+:128]), .writes(state == CLEAR || lane_writes[n]),
        .write_address(state == CLEAR ? {clear_row, clear_column} : rows_6[8*n+:8]),
        .write_data(state == CLEAR ? {32'h3f800000, 96'd0} : updated));
  end

  // Writing.
  logic stores, stored;
  logic [31:0] store_address;
  tile_writer writer (
      .clk, .active(state == WRITE), .width, .height, .target, .pitch, .done(stored), .reads(line_reads),
      .rows(line_rows), .banks(bank_pixels), .writes(stores), .address(store_address), .data, .pixels);
  assign writes = stores;
  assign request = stores || fetch_request;
  assign address = stores ? store_address : fetch_address;

  logic [4:0] closed;
  always_comb begin
    closed = 0;
    for (int n = 0; n < 16; n++) closed = closed + 5'(closes[n]);
  end

  always_ff @(posedge clk) begin
    done <= 0;
    gaussian_1 <= head[287:0];
    gaussian_2 <= gaussian_1;
    gaussian_3 <= gaussian_2;
    gaussian_4 <= gaussian_3;
    gaussian_5 <= gaussian_4;
    rows_2 <= rows;
    rows_3 <= rows_2;
    rows_4 <= rows_3;
    rows_5 <= rows_4;
    rows_6 <= rows_5;
    busy <= {busy[4:0], blends};
    open <= open - 13'(closed);
    left <= left - 32'(used);
    if (cut_done) begin
      buffer[buffer_in] <= {end_y, first_y, end_x, first_x, cut_gaussian};
      buffer_in <= buffer_in + 1'b1;
    end
    if (used) buffer_out <= buffer_out + 1'b1;
    buffered <= buffered + 5'(cut_done) - 5'(used);
    case (state)
      IDLE:
      if (start && quiet) begin
        state <= TAKE;
        taken <= 0;
      end
      TAKE: begin
        taken <= taken + 2'd1;
        if (taken == 3) begin
          state <= CLEAR;
          clear_row <= 0;
          clear_column <= 0;
          open <= 13'(width) * 13'(height);
          left <= count;
          buffer_in <= 0;
          buffer_out <= 0;
          buffered <= 0;
          busy <= 0;
        end
      end
      CLEAR: begin
        clear_column <= clear_column + 2'd1;
        if (7'({clear_column, 4'd15}) >= 7'(width - 7'd1)) begin
          clear_column <= 0;
          clear_row <= clear_row + 6'd1;
          if (7'(clear_row) == height - 7'd1) state <= count == 0 ? WRITE : BLEND;
        end
      end
      BLEND: if (open == 0 || left == 32'(used)) state <= EMPTY;
      EMPTY: if (busy[3:0] == 0 || open == 0) state <= WRITE;
      WRITE:
      if (stored) begin
        state <= IDLE;
        done <= 1;
      end
      default: ;
    endcase
    if (reset) begin
      state <= IDLE;
      done <= 0;
    end
  end
endmodule
