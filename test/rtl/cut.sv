// Cuts a primitive's box to the tile, one a cycle. The pixels c of a Gaussian's row
// with |c + 0.5 - mean| <= extent, in fp32, are one run: two binary searches
// find how many lie in front of it and how many in front of its end, seven
// cycles of a comparison each.

// A comparison: the count grows by a step if the last pixel of so many still
// counts.
module cut_step (
    input  logic [6:0]  step,
    input  logic [15:0] origin,
    input  logic [31:0] mean, extent,
    input  logic        outside, // count what lies in front of the box
    input  logic [6:0]  count,
    output logic [6:0]  next
);
  /*verilator hier_block*/ // compiled once for all
  logic [6:0] tried;
  logic [31:0] centre, distance;
  logic less, less_equal;
  fp32_centre of (.n(17'(origin) + 17'(tried) - 17'd1), .y(centre));
  fp32_add sub (.a(centre), .b(mean ^ 32'h80000000), .y(distance));
  fp32_compare compare (.a(distance), .b(outside ? extent ^ 32'h80000000 : extent), .less, .less_equal);
  assign tried = count + step;
  assign next = tried <= 64 && (outside ? less : less_equal) ? tried : count;
endmodule

// A cycle: a step of each search.
module cut_cycle #(
    parameter GAUSSIANS = 1,
    parameter BITS = 440
) (
    input  logic [6:0]   step,
    input  logic         clk, reset,
    input  logic         is_triangle, // which is cut already
    input  logic [15:0]  origin_x, origin_y,
    input  logic         valid,
    input  logic [BITS-1:0] shape,
    input  logic [27:0]  counts, // first_x, end_x, first_y, end_y
    output logic         next_valid,
    output logic [BITS-1:0] next_shape,
    output logic [27:0]  next_counts
);
  logic [27:0] next;
  for (genvar side = 0; side < 4; side++) begin : search
    if (GAUSSIANS != 0)
      cut_step one (
          .step,
          .origin(side < 2 ? origin_x : origin_y),
          .mean(shape[32*(side/2)+:32]),
          .extent(shape[288+32*(side/2)+:32]),
          .outside(side % 2 == 0),
          .count(counts[7*side+:7]),
          .next(next[7*side+:7]));
    else assign next[7*side+:7] = counts[7*side+:7];
  end
  always_ff @(posedge clk) begin
    next_valid <= !reset && valid;
    next_shape <= shape;
    next_counts <= is_triangle ? counts : next;
  end
endmodule

// The box of a triangle, in whole pixels.
module cut_pixels (
    input  logic [15:0] origin, first, last,
    output logic [6:0]  begins, ends
);
  logic [15:0] to_first, to_last;
  always_comb begin
    to_first = first - origin;
    to_last = last - origin;
    begins = first < origin ? 7'd0 : to_first > 63 ? 7'd64 : to_first[6:0];
    ends = last < origin ? 7'd0 : to_last > 63 ? 7'd64 : to_last[6:0] + 7'd1;
  end
endmodule

// A primitive as it leaves, from bit 0 in words of 32:
//   Gaussian                         mean x, mean y, conic a, b, c, opacity, red, green, blue
//   triangle                         depth, a0, step x, a1, step y, a2, tag, b0, b1, b2, three corners of 40 bits
//   triangle, edges in fp32          depth, corner 0, a0, a2, b0, a1, tag, b1, b2, step x, step y, corners 1, 2
// Where a multiplier of the power takes a field of both kinds, it is the same.
// A Gaussian takes seven cycles. A triangle takes the first two, and waits with
// the others if there are Gaussians.
module cut #(
    parameter GAUSSIANS = 1,
    parameter TRIANGLES = 1,
    parameter FP_EDGES = 0,
    parameter RECORD_BITS = TRIANGLES != 0 ? 576 : 384,
    parameter BITS = TRIANGLES != 0 ? (FP_EDGES != 0 ? 416 : 440) : 288
) (
    input  logic         clk, reset,
    input  logic         is_triangle,
    input  logic [15:0]  origin_x, origin_y,
    input  logic         valid,
    input  logic [RECORD_BITS-1:0] record, // as memory has it
    output logic         done,
    output logic [BITS-1:0] shape,
    output logic [6:0]   first_x, end_x, first_y, end_y
);
  localparam STAGES = GAUSSIANS != 0 ? 7 : 2;
  localparam HELD = TRIANGLES != 0 ? BITS : 352; // with a Gaussian's extent
  // By cycle, the first is what comes in.
  logic [STAGES:0] valids;
  logic [(STAGES+1)*HELD-1:0] shapes;
  logic [(STAGES+1)*28-1:0] counts;
  assign valids[0] = valid;
  assign shapes[HELD-1:0] = HELD'(record);
  assign counts[27:0] = 0;

  logic [HELD-1:0] restated;
  logic [27:0] box;
  generate
    if (TRIANGLES != 0) begin : kind
      logic [119:0] corner;
      logic [95:0] a, b;
      logic [31:0] depth, step_x, step_y, tag;
      restate #(.FP_EDGES(FP_EDGES)) restates (
          .clk, .valid, .origin_x, .origin_y, .record, .corner, .a, .b, .depth);
      assign step_x = record[447:416];
      assign step_y = record[479:448];
      assign tag = record[575:544];
      if (FP_EDGES != 0)
        assign restated = {corner[95:32], step_y, step_x, b[95:32], tag, a[63:32], b[31:0], a[95:64], a[31:0], corner[31:0], depth};
      else assign restated = {corner, b, tag, a[95:64], step_y, a[63:32], step_x, a[31:0], depth};
      cut_pixels columns (
          .origin(origin_x), .first(record[495:480]), .last(record[527:512]), .begins(box[6:0]), .ends(box[13:7]));
      cut_pixels rows (
          .origin(origin_y), .first(record[511:496]), .last(record[543:528]), .begins(box[20:14]), .ends(box[27:21]));
    end else begin : kind
      assign restated = 0;
      assign box = 0;
    end
    for (genvar s = 0; s < STAGES; s++) begin : cycle
      // A triangle comes in behind its second cycle.
      logic comes;
      assign comes = s == 1 && is_triangle;
      cut_cycle #(.GAUSSIANS(GAUSSIANS), .BITS(HELD)) one (
          .step(7'd64 >> s), .clk, .reset, .is_triangle, .origin_x, .origin_y, .valid(valids[s]),
          .shape(comes ? restated : shapes[HELD*s+:HELD]), .counts(comes ? box : counts[28*s+:28]),
          .next_valid(valids[s+1]), .next_shape(shapes[HELD*(s+1)+:HELD]), .next_counts(counts[28*(s+1)+:28]));
    end
  endgenerate
  assign done = valids[STAGES];
  assign shape = shapes[HELD*STAGES+:BITS];
  assign {end_y, first_y, end_x, first_x} = counts[28*STAGES+:28];
endmodule
