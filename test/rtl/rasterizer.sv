// A rasterizer of Gaussians and triangles that executes one tile command: fetch,
// box cut, the buffer of primitives, dispatch, 16 lanes with a bank of the pixel
// buffer each, and the writing of the tile. docs/rtl.md says what it leaves out.
module rasterizer #(
    parameter ENTRIES = 16, // of the buffer
    // The kinds that it draws, and how a lane computes edges (lane.sv).
    parameter GAUSSIANS = 1,
    parameter TRIANGLES = 1,
    parameter FP_EDGES = 0
) (
    input  logic         clk, reset,
    // A command, which stays until it is done.
    input  logic         start,
    input  logic         draws_triangles,
    input  logic [2:0]   compare, // of the depth test: less, equal, greater
    input  logic         writes_depth,
    input  logic [31:0]  clear_depth,
    input  logic [15:0]  origin_x, origin_y,
    input  logic [6:0]   width, height,
    input  logic [31:0]  cutoff, list_at, records, count, target, pitch,
    output logic         done,
    // Memory: a request a cycle, answers to reads in order.
    output logic         request, writes,
    output logic [31:0]  address,
    output logic [511:0] data,
    output logic [7:0]   parts, // eighths of the line, that are written
    input  logic         answer,
    input  logic [511:0] line,
    // What the cycle went to, for counters.
    output logic [2:0]   state,
    output logic         blends, waits, misses
);
  localparam RECORD_BITS = TRIANGLES != 0 ? 576 : 384;
  localparam SHAPE_BITS = TRIANGLES != 0 ? (FP_EDGES != 0 ? 416 : 440) : 288;
  localparam PIXEL_BITS = GAUSSIANS != 0 ? 128 : 64;
  localparam ENTRY_BITS = SHAPE_BITS + 28;
  localparam logic [2:0] IDLE = 0, TAKE = 1, CLEAR = 2, BLEND = 3, EMPTY = 4, WRITE = 5;
  logic [1:0] taken; // of a command's 15 words, in fours
  logic [5:0] clear_row;
  logic [1:0] clear_column;
  logic [12:0] open; // pixels that are not closed
  logic [31:0] left; // primitives to be dispatched
  logic [5:0] busy; // cycles behind dispatch that hold pixels
  logic begins, is_over, is_triangle;
  assign is_triangle = TRIANGLES != 0 && (GAUSSIANS == 0 || draws_triangles);

  // Fetch, cut and the buffer.
  logic fetched, cut_done, used, quiet, fetch_request;
  logic [31:0] fetch_address;
  logic [RECORD_BITS-1:0] record;
  logic [SHAPE_BITS-1:0] shape;
  logic [6:0] first_x, end_x, first_y, end_y;
  logic [ENTRY_BITS-1:0] buffer[ENTRIES];
  logic [$clog2(ENTRIES)-1:0] buffer_in, buffer_out;
  logic [$clog2(ENTRIES):0] buffered;
  logic [ENTRY_BITS-1:0] head;
  logic [27:0] head_box;
  assign begins = state == TAKE && taken == 3;
  assign is_over = state >= EMPTY || (state == BLEND && open == 0);
  fetch #(.ENTRIES(ENTRIES), .TRIANGLES(TRIANGLES)) fetches (
      .clk, .reset, .is_triangle, .start(begins), .stop(is_over), .list_at, .records, .count, .quiet, .request(fetch_request),
      .address(fetch_address), .answer, .line, .valid(fetched), .record, .used);
  cut #(.GAUSSIANS(GAUSSIANS), .TRIANGLES(TRIANGLES), .FP_EDGES(FP_EDGES)) cuts (
      .clk, .reset(reset || begins), .is_triangle, .origin_x, .origin_y, .valid(fetched), .record, .done(cut_done),
      .shape, .first_x, .end_x, .first_y, .end_y);
  assign head = buffer[buffer_out];
  assign head_box = head[ENTRY_BITS-1-:28];

  // Dispatch. What goes to the lanes takes its primitive along.
  logic [15:0] lanes;
  logic [127:0] rows;
  logic [6:0] tile_end_x, tile_end_y;
  logic [SHAPE_BITS-1:0] shape_1;
  logic [287:160] shape_2, shape_3, shape_4;
  logic [287:192] shape_5;
  logic [127:0] rows_2, rows_3, rows_4, rows_5, rows_6;
  assign tile_end_x = head_box[13:7] < width ? head_box[13:7] : width;
  assign tile_end_y = head_box[27:21] < height ? head_box[27:21] : height;
  dispatch dispatches (
      .clk, .reset(reset || begins), .valid(state == BLEND && buffered != 0 && open != 0), .first_x(head_box[6:0]),
      .end_x(tile_end_x), .first_y(head_box[20:14]), .end_y(tile_end_y), .takes(used), .blends, .waits, .lanes, .rows);
  assign misses = used && !blends;

  // Lanes and banks.
  logic [15:0] reads, lane_writes, closes, line_reads;
  logic [127:0] line_rows;
  logic [16*PIXEL_BITS-1:0] bank_pixels;
  logic [127:0] cleared, lane_rows, written_rows;
  // A triangle's pixel is read and written three cycles earlier.
  assign lane_rows = is_triangle ? rows : rows_4;
  assign written_rows = is_triangle ? rows_3 : rows_6;
  assign cleared = is_triangle ? {64'd0, 32'hffffffff, clear_depth} : {32'h3f800000, 96'd0};
  for (genvar n = 0; n < 16; n++) begin : slice
    logic [5:0] x, y;
    logic [127:0] updated;
    logic reaches; // of the backward mode, which is not here
    logic [31:0] alpha, wanted;
    assign y = rows[8*n+2+:6];
    assign x = {rows[8*n+:2], 4'(4'(n) - {y[1:0], 2'b00})};
    lane #(.GAUSSIANS(GAUSSIANS), .TRIANGLES(TRIANGLES), .FP_EDGES(FP_EDGES)) lane (
        .clk, .reset(reset || begins), .draws_triangles, .valid(lanes[n]), .column(17'(origin_x) + 17'(x)),
        .row(17'(origin_y) + 17'(y)), .x, .y, .shape(shape_1), .tag(shape_2[223:192]), .compare,
        .writes_depth, .opacity(shape_4[191:160]), .reaches, .alpha, .wanted,
        .reads(reads[n]), .pixel(128'(bank_pixels[PIXEL_BITS*n+:PIXEL_BITS])),
        .red(shape_5[223:192]), .green(shape_5[255:224]), .blue(shape_5[287:256]), .cutoff,
        .writes(lane_writes[n]), .closes(closes[n]), .updated);
    pixel_bank #(.BITS(PIXEL_BITS)) bank (
        .clk, .reads(reads[n] || line_reads[n]), .read_address(line_reads[n] ? line_rows[8*n+:8] : lane_rows[8*n+:8]),
        .read_data(bank_pixels[PIXEL_BITS*n+:PIXEL_BITS]), .writes(state == CLEAR || lane_writes[n]),
        .write_address(state == CLEAR ? {clear_row, clear_column} : written_rows[8*n+:8]),
        .write_data(PIXEL_BITS'(state == CLEAR ? cleared : updated)));
  end

  // Writing.
  logic stores, stored;
  logic [31:0] store_address;
  tile_writer #(.GAUSSIANS(GAUSSIANS), .TRIANGLES(TRIANGLES)) writer (
      .clk, .active(state == WRITE), .is_triangle, .width, .height, .target, .pitch, .done(stored), .reads(line_reads),
      .rows(line_rows), .banks(bank_pixels), .writes(stores), .address(store_address), .data, .parts);
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
    shape_1 <= head[SHAPE_BITS-1:0];
    shape_2 <= shape_1[287:160];
    shape_3 <= shape_2;
    shape_4 <= shape_3;
    shape_5 <= shape_4[287:192];
    rows_2 <= rows;
    rows_3 <= rows_2;
    rows_4 <= rows_3;
    rows_5 <= rows_4;
    rows_6 <= rows_5;
    busy <= {busy[4:0], blends};
    open <= open - 13'(closed);
    left <= left - 32'(used);
    if (cut_done) begin
      buffer[buffer_in] <= {end_y, first_y, end_x, first_x, shape};
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
      EMPTY: if ((is_triangle ? !busy[0] : busy[3:0] == 0) || open == 0) state <= WRITE;
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
