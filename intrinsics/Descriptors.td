// Structures in device memory that more than one component reads or writes,
// and the numbers of the memory map (docs/abi.md).

def VxGaussian : Descriptor<"vx_gaussian", [
    DescField<"mean", "f32", 2, "centre in pixels; sample points are pixel centres (+0.5)">,
    DescField<"conic", "f32", 3, "inverse covariance a (xx), b (xy), c (yy), 1/px^2">,
    DescField<"opacity", "f32", 1, "0 to 1">,
    DescField<"color", "f32", 3, "linear r, g, b">,
    DescField<"extent", "f32", 2, "half width and height of the box, px">,
    DescField<"tag", "u32", 1, "Gaussian index, with VR_INTERSECT if it spans several tiles">
  ], "One projected Gaussian as the rasterizer reads it.">;

def VxRayGaussian : Descriptor<"vx_ray_gaussian", [
    DescField<"first", "u32", 1, "first pixel of the box: column, and row times 2^16">,
    DescField<"last", "u32", 1, "last pixel of the box, likewise">,
    DescField<"mean", "f32", 2, "where the ray through the centre passes, px from the centre of pixel first">,
    DescField<"factor", "f32", 3, "a, b, c: (a dx + b dy)^2 + (c dy)^2 is the square of the distance at which parallel rays pass the centre, in standard deviations">,
    DescField<"slope", "f32", 2, "of the plane l, which is 1 at the mean, along columns and rows, 1/px">,
    DescField<"near", "f32", 1, "1 over the square of the distance of the point where all rays begin; 0 for parallel rays, and for discs">,
    DescField<"opacity", "f32", 1, "0 to 1">,
    DescField<"color", "f32", 3, "linear r, g, b">,
    DescField<"tag", "u32", 1, "Gaussian index, with VR_INTERSECT if it spans several tiles">,
    DescField<"unused", "u32", 1, "not read: a record is a line of memory">
  ], "One Gaussian as rays meet it (docs/primitives.md#rays).">;

def VxTriangle : Descriptor<"vx_triangle", [
    DescField<"a", "i32", 3, "of each edge: step of its function from a pixel to the next of the row">,
    DescField<"b", "i32", 3, "step from a row to the next">,
    DescField<"c_low", "u32", 3, "value at pixel (0, 0) of the picture, low word; the pixel is covered where none is negative">,
    DescField<"c_high", "i32", 3, "high word">,
    DescField<"depth", "f32", 1, "depth at pixel first">,
    DescField<"depth_step", "f32", 2, "of the depth, from a pixel to the next of the row, from a row to the next">,
    DescField<"first", "u32", 1, "first pixel of the box: column, and row times 2^16">,
    DescField<"last", "u32", 1, "last pixel of the box, likewise">,
    DescField<"tag", "u32", 1, "primitive ID">
  ], "One triangle as the rasterizer reads it (docs/primitives.md).">;

def VxVisibility : Descriptor<"vx_visibility", [
    DescField<"depth", "f32", 1, "of the nearest triangle, or VR_WORD_DEPTH_CLEAR">,
    DescField<"primitive", "u32", 1, "its tag, or VR_NO_PRIMITIVE">
  ], "A pixel of triangles.">;

def VxTail : Descriptor<"vx_tail", [
    DescField<"list", "u32", 1, "address of the list's next entry">,
    DescField<"count", "u32", 1, "remaining entries">,
    DescField<"gaussians", "u32", 1, "address of the vx_gaussian records">,
    DescField<"options", "u32", 1, "vr_options">,
    DescField<"cutoff", "u32", 1, "vr_cutoff">,
    DescField<"tile_origin", "u32", 1, "vr_tile_origin">,
    DescField<"tile_shape", "u32", 1, "vr_tile_shape">,
    DescField<"ztile", "u32", 1, "vr_ztile">,
    DescField<"output", "u32", 1, "address of the tile's first pixel, with the state of the pixels">,
    DescField<"output_pitch", "u32", 1, "vr_output_pitch">,
    DescField<"core", "u32", 1, "core whose Raster Agent is notified of the end">,
    DescField<"live_count", "u32", 1, "pixels that may take more">,
    DescField<"live", "u32", 128, "one bit per pixel: column x of row y is bit x % 32 of word 2 y + x / 32">
  ], "Hand-over of a tile to the pixel unit: the rest of its list and its live pixels.">;

def VxTailRange : Descriptor<"vx_tail_range", [
    DescField<"mode", "u32", 1, "limited, from and keep_saturated of vr_mode">,
    DescField<"limit", "u32", 1, "VR_WORD_LIMIT">,
    DescField<"limit_first", "u32", 1, "VR_WORD_LIMIT_FIRST: number of the list's next entry">,
    DescField<"from", "u32", 1, "VR_WORD_FROM">
  ], "Follows a vx_tail whose pixels take ranges of the list, or keep that they are saturated.">;

def VxLaunch : Descriptor<"vx_launch", [
    DescField<"entry", "u32", 1, "work-group function">,
    DescField<"args", "u32", 1, "packed arguments">,
    DescField<"work_dim", "u32", 1, "1 to 3">,
    DescField<"num_groups", "u32", 3, "groups along x, y, z">,
    DescField<"local_size", "u32", 3, "work-items of a group along x, y, z">,
    DescField<"global_offset", "u32", 3, "offset of the global ids">,
    DescField<"context", "u32", 1, "memory for values that live across barriers">,
    DescField<"context_stride", "u32", 1, "bytes of it for each core">,
    DescField<"print_buffer", "u32", 1, "vx_print, followed by the text of printf">,
    DescField<"print_capacity", "u32", 1, "maximum bytes of the text">,
    DescField<"stack_bytes", "u32", 1, "stack of each lane, a power of two; 0 for the machine's default">,
    DescField<"variables", "u32", 1, "program-scope variables, 0 for none">,
    DescField<"enqueued_size", "u32", 3, "work-items of a group of the whole range, except the last">,
    DescField<"groups_before", "u32", 3, "groups of the whole range before the first of the launch">,
    DescField<"all_groups", "u32", 3, "groups of the whole range">,
    DescField<"global_size", "u32", 3, "work-items of the whole range">,
    DescField<"warps", "u32", 1, "warps of each core that run groups, whose launch blocks follow each other">,
    DescField<"local_stride", "u32", 1, "bytes from the local memory of a warp to that of the next">
  ], "Launch block of a warp (mscratch points to that of warp 0).">;

