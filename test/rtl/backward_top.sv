// What BackwardBench.cpp runs: a pair of lanes in the backward mode, and a gather.
module backward_top (
    input  logic         clk, reset, // of a Gaussian
    // Cycle 1: a pixel, and the Gaussian, which stays.
    input  logic         valid,
    input  logic [16:0]  column, row,
    input  logic [287:0] shape,
    input  logic [31:0]  entry,
    input  logic         clamp_stops,
    // Cycle 5: its place again, and its six words.
    input  logic [16:0]  column_5, row_5,
    input  logic [191:0] pixel,
    output logic         writes,
    output logic [63:0]  updated,
    output logic         gives,
    output logic [287:0] given,
    // The gather.
    input  logic [7:0]    gathers, half,
    input  logic [47:0]   rows,
    input  logic [2303:0] terms,
    output logic [7:0]    takes,
    input  logic          ends,
    output logic          done,
    output logic [287:0]  sums
);
  logic reaches, unused_reads, unused_writes, unused_closes;
  logic [31:0] alpha, wanted;
  logic [127:0] unused_pixel;
  lane #(.TRIANGLES(0)) even (
      .clk, .reset, .draws_triangles(1'b0), .valid, .column, .row, .x(6'd0), .y(6'd0), .shape, .tag(32'd0), .compare(3'd0),
      .writes_depth(1'b0), .opacity(shape[191:160]), .reaches, .alpha, .wanted, .reads(unused_reads), .pixel(128'd0),
      .red(32'd0), .green(32'd0), .blue(32'd0), .cutoff(32'd0), .writes(unused_writes), .closes(unused_closes),
      .updated(unused_pixel));
  gradients odd (
      .clk, .reset, .reaches, .alpha, .wanted, .column(column_5), .row(row_5), .mean_x(shape[31:0]), .mean_y(shape[63:32]),
      .red(shape[223:192]), .green(shape[255:224]), .blue(shape[287:256]), .entry, .clamp_stops, .pixel, .writes, .updated,
      .valid(gives), .terms(given));
  gather gathered (.clk, .reset, .valid(gathers), .column(half), .row(rows), .terms, .takes, .ends, .done, .sums);
endmodule
