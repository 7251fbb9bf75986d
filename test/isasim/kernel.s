# A kernel with buffers and values, launched from the command line and from
# JSON: out[i] = a[i] * k.
# REQUIRES: vorion-mc, vorion-sim
# RUN: sh %S/Inputs/assemble.sh %build %s %t.elf
# RUN: vorion-sim %t.elf --list-kernels | FileCheck %s --check-prefix=LIST
# LIST: scale(global a[4], global out[4], value k[4], local scratch[4])
# RUN: %python -c 'import struct,sys; sys.stdout.buffer.write(struct.pack("<100i", *range(100)))' > %t.in
# RUN: vorion-sim %t.elf --kernel scale --global 100 --local 20 --arg buf@%t.in --arg out:400@%t.out --arg i32:-3 --arg local:64
# RUN: %python -c 'import struct,sys; assert struct.unpack("<100i", open(sys.argv[1], "rb").read()) == tuple(-3 * i for i in range(100))' %t.out
# RUN: echo '{"global": [100], "local": [25], "args": ["inout:%t.in@%t.same", "out:400@%t.out2", "u32:5", "local:64"]}' > %t.json
# RUN: vorion-sim %t.elf --args %t.json --stats %t.stats
# RUN: %python -c 'import struct,sys; assert struct.unpack("<100i", open(sys.argv[1], "rb").read()) == tuple(5 * i for i in range(100))' %t.out2
# RUN: cmp %t.in %t.same

# What does not fit the kernel is said in one line, with exit code 2.
# RUN: sh -c 'vorion-sim %t.elf --global 100 --arg i32:1 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s --check-prefix=COUNT < %t.err
# COUNT: vorion-sim: error: 1 argument, expected 4 for kernel 'scale': a (a buffer), out (a buffer), k (a value), scratch (local memory){{$}}
# COUNT-NEXT: exit 2
# RUN: not vorion-sim %t.elf --kernel mul --global 100 2>&1 | FileCheck %s --check-prefix=NAME
# NAME: no kernel 'mul', expected one of: scale
# RUN: not vorion-sim %t.elf --global 100 --local 30 2>&1 | FileCheck %s --check-prefix=MULTIPLE
# MULTIPLE: --global 100 is not a multiple of --local 30 in dimension 0
# RUN: not vorion-sim %t.elf --global 100 --arg i32:1 --arg out:400@%t.o --arg i32:1 --arg local:4 2>&1 | FileCheck %s --check-prefix=KIND
# KIND: argument 0 of 'scale' (a) is 'i32:1', expected a buffer
# RUN: not vorion-sim %t.elf --global 100 --arg buf:400 --arg out:400@%t.o --arg i32:1 --arg local:99999 2>&1 | FileCheck %s --check-prefix=LOCAL
# LOCAL: needs more than 32768 bytes of local memory
# RUN: sh -c 'vorion-sim %t.elf --global 100 --arg buf:4000000000 --arg out:400@%t.o --arg i32:1 --arg local:9 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s --check-prefix=FULL < %t.err
# FULL: buffer 'a': 4000000000 bytes, more than the largest free block of the 4269670400 bytes of global memory
# FULL-NEXT: exit 5
# RUN: not vorion-sim %t.elf --global 100 --arg buf@%t.none --arg out:400@%t.o --arg i32:1 --arg local:9 2>&1 | FileCheck %s --check-prefix=NOFILE
# NOFILE: {{.*}}.none: cannot open: No such file or directory
# RUN: not vorion-sim %t.elf --arg i32:1 2>&1 | FileCheck %s --check-prefix=GLOBAL
# GLOBAL: vorion-sim: error: --global is missing, expected X[,Y[,Z]], the number of work-items
# RUN: sh -c 'vorion-sim %t.elf 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s --check-prefix=ALONE < %t.err
# ALONE: vorion-sim: error: --global is missing, expected X[,Y[,Z]], the number of work-items
# ALONE-NEXT: exit 2

# A kernel for warps of 8 lanes runs on such a machine and on no other.
# RUN: sh %S/Inputs/assemble.sh %build %s %t.8.elf --defsym=LANES=8
# RUN: echo '{"lanes_per_warp": 8}' > %t.8.config
# RUN: vorion-sim %t.8.elf --config %t.8.config --global 100 --local 20 --arg buf@%t.in --arg out:400@%t.out8 --arg i32:-3 --arg local:64
# RUN: cmp %t.out %t.out8
# RUN: sh -c 'vorion-sim %t.8.elf --global 100 --arg buf:400 --arg out:400@%t.never --arg i32:1 --arg local:9 2> %t.err; echo "exit $?" >> %t.err'
# RUN: FileCheck %s --check-prefix=LANES < %t.err
# LANES: vorion-sim: error: {{.*}}.8.elf: kernel 'scale' was compiled for warps of 8 lanes, expected 16 as in the machine
# LANES-NEXT: exit 3

# A kernel that traps leaves no output file.
# RUN: not vorion-sim %t.elf --global 100 --arg buf:8 --arg out:400@%t.never --arg i32:1 --arg local:9 --set max_instructions=20
# RUN: not ls %t.never

  .section .text.vorion_start, "ax", @progbits
  .globl _start
_start:
  csrr t0, vx_num_threads
  neg t0, t0
  li t1, -1
  srl t1, t1, t0
  vx_tmc t1
  csrr s1, mscratch
  lw s4, 12(s1)         # groups along x
  csrr s7, vx_core_id
  csrr s8, vx_num_cores
next:
  bgeu s7, s4, done
  lw a0, 4(s1)          # arguments
  mv a1, s1
  mv a2, s7
  lw t0, 0(s1)          # entry
  jalr t0
  add s7, s7, s8
  j next
done:
  vx_tmc zero

  .text
  .type scale, @function
scale:
  lw t0, 24(a1)         # work-items of a group
  mul t1, a2, t0        # the group's first
  add t0, t0, t1
  csrr t2, vx_thread_id
  add t1, t1, t2        # mine
  lw t3, 0(a0)
  lw t4, 4(a0)
  lw t5, 8(a0)
  lw t6, 12(a0)
  lui a3, 0xffff0
  sltu a3, t6, a3       # the local argument lies above 0xffff0000
  sw a3, 0x44(zero)
  csrr a7, vx_active_threads
1:
  sltu a3, t1, t0
  vx_vote_any a4, a3
  beqz a4, 2f
  vx_split a5, a3
  beqz a3, 3f
  sh2add a4, t1, t3
  lw a4, 0(a4)
  mul a4, a4, t5
  sh2add a6, t1, t4
  sw a4, 0(a6)
3:
  vx_join a5
  csrr a4, vx_num_threads
  add t1, t1, a4
  j 1b
2:
  ret

  .section .rodata
name: .asciz "scale"
na: .asciz "a"
nout: .asciz "out"
nk: .asciz "k"
nl: .asciz "scratch"
  .balign 4
args:
  .word na, 1, 0, 4
  .word nout, 1, 4, 4
  .word nk, 0, 8, 4
  .word nl, 2, 12, 4
  .ifndef LANES
  .set LANES, 0
  .endif
  .section vorion_kernels, "a", @progbits
  .word name, scale, args, 4, 16, 0, 0, 0, 0, 0, LANES, 0
