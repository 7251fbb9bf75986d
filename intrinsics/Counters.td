// What the machine counts: of cores, and of the Raster Agents' completed
// commands with the pixel units' part of them. Structures, sums, CSRs, tables,
// JSON, driver and OpenCL follow from a record; docs/adding-a-counter.md.

def WarpInstructions : CoreCounter<"warp_instructions", 0x4F60, "warp instructions retired">;
def LaneInstructions : CoreCounter<"lane_instructions", 0x4F61, "the same, multiplied by active lanes">;
def Loads : CoreCounter<"loads", 0, "warp instructions that load">;
def Stores : CoreCounter<"stores", 0, "warp instructions that store">;
def Atomics : CoreCounter<"atomics", 0, "atomic warp instructions">;
def Splits : CoreCounter<"splits", 0, "vx_split and vx_pred, and their negations">;
def DivergentSplits : CoreCounter<"divergent_splits", 0, "of these, those that divided the lanes">;
def Parks : CoreCounter<"parks", 0, "operations that waited for all cores to be parked">;

defm VR_N_COMMANDS : RasterCounter<"commands", 0xFD0, 0x4F62, "tile commands">;
defm VR_N_GAUSSIANS : RasterCounter<"gaussians", 0xFD1, 0x4F63, "Gaussians fetched">;
defm VR_N_CLIPPED : RasterCounter<"clipped", 0xFD2, 0x4F64, "of these, those whose box misses the tile">;
defm VR_N_FRAGMENTS : RasterCounter<"fragments", 0xFD3, 0x4F65, "lane slots dispatched">;
defm VR_N_BLENDS : RasterCounter<"blends", 0xFD4, 0x4F66, "of these, blended into a pixel">;
defm VR_N_INTERSECTING : RasterCounter<"intersecting", 0xFD5, 0x4F67, "Gaussians fetched that span several tiles">;
defm VR_N_TAILS : RasterCounter<"tails", 0xFE0, 0x4F68, "commands handed over to a pixel unit">;
defm VR_N_TAIL_PIXELS : RasterCounter<"tail_pixels", 0xFE1, 0x4F69, "pixels handed over">;
defm VR_N_TAIL_VISITS : RasterCounter<"tail_visits", 0xFE2, 0x4F6A, "Gaussians examined by these">;
defm VR_N_TAIL_BLENDS : RasterCounter<"tail_blends", 0xFE3, 0x4F6B, "of these, blended">;
