// XVorion: the rasterizer as a core's Raster Agent shows it
// (paper, sections "Gaussian rasterizer architecture" and "Software stack").
// 0x7C0 is where Skybox's rasterizer CSRs begin.

let Extension = "xvorion" in {

def VR_STATUS : Csr<"vr_status", 0x7C0, Agent, ReadOnly, 1, "State of the agent's commands; a read that is not busy is an acquire."> {
  let Fields = [CsrField<"busy", 0, 1, "commands are queued or running">,
                CsrField<"tail", 1, 1, "some of these are in the pixel unit">,
                CsrField<"code", 8, 8, "status code of the first failed command since the last vr_wait, 0 if none">];
}
def VR_START : Csr<"vr_start", 0x7C1, Agent, Scalar, 1, "A write queues the bank's content as a command (the value is ignored) and is a release of the core's earlier stores; a full queue stalls the write.">;
def VR_WAIT : Csr<"vr_wait", 0x7C2, Agent, ReadOnly, 1, "A read waits for the agent's commands, is an acquire, returns the status code of the first failed one (0 if none) and clears it.">;
def VR_MODE : BankCsr<"vr_mode", 0x7C3, "Operation of a command."> {
  let Fields = [CsrField<"backward", 0, 1, "0 render, 1 gradients of the rendered tile, read through vr_grad_*">,
                CsrField<"pushed", 1, 1, "0 index list in memory, 1 descriptors pushed with vr_push">,
                CsrField<"drain", 2, 1, "0 pixels are written to vr_output, 1 they are kept for vr_pixel_*">,
                CsrField<"keep_last", 3, 1, "a render stores each pixel's last contributor at vr_last">,
                CsrField<"keep_counts", 4, 1, "a render stores its numbers of Gaussians and fragments at vr_last, 8-byte aligned, two words of at most 2^32 - 1">,
                CsrField<"primitive", 5, 3, "what the records are, VR_PRIMITIVE_*; docs/primitives.md">,
                CsrField<"fragments", 8, 1, "triangles: 0 the nearest of each pixel is written to vr_output, 1 fragments are handed over, VR_GRAD_LANES at a time, read through vr_item">,
                CsrField<"limited", 9, 1, "a render blends into each pixel only the entries before its limit, VR_WORD_LIMIT">,
                CsrField<"from", 10, 1, "a render blends into each pixel only the entries from its first on, VR_WORD_FROM">,
                CsrField<"load", 11, 1, "a render begins with the pixels at vr_output; one whose transmittance has its sign bit set is saturated">,
                CsrField<"keep_saturated", 12, 1, "a render writes the transmittances of saturated pixels with their sign bit set">];
}
def VR_OPTIONS : BankCsr<"vr_options", 0x7C4, "Datapath options."> {
  let Fields = [CsrField<"exp", 0, 4, "exponential unit, VR_EXP_*; docs/lane-units.md#exponential-units">,
                CsrField<"stop_at_equal", 4, 1, "0 saturated at T' < cutoff (INRIA), 1 at T' <= cutoff (gsplat)">,
                CsrField<"skip_saturated", 5, 1, "dispatch gives no lane slot to saturated pixels">,
                CsrField<"blend", 6, 2, "blend arithmetic, VR_BLEND_*; docs/abi.md#rasterizer">,
                CsrField<"alpha_cutoff", 8, 2, "smallest alpha that is blended: 2^value / 255">,
                CsrField<"degree4", 10, 1, "rays: the falloff is exp(-q^2 / 18), not exp(-q / 2)">,
                CsrField<"low_pass", 11, 1, "rays: q is at most 2 (dx^2 + dy^2), the low-pass filter of surfels">];
}
def VR_CUTOFF : BankCsr<"vr_cutoff", 0x7C5, "Transmittance cut-off, float in [0, 1).">;
def VR_GAUSSIANS : BankCsr<"vr_gaussians", 0x7C6, "Address of the records, vx_gaussian or what vr_mode.primitive says, 16-byte aligned.">;
def VR_LIST : BankCsr<"vr_list", 0x7C7, "Address of the depth-sorted list, 4-byte aligned. An entry is the index of a record, with VR_INTERSECT if the Gaussian spans several tiles.">;
def VR_COUNT : BankCsr<"vr_count", 0x7C8, "Entries of the list; 0 is a valid empty tile.">;
def VR_TILE_ORIGIN : BankCsr<"vr_tile_origin", 0x7C9, "Picture coordinates of the tile's first pixel."> {
  let Fields = [CsrField<"x", 0, 16, "column">, CsrField<"y", 16, 16, "row">];
}
def VR_TILE_SHAPE : BankCsr<"vr_tile_shape", 0x7CA, "Pixels of the tile, 1 to 64 each."> {
  let Fields = [CsrField<"width", 0, 16, "columns">, CsrField<"height", 16, 16, "rows">];
}
def VR_ZTILE : BankCsr<"vr_ztile", 0x7CB, "Depth segment of the tile's list."> {
  let Fields = [CsrField<"index", 0, 16, "index of the segment">, CsrField<"count", 16, 16, "number of segments; 0 or 1 for the whole list">];
}
def VR_OUTPUT : BankCsr<"vr_output", 0x7CC, "Address of the tile's first pixel, aligned as a pixel is large: 16 bytes (4 floats: r, g, b, T) or, of triangles, 8 (a vx_visibility).">;
def VR_OUTPUT_PITCH : BankCsr<"vr_output_pitch", 0x7CD, "Bytes from one pixel row to the next, a multiple of a pixel's.">;

// Training (paper, "Training"; docs/rasterizer.md#the-backward-mode).
def VR_LAST : BankCsr<"vr_last", 0x7CE, "Address of the word of the tile's first pixel, 4-byte aligned: number of list entries up to and including the last blended one, 0 if none. Rows are vr_output_pitch / 4 bytes apart. keep_last writes it, backward reads it. With keep_counts, address of the two words.">;
def VR_UPSTREAM : BankCsr<"vr_upstream", 0x7CF, "Backward: address of the gradient of the tile's first pixel (4 floats: dL/dr, dL/dg, dL/db, dL/dT of the final transmittance), 16-byte aligned, rows vr_output_pitch apart.">;
def VR_BACKWARD : BankCsr<"vr_backward", 0x7EB, "Options of the backward mode."> {
  let Fields = [CsrField<"reciprocal", 0, 3, "unit for 1/(1 - alpha), VR_RECIPROCAL_*; docs/lane-units.md#reciprocal-units">,
                CsrField<"clamp_stops", 3, 1, "only the colour has a gradient where alpha is clamped to 0.99 (gsplat)">,
                CsrField<"in_rows", 4, 1, "gather sums the rows of a tile sequentially, not as a tree">];
}

// What one kind of primitive needs (docs/primitives.md): by number and value.
def VR_INDEX : Csr<"vr_index", 0x7EC, Agent, Scalar, 1, "Number of the word that vr_word or vr_item accesses.">;
def VR_WORD : Csr<"vr_word", 0x7ED, Agent, Scalar, 1, "Word vr_index, VR_WORD_*, of the bank. One that does not exist reads as 0, and a write of it does nothing.">;
def VR_ITEM : Csr<"vr_item", 0x7EE, Lane, ReadOnly, 0, "Word vr_index of what the lane has of the batch that vr_grad_next selected: of a fragment VR_ITEM_*, of gradients as vr_grad_tag to vr_grad_syy, and three more of rays, five with low_pass. 0 in lanes without one.">;

// A pushed descriptor: the lane writes its fields, then vr_push.
def VR_G_MEAN_X : Csr<"vr_g_mean_x", 0x7D0, Lane, PerLane, 0, "Float: mean, column.">;
def VR_G_MEAN_Y : Csr<"vr_g_mean_y", 0x7D1, Lane, PerLane, 0, "Float: mean, row.">;
def VR_G_CONIC_A : Csr<"vr_g_conic_a", 0x7D2, Lane, PerLane, 0, "Float: inverse covariance, xx.">;
def VR_G_CONIC_B : Csr<"vr_g_conic_b", 0x7D3, Lane, PerLane, 0, "Float: inverse covariance, xy.">;
def VR_G_CONIC_C : Csr<"vr_g_conic_c", 0x7D4, Lane, PerLane, 0, "Float: inverse covariance, yy.">;
def VR_G_OPACITY : Csr<"vr_g_opacity", 0x7D5, Lane, PerLane, 0, "Float: opacity.">;
def VR_G_RED : Csr<"vr_g_red", 0x7D6, Lane, PerLane, 0, "Float: colour, red.">;
def VR_G_GREEN : Csr<"vr_g_green", 0x7D7, Lane, PerLane, 0, "Float: colour, green.">;
def VR_G_BLUE : Csr<"vr_g_blue", 0x7D8, Lane, PerLane, 0, "Float: colour, blue.">;
def VR_G_EXTENT_X : Csr<"vr_g_extent_x", 0x7D9, Lane, PerLane, 0, "Float: half width of the box.">;
def VR_G_EXTENT_Y : Csr<"vr_g_extent_y", 0x7DA, Lane, PerLane, 0, "Float: half height of the box.">;
def VR_G_TAG : Csr<"vr_g_tag", 0x7DB, Lane, PerLane, 0, "Gaussian index, with VR_INTERSECT if it spans several tiles.">;
def VR_PUSH : Csr<"vr_push", 0x7DC, Agent, Push, 1, "A write appends one descriptor per active lane, in lane order (the value is ignored).">;

// Hand-over of a list's tail to the pixel unit of the cluster (paper, "Pixel
// unit"; docs/rasterizer.md#the-pixel-unit).
def VR_TAIL_COUNT : BankCsr<"vr_tail_count", 0x7E8, "The command is handed over to the pixel unit once at most this number of entries of its list remains; 0 disables this condition.">;
def VR_TAIL_SHARE : BankCsr<"vr_tail_share", 0x7E9, "The command is handed over to the pixel unit once this fraction of the tile's pixels, in units of 1/VR_TAIL_WHOLE, is saturated; 0 disables this condition.">;
def VR_TAIL_RECORD : BankCsr<"vr_tail_record", 0x7EA, "Address of the vx_tail that a hand-over fills, 16-byte aligned; of a command with limited, from or keep_saturated a vx_tail_range follows it. Unused if both conditions are disabled.">;

// Draining a tile by the core that issued it.
def VR_PIXEL_INDEX : Csr<"vr_pixel_index", 0x7E0, Lane, PerLane, 0, "Pixel of the drained tile: row * width + column.">;
def VR_PIXEL_R : Csr<"vr_pixel_r", 0x7E1, Lane, ReadOnly, 0, "Float: red of pixel vr_pixel_index.">;
def VR_PIXEL_G : Csr<"vr_pixel_g", 0x7E2, Lane, ReadOnly, 0, "Float: green of pixel vr_pixel_index.">;
def VR_PIXEL_B : Csr<"vr_pixel_b", 0x7E3, Lane, ReadOnly, 0, "Float: blue of pixel vr_pixel_index.">;
def VR_PIXEL_T : Csr<"vr_pixel_t", 0x7E4, Lane, ReadOnly, 0, "Float: transmittance of pixel vr_pixel_index.">;

// What a backward command hands over, 16 Gaussians at a time, one a lane.
def VR_GRAD_NEXT : Csr<"vr_grad_next", 0x7F0, Agent, ReadOnly, 1, "A read waits for the next batch of the agent's commands that are backward or hand over fragments, and selects it for vr_grad_* and vr_item; 0 at the end of each command, and if none is queued."> {
  let Fields = [CsrField<"count", 0, 5, "Gaussians or fragments of the batch, in lanes 0 to count - 1">,
                CsrField<"batch", 5, 27, "lane i has entry 16 batch + i of the command's list, or of its fragments modulo 2^31">];
}
def VR_GRAD_TAG : Csr<"vr_grad_tag", 0x7F1, Lane, ReadOnly, 0, "Tag of the lane's Gaussian; all vr_grad_* are 0 in lanes without one.">;
def VR_GRAD_R : Csr<"vr_grad_r", 0x7F2, Lane, ReadOnly, 0, "Float: dL/d(red), the sum of alpha T dL/dr over the tile.">;
def VR_GRAD_G : Csr<"vr_grad_g", 0x7F3, Lane, ReadOnly, 0, "Float: dL/d(green).">;
def VR_GRAD_B : Csr<"vr_grad_b", 0x7F4, Lane, ReadOnly, 0, "Float: dL/d(blue).">;
def VR_GRAD_S : Csr<"vr_grad_s", 0x7F5, Lane, ReadOnly, 0, "Float: sum of s = opacity exp(power) dL/dalpha over the tile.">;
def VR_GRAD_SX : Csr<"vr_grad_sx", 0x7F6, Lane, ReadOnly, 0, "Float: sum of s dx, dx from the mean to the pixel.">;
def VR_GRAD_SY : Csr<"vr_grad_sy", 0x7F7, Lane, ReadOnly, 0, "Float: sum of s dy.">;
def VR_GRAD_SXX : Csr<"vr_grad_sxx", 0x7F8, Lane, ReadOnly, 0, "Float: sum of s dx dx.">;
def VR_GRAD_SXY : Csr<"vr_grad_sxy", 0x7F9, Lane, ReadOnly, 0, "Float: sum of s dx dy.">;
def VR_GRAD_SYY : Csr<"vr_grad_syy", 0x7FA, Lane, ReadOnly, 0, "Float: sum of s dy dy.">;
}

