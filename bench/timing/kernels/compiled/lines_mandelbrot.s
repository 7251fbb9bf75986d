	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"lines_mandelbrot.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*2048)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	li	a2, 127
	bltu	a2, a1, .LBB0_5
# %bb.1:
	lui	a2, %hi(ones)
	addi	a2, a2, %lo(ones)
	lui	a3, 263168
	fmv.w.x	fa5, a3
	lui	a3, 788992
	fmv.w.x	fa4, a3
	lui	a3, 787456
	fmv.w.x	fa3, a3
	fmv.w.x	fa2, zero
	lui	a3, 264192
	fmv.w.x	fa1, a3
	lui	a3, %hi(begin_signature)
	addi	a3, a3, %lo(begin_signature)
	li	a4, 128
.LBB0_2:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_3 Depth 2
	add	a6, a1, a0
	slli	a5, a6, 6
	add	a5, a2, a5
	flw	fa0, 0(a5)
	flw	ft0, 4(a5)
	fmul.s	fa0, fa0, fa5
	fadd.s	ft0, ft0, ft0
	fadd.s	fa0, fa0, fa4
	fadd.s	ft0, ft0, fa3
	li	a5, 0
	slli	a6, a6, 4
	li	a7, 32
	fmv.s	ft1, fa2
	fmv.s	ft2, fa2
.LBB0_3:                                #   Parent Loop BB0_2 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	fmul.s	ft3, ft2, ft2
	fadd.s	ft4, ft2, ft2
	fmul.s	ft5, ft1, ft1
	fmul.s	ft4, ft4, ft1
	fsub.s	ft6, ft3, ft5
	fmv.x.w	t0, ft2
	fadd.s	ft2, ft3, ft5
	fadd.s	ft3, ft0, ft4
	fadd.s	ft4, fa0, ft6
	fmv.x.w	t1, ft1
	flt.s	t2, ft2, fa1
	fmv.x.w	t3, ft3
	fmv.x.w	t4, ft4
	snez	t5, t2
	neg	t5, t5
	xor	t4, t4, t0
	and	t4, t4, t5
	xor	t0, t0, t4
	fmv.w.x	ft2, t0
	xor	t0, t3, t1
	and	t0, t0, t5
	xor	t0, t1, t0
	fmv.w.x	ft1, t0
	addi	a7, a7, -1
	add	a5, a5, t2
	bnez	a7, .LBB0_3
# %bb.4:                                #   in Loop: Header=BB0_2 Depth=1
	slli	a6, a6, 2
	add	a6, a3, a6
	sw	a5, 0(a6)
	csrr	a5, vx_num_warps
	slli	a5, a5, 4
	add	a1, a5, a1
	bltu	a1, a4, .LBB0_2
.LBB0_5:
	li	a0, 0
	ret
.Lfunc_end0:
	.size	main, .Lfunc_end0-main
                                        # -- End function
	.type	begin_signature,@object         # @begin_signature
	.bss
	.globl	begin_signature
	.p2align	6, 0x0
begin_signature:
	.zero	8192
	.size	begin_signature, 8192

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
