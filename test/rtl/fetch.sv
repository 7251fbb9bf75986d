// Fetches the list and the records that it names, at most a line of 64 bytes a
// cycle, as far ahead as the Gaussian buffer has places. Answers come in the
// order of the requests.
module fetch #(
    parameter int ENTRIES = 16
) (
    input  logic         clk, reset,
    input  logic         start, stop, // of a command; its input stays
    input  logic [31:0]  list_at, records, count,
    output logic         quiet, // nothing is under way
    // Memory.
    output logic         request,
    output logic [31:0]  address,
    input  logic         answer,
    input  logic [511:0] line,
    // A record, and the place of one that has been used.
    output logic         valid,
    output logic [351:0] gaussian,
    input  logic         used
);
  // What an answer is: a line of the list, or the first or last of a record.
  typedef enum logic [1:0] {LIST, FIRST, LAST, WHOLE} kind_t;
  logic [3:0] asked[64]; // kind, place in the line or list buffer
  logic [5:0] asked_in, asked_out;

  logic running, second;
  logic [31:0] next, next_list; // Gaussians, lines of the list asked for
  logic [31:0] list_lines; // of them, that are there
  logic [4:0] places;
  logic [511:0] list_buffer[2];
  logic [31:0] entry, entry_address, record, last_line;
  logic [3:0] ask;
  logic [31:0] this_line;

  assign quiet = asked_in == asked_out;

  always_comb begin
    entry_address = list_at + {next[29:0], 2'b00};
    // The line of the list in which the entry lies, counted from the first.
    this_line = (entry_address >> 6) - (list_at >> 6);
    last_line = ((list_at + {count[29:0], 2'b00} - 32'd1) >> 6) - (list_at >> 6);
    entry = list_buffer[this_line[0]][32*entry_address[5:2]+:32];
    record = records + {entry[26:0], 5'd0} + {entry[27:0], 4'd0};
    request = 0;
    address = 0;
    ask = 0;
    if (running && next != count) begin
      if (next_list <= last_line && next_list <= this_line + 32'd1 && !second) begin
        request = 1;
        address = {list_at[31:6] + next_list[25:0], 6'd0};
        ask = {LIST, 1'b0, next_list[0]};
      end else if (this_line < list_lines && (second || places != 0)) begin
        request = 1;
        address = {record[31:6] + 26'(second), 6'd0};
        ask = {second ? LAST : record[5] ? FIRST : WHOLE, record[5:4]};
      end
    end
  end

  // A record of 48 bytes lies in one line, or in two if it begins in the second
  // half of the first.
  logic [383:0] part, whole;
  logic [3:0] told;
  always_comb begin
    told = asked[asked_out];
    whole = 0;
    case (told[3:2])
      WHOLE: whole = told[0] ? line[511:128] : line[383:0];
      LAST: whole = told[0] ? {line[255:0], part[127:0]} : {line[127:0], part[255:0]};
      default: ;
    endcase
  end

  always_ff @(posedge clk) begin
    valid <= 0;
    gaussian <= whole[351:0];
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
        case (ask[3:2])
          LIST: next_list <= next_list + 32'd1;
          FIRST: second <= 1;
          default: begin
            second <= 0;
            next <= next + 32'd1;
          end
        endcase
      end
      places <= places + 5'(used) - 5'(request && (ask[3:2] == FIRST || ask[3:2] == WHOLE));
      if (answer) begin
        asked_out <= asked_out + 6'd1;
        case (told[3:2])
          LIST: begin
            list_buffer[told[0]] <= line;
            list_lines <= list_lines + 32'd1;
          end
          FIRST: part <= told[0] ? {256'd0, line[511:384]} : {128'd0, line[511:256]};
          default: valid <= 1;
        endcase
      end
    end
  end
endmodule
