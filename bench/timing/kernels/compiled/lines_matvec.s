	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"lines_matvec.c"
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
	bltu	a2, a1, .LBB0_7
# %bb.1:
	lui	a2, %hi(ones)
	addi	a2, a2, %lo(ones)
	lui	a4, 2
	add	a3, a2, a4
	addi	a4, a4, 64
	fmv.w.x	fa5, zero
	lui	a5, %hi(begin_signature)
	addi	a5, a5, %lo(begin_signature)
	li	a6, 4
	li	a7, 128
.LBB0_2:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_3 Depth 2
                                        #       Child Loop BB0_4 Depth 3
	li	t0, 0
	add	t2, a1, a0
	slli	t1, t2, 4
	slli	t2, t2, 6
	add	t2, a2, t2
	mv	t3, a3
.LBB0_3:                                #   Parent Loop BB0_2 Depth=1
                                        # =>  This Loop Header: Depth=2
                                        #       Child Loop BB0_4 Depth 3
	slli	t4, t0, 6
	add	t5, a2, a4
	add	t4, t4, t5
	mv	t5, t2
	mv	t6, t3
	fmv.s	fa4, fa5
.LBB0_4:                                #   Parent Loop BB0_2 Depth=1
                                        #     Parent Loop BB0_3 Depth=2
                                        # =>    This Inner Loop Header: Depth=3
	flw	fa3, 0(t5)
	flw	fa2, 0(t6)
	fmadd.s	fa4, fa3, fa2, fa4
	addi	t6, t6, 4
	addi	t5, t5, 4
	bne	t6, t4, .LBB0_4
# %bb.5:                                #   in Loop: Header=BB0_3 Depth=2
	or	t4, t0, t1
	slli	t4, t4, 2
	add	t4, a5, t4
	fsw	fa4, 0(t4)
	addi	t0, t0, 1
	addi	t3, t3, 64
	bne	t0, a6, .LBB0_3
# %bb.6:                                #   in Loop: Header=BB0_2 Depth=1
	csrr	t0, vx_num_warps
	slli	t0, t0, 4
	add	a1, t0, a1
	bltu	a1, a7, .LBB0_2
.LBB0_7:
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
