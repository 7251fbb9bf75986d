// A slice of the pixel buffer, with a read and a write port. What is written in
// the cycle of a read is read.
module pixel_bank #(
    parameter BITS = 128
) (
    input  logic         clk,
    input  logic         reads,
    input  logic [7:0]   read_address,
    output logic [BITS-1:0] read_data,
    input  logic         writes,
    input  logic [7:0]   write_address,
    input  logic [BITS-1:0] write_data
);
  logic [BITS-1:0] pixels[256];
  logic [BITS-1:0] stored, passed;
  logic passes;
  assign read_data = passes ? passed : stored;
  always_ff @(posedge clk) begin
    if (writes) pixels[write_address] <= write_data;
    if (reads) stored <= pixels[read_address];
    passes <= writes && reads && write_address == read_address;
    passed <= write_data;
  end
endmodule