// Words of the bank that vr_word accesses.
def : IndexedWord<"depth", 0, "Triangles: depth test."> {
  let Fields = [CsrField<"function", 0, 3, "which fragments pass, VR_DEPTH_*">,
                CsrField<"write", 3, 1, "a fragment that passes replaces the pixel's depth and primitive">,
                CsrField<"load", 4, 1, "the tile begins with the pixels at vr_output; 0: with VR_WORD_DEPTH_CLEAR and VR_NO_PRIMITIVE">,
                CsrField<"integer", 5, 1, "the depth of a fragment is rounded to the nearest integer, ties to even, before the test">];
}
def : IndexedWord<"depth_clear", 1, "Triangles: the depth, a float, with which a tile begins.">;
def : IndexedWord<"limit", 2, "Limited commands: address of the word of the tile's first pixel, 4-byte aligned: number of the first list entry that the pixel does not take. Rows are vr_output_pitch / 4 bytes apart.">;
def : IndexedWord<"limit_first", 3, "Commands with limited or from: number of the first entry at vr_list. Other than 0 where a list is blended in parts.">;
def : IndexedWord<"from", 4, "Commands with from: address of the word of the tile's first pixel, as VR_WORD_LIMIT: number of the first list entry that the pixel takes.">;

// VR_WORD_DEPTH.function: the depth d of a fragment, s of its pixel.
class DepthFunction<string name, int number, string passes>
    : Constant<"VR_DEPTH_" # name, number, "Depth function: " # passes # ".">;
