// Atomics and races: what is one, and what is none.
// REQUIRES: vorion-clang, vorion-cl-link, vorion-device, vorion-sim
// RUN: vorion-clang -cl-std=CL3.0 -g %s -o %t.elf
// The table of atomic loads and stores takes no memory of the machine.
// RUN: llvm-readelf-19 -S %t.elf | FileCheck %s --check-prefix=TABLE
// TABLE: vorion_atomics PROGBITS 00000000 {{[0-9a-f]+ [0-9a-f]+}} 00 {{ *}}WL 

// Loads and stores that are atomic race with nothing atomic, and hand over what was written before. So do loops around a
// compare-exchange, the program's own and those that the compiler makes of atomics of 64 bits.
// RUN: vorion-sim %t.elf --kernel flag --global 64 --local 16 --arg buf:64 --arg buf:64 --check race
// RUN: vorion-sim %t.elf --kernel counted --global 64 --local 16 --arg buf:64 --arg buf:256 --check race
// RUN: vorion-sim %t.elf --kernel wide --global 64 --local 16 --arg buf:64 --check race
// RUN: vorion-sim %t.elf --kernel sum --global 64 --local 16 --arg buf:64 --check race
// A compare-exchange that fails writes nothing.
// RUN: vorion-sim %t.elf --kernel first --global 16 --local 16 --arg buf:64 --arg buf:64 --check race

// A store and the atomics of other lanes, whichever comes first, though the lane that stores has an atomic in between.
// RUN: not vorion-sim %t.elf --kernel store_before --global 4 --local 4 --arg buf:64 --check race 2>&1 | FileCheck %s --check-prefix=BEFORE
// BEFORE: (store_before): atomic at {{.*}} is not ordered with the store by core 0, warp 0, lane 0 of the same group
// RUN: not vorion-sim %t.elf --kernel load_after --global 4 --local 4 --arg buf:64 --arg buf:64 --check race 2>&1 | FileCheck %s --check-prefix=AFTER
// AFTER: (load_after): load at {{.*}} is not ordered with the atomic by core 0, warp 0, lane {{[0-2]}} of the same group
// A plain load of what others change by a compare-exchange.
// RUN: not vorion-sim %t.elf --kernel peek --global 16 --local 16 --arg buf:64 --arg buf:256 --check race 2>&1 | FileCheck %s --check-prefix=PEEK
// PEEK: (peek): {{load|atomic}} at {{.*}} is not ordered with the {{load|atomic}} by core 0, warp 0, lane {{[0-9]+}} of the same group

// All groups read before one of them writes. Its own load is the last one.
// RUN: not vorion-sim %t.elf --kernel read_by_all --global 2 --local 1 --arg buf:64 --arg buf:64 --check race 2>&1 | FileCheck %s --check-prefix=ALL
// ALL: (read_by_all): {{load|store}} at {{.*}} is not ordered with the {{load|store}}

kernel void flag(global atomic_int *f, global int *out) {
  if (get_global_id(0) == 0) {
    out[0] = 7;
    atomic_store_explicit(f, 1, memory_order_release, memory_scope_device);
  }
  if (get_global_id(0) == get_global_size(0) - 1) {
    for (int n = 0; n < 10000; n++)
      if (atomic_load_explicit(f, memory_order_acquire, memory_scope_device)) {
        out[1] = out[0];
        break;
      }
  }
}

kernel void counted(global atomic_int *c, global int *out) {
  atomic_fetch_add_explicit(c, 1, memory_order_relaxed, memory_scope_device);
  out[get_global_id(0)] = atomic_load_explicit(c, memory_order_relaxed, memory_scope_device);
}

kernel void wide(global ulong *sum) { atom_add(sum, 0x123456789ul); }

kernel void sum(global volatile float *s) {
  union { float f; uint u; } old, new;
  do {
    old.f = *s;
    new.f = old.f + 1;
  } while (atomic_cmpxchg((global volatile uint *)s, old.u, new.u) != old.u);
}

kernel void first(global int *winner, global int *out) {
  if (atomic_cmpxchg(winner, 0, 1) == 0)
    out[0] = *winner;
}

kernel void store_before(global int *data) {
  if (get_global_id(0) == 0)
    *data = 0;
  atomic_inc(data);
}

kernel void load_after(global int *data, global int *out) {
  atomic_inc(data);
  if (get_global_id(0) == get_global_size(0) - 1)
    *out = *data;
}

kernel void peek(global int *data, global int *out) {
  if (get_local_id(0) == 0)
    atomic_cmpxchg(data, 0, 3);
  else
    out[get_global_id(0)] = *data;
}

kernel void read_by_all(global int *data, global int *out) {
  int group = get_group_id(0);
  out[group] = data[0];
  if (group == 1)
    data[0] = group;
}
