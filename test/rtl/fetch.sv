// Fetches the list and the records that it names, at most a line of 64 bytes a
// cycle, as far ahead as the Gaussian buffer has places. Answers come in the
// order of the requests.
module fetch #(
    parameter ENTRIES = 16,
    parameter TRIANGLES = 1,
    parameter BITS = TRIANGLES != 0 ? 576 : 384 // of the largest record
) (
    input  logic         clk, reset,
    input  logic         is_triangle, // what records are: of 72 bytes, or of 48
    input  logic         start, stop, // of a command; its input stays
    input  logic [31:0]  list_at, records, count,
    output logic         quiet, // nothing is under way
    // Memory.
    output logic         request,
    output logic [31:0]  address,
    input  logic         answer,
    input  logic [511:0] line,
    // A record, which stays until the next one, and the place of one that has
    // been used.
    output logic         valid,
    output logic [BITS-1:0] record,
    input  logic         used
);
  // What an answer is: a line of the list, or the first or last of a record.
  typedef enum logic [1:0] {LIST, FIRST, LAST, WHOLE} kind_t;
  logic [4:0] asked[64]; // kind, place in the line in eights of bytes, or in the list buffer
  logic [5:0] asked_in, asked_out;

  logic running, second;
  logic [31:0] next, next_list; // Gaussians, lines of the list asked for
  logic [31:0] list_lines; // of them, that are there
  logic [4:0] places;
  logic [511:0] list_buffer[2];
  logic [31:0] entry, entry_address, record_at, last_line;
  logic [4:0] ask;
  logic has_two; // lines
  logic [31:0] this_line;

  assign quiet = asked_in == asked_out;

  always_comb begin
    entry_address = list_at + {next[29:0], 2'b00};
    // The line of the list in which the entry lies, counted from the first.
    this_line = (entry_address >> 6) - (list_at >> 6);
    last_line = ((list_at + {count[29:0], 2'b00} - 32'd1) >> 6) - (list_at >> 6);
    entry = list_buffer[this_line[0]][32*entry_address[5:2]+:32];
    record_at = records + (is_triangle ? {entry[25:0], 6'd0} + {entry[28:0], 3'd0} : {entry[26:0], 5'd0} + {entry[27:0], 4'd0});
    has_two = is_triangle || record_at[5];
    request = 0;
    address = 0;
    ask = 0;
    if (running && next != count) begin
      if (next_list <= last_line && next_list <= this_line + 32'd1 && !second) begin
        request = 1;
        address = {list_at[31:6] + next_list[25:0], 6'd0};
        ask = {LIST, 2'b00, next_list[0]};
      end else if (this_line < list_lines && (second || places != 0)) begin
        request = 1;
        address = {record_at[31:6] + 26'(second), 6'd0};
        ask = {second ? LAST : has_two ? FIRST : WHOLE, record_at[5:3]};
      end
    end
  end

  // A record of 48 bytes lies in one line, or in two if it begins in the second
  // half of the first. One of 72 always has two.
  logic [511:0] part; // the first of two lines, from where the record begins
  logic [BITS-1:0] whole;
  logic [4:0] told;
  generate
    if (TRIANGLES != 0) begin : kind
      logic [1023:0] lines;
      assign lines = {line, told[4:3] == LAST ? part : line};
      always_comb
        case (told[2:0])
          1: whole = lines[639:64];
          2: whole = lines[703:128];
          3: whole = lines[767:192];
          4: whole = lines[831:256];
          5: whole = lines[895:320];
          6: whole = lines[959:384];
          7: whole = lines[1023:448];
          default: whole = lines[575:0];
        endcase
    end else begin : kind
      always_comb
        if (told[4:3] == LAST) whole = told[1] ? {line[255:0], part[511:384]} : {line[127:0], part[511:256]};
        else whole = told[1] ? line[511:128] : line[383:0];
    end
  endgenerate
  assign told = asked[asked_out];

  always_ff @(posedge clk) begin
    valid <= 0;
    if (reset || start) begin
      running <= start;
      second <= 0;
      next <= 0;
      next_list <= 0;
      list_lines <= 0;
      places <= 5'(ENTRIES);
      asked_in <= 0;
      asked_out <= 0;
    end else begin
      if (stop) running <= 0;
      if (request) begin
        asked[asked_in] <= ask;
        asked_in <= asked_in + 6'd1;
        case (ask[4:3])
          LIST: next_list <= next_list + 32'd1;
          FIRST: second <= 1;
          default: begin
            second <= 0;
            next <= next + 32'd1;
          end
        endcase
      end
      places <= places + 5'(used) - 5'(request && (ask[4:3] == FIRST || ask[4:3] == WHOLE));
      if (answer) begin
        asked_out <= asked_out + 6'd1;
        case (told[4:3])
          LIST: begin
            list_buffer[told[0]] <= line;
            list_lines <= list_lines + 32'd1;
          end
          FIRST: part <= line;
          default: begin
            record <= whole;
            valid <= 1;
          end
        endcase
      end
    end
  end
endmodule
