; Intrinsics need the machine they are of.
; REQUIRES: vorion-llc
; RUN: not vorion-llc -mtriple=riscv32 < %s -o /dev/null 2>&1 | FileCheck %s
; RUN: not vorion-llc -mtriple=riscv32 -mattr=+xvortex < %s -o /dev/null 2>&1 | FileCheck --check-prefix=VORTEX %s

; CHECK: error: {{.*}}in function lane {{.*}}: vx_thread_id needs -march with xvortex
; CHECK: error: {{.*}}in function start {{.*}}: vr_start_set needs -march with xvorion
; VORTEX-NOT: xvortex
; VORTEX: error: {{.*}}in function start {{.*}}: vr_start_set needs -march with xvorion
declare i32 @vorion.vx_thread_id()
define i32 @lane() {
  %r = call i32 @vorion.vx_thread_id()
  ret i32 %r
}
declare void @vorion.vr_start_set(i32)
define void @start() {
  call void @vorion.vr_start_set(i32 0)
  ret void
}