def : DepthFunction<"NEVER", 0, "no fragment passes">;
def : DepthFunction<"LESS", 1, "d < s passes">;
def : DepthFunction<"EQUAL", 2, "d = s passes">;
def : DepthFunction<"LESS_EQUAL", 3, "d <= s passes">;
def : DepthFunction<"GREATER", 4, "d > s passes">;
def : DepthFunction<"NOT_EQUAL", 5, "d != s passes">;
def : DepthFunction<"GREATER_EQUAL", 6, "d >= s passes">;
def : DepthFunction<"ALWAYS", 7, "every fragment passes">;

// Status codes of a command (vr_status.code, vr_wait).
def : Constant<"VR_OK", 0, "Done.">;
def : Constant<"VR_BAD_SHAPE", 1, "vr_tile_shape outside 1 to 64, or a backward, keep_last, limited or from tile of more than VR_MAX_BACKWARD pixels.">;
def : Constant<"VR_MISALIGNED", 2, "An address or the pitch is misaligned.">;
def : Constant<"VR_UNMAPPED", 3, "An address range is not global memory (local memory included).">;
def : Constant<"VR_BAD_COUNT", 4, "vr_count above VR_MAX_COUNT, or more pushes than VR_MAX_PUSHED.">;
def : Constant<"VR_NAN", 5, "A descriptor holds a NaN.">;
def : Constant<"VR_BAD_MODE", 6, "vr_mode, vr_options or vr_ztile requests what this machine does not support.">;
def : Constant<"VR_BAD_CUTOFF", 7, "vr_cutoff is not in [0, 1).">;
def : Constant<"VR_BAD_TAIL", 8, "vr_tail_share above VR_TAIL_WHOLE, or a hand-over is requested for a command that drains, has pushed descriptors, keeps last contributors, is backward or has other records than vx_gaussian.">;
def : Constant<"VR_TAIL_WHOLE", 65536, "vr_tail_share of a whole tile.">;
def : Constant<"VR_INTERSECT", 0x80000000, "Bit of a list entry and of a record's tag: the Gaussian spans several tiles.">;
def : Constant<"VR_MAX_COUNT", 0x1000000, "Largest list of one command.">;
def : Constant<"VR_MAX_PUSHED", 4096, "Capacity of the push buffer in descriptors.">;
def : Constant<"VR_MAX_TILE", 64, "Largest tile width and height.">;
def : Constant<"VR_MAX_BACKWARD", 2048, "Pixels of the largest tile whose pixels take more than four words: backward, keep_last, limited, from.">;
def : Constant<"VR_GRAD_LANES", 16, "Gaussians or fragments of a batch.">;
def : Constant<"VR_NO_PRIMITIVE", 0xFFFFFFFF, "Primitive of a pixel that no triangle covers.">;
def : Constant<"VR_ITEM_PRIMITIVE", 0, "Word of a fragment: the tag of its triangle.">;
def : Constant<"VR_ITEM_PIXEL", 1, "Word of a fragment: column of the picture, and row times 2^16.">;
def : Constant<"VR_ITEM_DEPTH", 2, "Word of a fragment: its depth, a float.">;