def VxPrint : Descriptor<"vx_print", [
    DescField<"used", "u32", 1, "bytes requested so far; text beyond the capacity was dropped">
  ], "Head of the print buffer, the part of the launch data that kernels write.">;

def VxKernel : Descriptor<"vx_kernel", [
    DescField<"name", "u32", 1, "address of the NUL-terminated name">,
    DescField<"entry", "u32", 1, "work-group function">,
    DescField<"args", "u32", 1, "address of num_args vx_kernel_arg">,
    DescField<"num_args", "u32", 1, "arguments">,
    DescField<"args_bytes", "u32", 1, "size of the packed arguments">,
    DescField<"context_bytes", "u32", 1, "bytes a work-item keeps across barriers">,
    DescField<"local_bytes", "u32", 1, "static local memory, from 0xffff0000 on">,
    DescField<"local_size", "u32", 3, "the group size it was compiled for, 0 for any">,
    DescField<"lanes", "u32", 1, "the lanes of a warp it was compiled for, 0 for any">,
    DescField<"stack_bytes", "u32", 1, "stack required by its deepest call path; written by vorion-link, 0 if unknown">
  ], "One kernel of a program, in section vorion_kernels.">;

def VxStack : Descriptor<"vx_stack", [
    DescField<"function", "u32", 1, "its address">,
    DescField<"frame_bytes", "u32", 1, "size of its own frame">,
    DescField<"flags", "u32", 1, "VX_STACK_*">,
    DescField<"num_callees", "u32", 1, "number of callees, whose addresses follow">
  ], "Stack use of a function, in section vorion_stacks.">;

def VxVariables : Descriptor<"vx_variables", [
    DescField<"entry", "u32", 1, "work-group function of the kernel">,
    DescField<"bytes", "u32", 1, "size of all variables">,
    DescField<"alignment", "u32", 1, "alignment of their address, a power of two">,
    DescField<"contents", "u32", 1, "address of the initial bytes; zeros follow these">,
    DescField<"contents_bytes", "u32", 1, "number of initial bytes">,
    DescField<"pointers", "u32", 1, "address of num_pointers offsets of words">,
    DescField<"num_pointers", "u32", 1, "words to which the variables' address is added">
  ], "The program-scope variables of a kernel that uses them, in section vorion_variables.">;

def VxKernelArg : Descriptor<"vx_kernel_arg", [
    DescField<"name", "u32", 1, "address of the NUL-terminated name">,
    DescField<"kind", "u32", 1, "one of VX_ARG_*">,
    DescField<"offset", "u32", 1, "bytes from the start of the packed arguments">,
    DescField<"size", "u32", 1, "size in bytes">
  ], "One argument of a kernel.">;

def : Constant<"VX_ARG_VALUE", 0, "Passed by value, of unspecified type.">;
def : Constant<"VX_ARG_GLOBAL", 1, "Pointer to global or constant memory.">;
def : Constant<"VX_ARG_LOCAL", 2, "Pointer to local memory; the driver allocates it.">;
def : Constant<"VX_ARG_INTEGER", 3, "Integer, passed by value.">;
def : Constant<"VX_ARG_FLOAT", 4, "32-bit float, passed by value.">;

def : Constant<"VX_STACK_INDIRECT", 1, "The function calls through pointers.">;
def : Constant<"VX_STACK_REPEATS", 2, "The size of its frame depends on the run.">;
def : Constant<"VX_STACK_ADDRESS_TAKEN", 4, "Calls through pointers may reach it.">;

def : Constant<"VX_IO_CONSOLE", 0x40, "Store: a byte for the console.">;
def : Constant<"VX_IO_EXIT", 0x44, "Store: exit code.">;
def : Constant<"VX_IO_RASTER", 0x1000, "Raster CSRs of core 0; VX_IO_RASTER_STRIDE bytes per core.">;
def : Constant<"VX_IO_RASTER_STRIDE", 0x100, "Bytes of the I/O window per core.">;
def : Constant<"VX_GLOBAL_BASE", 0x10000, "First byte of global memory.">;
def : Constant<"VX_IMAGE_BASE", 0x80000000, "First byte of the program image.">;
def : Constant<"VX_IMAGE_SIZE", 0x1000000, "Largest program image.">;
def : Constant<"VX_HIGH_BASE", 0x81000000, "First byte after the image: global memory that does not fit below it.">;
def : Constant<"VX_STACK_TOP", 0xFFFF0000, "End of the stacks.">;
def : Constant<"VX_REPEAT_BYTES", 0x8000, "Stack reserved for recursion and calls through pointers.">;
def : Constant<"VX_MAX_STACK", 0x1000000, "Largest stack of a lane.">;
def : Constant<"VX_MAX_STACK_ROOM", 0xe20000, "Usable part of it: start-up code leaves up to 15/128 unused.">;
def : Constant<"VX_LOCAL_BASE", 0xFFFF0000, "First byte of local memory.">;
