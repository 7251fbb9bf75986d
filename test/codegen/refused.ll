; What has no meaning for a warp is an error with a reason, not a crash.
; REQUIRES: vorion-llc
; RUN: not vorion-llc -mtriple=riscv32 -mcpu=vorion < %s -o /dev/null 2>&1 | FileCheck %s

; CHECK: error: {{.*}}in function pointer {{.*}}: a tail call through a pointer in which lanes may differ; use vx_uniform if they cannot
define void @pointer(ptr %f) {
  musttail call void %f(ptr %f)
  ret void
}

; CHECK: error: {{.*}}in function computed {{.*}}: a computed jump: lanes cannot be kept together across it
define void @computed(ptr %p) {
  indirectbr ptr %p, [label %a, label %b]
a:
  ret void
b:
  ret void
}

; CHECK: error: {{.*}}in function unknown {{.*}}: there is no intrinsic vorion.vx_nothing
declare void @vorion.vx_nothing()
define void @unknown() {
  call void @vorion.vx_nothing()
  ret void
}

; CHECK: error: {{.*}}in function types {{.*}}: wrong types in a call of vx_tmc, expected them as in vorion.h
declare void @vorion.vx_tmc(i64)
define void @types() {
  call void @vorion.vx_tmc(i64 0)
  ret void
}

; Splits written by hand must pair.
; CHECK: error: {{.*}}in function unpaired {{.*}}: a return between vx_split and vx_join
declare i32 @vorion.vx_split(i32)
define void @unpaired(i32 %x) {
  %token = call i32 @vorion.vx_split(i32 %x)
  ret void
}
