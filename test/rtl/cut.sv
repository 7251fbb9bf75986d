// Cuts a Gaussian's box to the tile, a Gaussian a cycle. The pixels c of a row
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
module cut_cycle (
    input  logic [6:0]   step,
    input  logic         clk, reset,
    input  logic [15:0]  origin_x, origin_y,
    input  logic         valid,
    input  logic [351:0] gaussian,
    input  logic [27:0]  counts, // first_x, end_x, first_y, end_y
    output logic         next_valid,
    output logic [351:0] next_gaussian,
    output logic [27:0]  next_counts
);
  logic [27:0] next;
  for (genvar side = 0; side < 4; side++) begin : search
    cut_step one (
        .step,
        .origin(side < 2 ? origin_x : origin_y),
        .mean(gaussian[32*(side/2)+:32]),
        .extent(gaussian[288+32*(side/2)+:32]),
        .outside(side % 2 == 0),
        .count(counts[7*side+:7]),
        .next(next[7*side+:7]));
  end
  always_ff @(posedge clk) begin
    next_valid <= !reset && valid;
    next_gaussian <= gaussian;
    next_counts <= next;
  end
endmodule

module cut (
    input  logic         clk, reset,
    input  logic [15:0]  origin_x, origin_y,
    input  logic         valid,
    input  logic [351:0] gaussian, // mean, conic, opacity, color, extent: x first
    output logic         done,
    output logic [287:0] cut_gaussian, // without its extent
    output logic [6:0]   first_x, end_x, first_y, end_y
);
  // By cycle, the first is what comes in.
  logic [7:0] valids;
  logic [8*352-1:0] gaussians;
  logic [8*28-1:0] counts;
  assign valids[0] = valid;
  assign gaussians[351:0] = gaussian;
  assign counts[27:0] = 0;
  for (genvar s = 0; s < 7; s++) begin : cycle
    cut_cycle one (
        .step(7'd64 >> s), .clk, .reset, .origin_x, .origin_y, .valid(valids[s]), .gaussian(gaussians[352*s+:352]),
        .counts(counts[28*s+:28]), .next_valid(valids[s+1]), .next_gaussian(gaussians[352*(s+1)+:352]),
        .next_counts(counts[28*(s+1)+:28]));
  end
  assign done = valids[7];
  assign cut_gaussian = gaussians[352*7+:288];
  assign {end_y, first_y, end_x, first_x} = counts[28*7+:28];
endmodule
