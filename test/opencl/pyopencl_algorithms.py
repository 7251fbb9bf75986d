#!/usr/bin/python3
"""PyOpenCL's own algorithms on the device against numpy.

They are programs that we did not write: element-wise kernels, reductions, scans with
several kernels and barriers in loops, and a radix sort made of scans.
Exit codes: 0 all agree, 1 some do not, 77 skipped.
"""

import sys
import warnings

try:
    import numpy as np
    import pyopencl as cl
    import pyopencl.array as cla
    from pyopencl.algorithm import RadixSort, copy_if
    from pyopencl.elementwise import ElementwiseKernel
    from pyopencl.reduction import ReductionKernel
    from pyopencl.scan import ExclusiveScanKernel, GenericScanKernel, InclusiveScanKernel
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

warnings.simplefilter("ignore", cl.CompilerWarning)
SIZES = (1, 1000, 20000)


def main():
    platforms = cl.get_platforms()
    if not platforms:
        print("skipped: no OpenCL platform")
        return 77
    context = cl.Context([platforms[0].get_devices()[0]])
    queue = cl.CommandQueue(context)
    random = np.random.default_rng(1)
    failures = 0

    def check(name, agrees):
        nonlocal failures
        failures += not agrees
        print(f"{name}: {'ok' if agrees else 'WRONG'}")

    blend = ElementwiseKernel(context, "float k, float *x, float *y, float *z", "z[i] = k * x[i] + sin(y[i])", "blend")
    total = ReductionKernel(context, np.int32, neutral="0", reduce_expr="a + b", map_expr="x[i]",
                            arguments="__global int *x")
    largest = ReductionKernel(context, np.int32, neutral="-100000", reduce_expr="max(a, b)", map_expr="x[i]",
                              arguments="__global int *x")
    inclusive = InclusiveScanKernel(context, np.int32, "a + b", neutral="0")
    exclusive = ExclusiveScanKernel(context, np.int32, "a + b", neutral="0")
    radix = RadixSort(context, "unsigned int *keys", key_expr="keys[i]", sort_arg_names=["keys"],
                      scan_kernel=GenericScanKernel)

    for n in SIZES:
        x, y = random.random((2, n), dtype=np.float32)
        z = cla.empty(queue, n, np.float32)
        blend(np.float32(2), cla.to_device(queue, x), cla.to_device(queue, y), z)
        check(f"elementwise {n}", np.allclose(z.get(), 2 * x + np.sin(y), rtol=1e-6, atol=0))

        numbers = random.integers(-1000, 1000, n).astype(np.int32)
        device_numbers = cla.to_device(queue, numbers)
        check(f"sum {n}", total(device_numbers).get() == numbers.sum())
        check(f"max {n}", largest(device_numbers).get() == numbers.max())
        scanned = device_numbers.copy()
        inclusive(scanned)
        check(f"inclusive scan {n}", np.array_equal(scanned.get(), np.cumsum(numbers)))
        scanned = device_numbers.copy()
        exclusive(scanned)
        check(f"exclusive scan {n}", np.array_equal(scanned.get(), np.cumsum(numbers) - numbers))
        kept, count, _ = copy_if(device_numbers, "ary[i] > 100")
        check(f"copy if {n}", np.array_equal(kept.get()[: int(count.get())], numbers[numbers > 100]))

        keys = random.integers(0, 2**16, n).astype(np.uint32)
        (ordered,), _ = radix(cla.to_device(queue, keys), key_bits=16)
        check(f"radix sort {n}", np.array_equal(ordered.get(), np.sort(keys)))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
