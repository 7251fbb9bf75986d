// CSRs that are not the rasterizer's.

let HasIntrinsic = 0, Extension = "zicsr" in {
def CSR_FFLAGS : Csr<"fflags", 0x001, Warp, Scalar, 1, "Accrued floating-point exceptions: the OR over active lanes.">;
def CSR_FRM : Csr<"frm", 0x002, Warp, Scalar, 1, "Floating-point rounding mode.">;
def CSR_FCSR : Csr<"fcsr", 0x003, Warp, Scalar, 1, "frm and fflags together.">;
def CSR_MCYCLE : Csr<"mcycle", 0xB00, Core, ReadOnly, 1, "Retired warp instructions of the core, low word (results never depend on time).">;
def CSR_MINSTRET : Csr<"minstret", 0xB02, Core, ReadOnly, 1, "As mcycle.">;
def CSR_MCYCLEH : Csr<"mcycleh", 0xB80, Core, ReadOnly, 1, "High word of mcycle.">;
def CSR_MINSTRETH : Csr<"minstreth", 0xB82, Core, ReadOnly, 1, "High word of minstret.">;
def CSR_CYCLE : Csr<"cycle", 0xC00, Core, ReadOnly, 1, "As mcycle (Zicntr).">;
def CSR_TIME : Csr<"time", 0xC01, Core, ReadOnly, 1, "As mcycle (Zicntr).">;
def CSR_INSTRET : Csr<"instret", 0xC02, Core, ReadOnly, 1, "As mcycle (Zicntr).">;
def CSR_CYCLEH : Csr<"cycleh", 0xC80, Core, ReadOnly, 1, "High word of cycle.">;
def CSR_TIMEH : Csr<"timeh", 0xC81, Core, ReadOnly, 1, "High word of time.">;
def CSR_INSTRETH : Csr<"instreth", 0xC82, Core, ReadOnly, 1, "High word of instret.">;
def CSR_MHARTID : Csr<"mhartid", 0xF14, Lane, ReadOnly, 0, "(core * warps + warp) * lanes + lane.">;
}

let Extension = "zicsr" in
def CSR_MSCRATCH : Csr<"mscratch", 0x340, Core, Scalar, 1, "Address of the launch block, 0 if there is none.">;

def CSR_LOCAL_OFFSET : Csr<"vx_local_offset", 0x8C0, Warp, Scalar, 1, "Offset of the warp's local memory in that of its core, in bytes: a multiple of 128, modulo the size of the core's. 0 at reset.">;
def CSR_THREAD_ID : Csr<"vx_thread_id", 0xCC0, Lane, ReadOnly, 0, "Lane number within the warp.">;
def CSR_WARP_ID : Csr<"vx_warp_id", 0xCC1, Warp, ReadOnly, 1, "Warp number within the core.">;
def CSR_CORE_ID : Csr<"vx_core_id", 0xCC2, Core, ReadOnly, 1, "Core number within the device.">;
def CSR_ACTIVE_WARPS : Csr<"vx_active_warps", 0xCC3, Core, ReadOnly, 1, "Mask of the core's warps that have not ended.">;
def CSR_ACTIVE_THREADS : Csr<"vx_active_threads", 0xCC4, Warp, ReadOnly, 1, "The warp's thread mask.">;
def CSR_NUM_THREADS : Csr<"vx_num_threads", 0xFC0, Device, ReadOnly, 1, "Lanes per warp.">;
def CSR_NUM_WARPS : Csr<"vx_num_warps", 0xFC1, Device, ReadOnly, 1, "Warps per core.">;
def CSR_NUM_CORES : Csr<"vx_num_cores", 0xFC2, Device, ReadOnly, 1, "Cores of the device.">;
def CSR_LOCAL_BASE : Csr<"vx_local_base", 0xFC3, Core, ReadOnly, 1, "Address of local memory.">;
def CSR_NUM_BARRIERS : Csr<"vx_num_barriers", 0xFC4, Device, ReadOnly, 1, "Barriers per core.">;
def CSR_NUM_SOCKETS : Csr<"vx_num_sockets", 0xFC6, Device, ReadOnly, 1, "Sockets of the device, each with one rasterizer and the same number of cores, which are numbered socket by socket.">;
def CSR_NUM_CLUSTERS : Csr<"vx_num_clusters", 0xFC7, Device, ReadOnly, 1, "Clusters of the device, each with one pixel unit and the same number of sockets.">;
def CSR_STACK_SIZE : Csr<"vx_stack_size", 0xFC5, Device, ReadOnly, 1, "Bytes of stack per lane, by which the start-up code places stacks.">;
