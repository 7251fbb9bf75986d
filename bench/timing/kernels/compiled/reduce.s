	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"reduce.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*256)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a2, vx_warp_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	li	a3, 255
	bltu	a3, a1, .LBB0_9
# %bb.1:
	slli	a2, a2, 6
	lui	a3, 1048560
	add	a2, a2, a3
	slli	a5, a0, 2
	add	a3, a2, a5
	lui	a4, %hi(ones)
	addi	a4, a4, %lo(ones)
	add	a5, a5, a4
	lui	a6, 2
	add	a5, a5, a6
	fmv.w.x	fa5, zero
	lui	a6, %hi(begin_signature)
	addi	a6, a6, %lo(begin_signature)
	li	a7, 256
	j	.LBB0_3
.LBB0_2:                                #   in Loop: Header=BB0_3 Depth=1
	flw	fa4, 0(a2)
	add	t0, a6, t0
	fsw	fa4, 0(t0)
	csrr	t0, vx_num_warps
	slli	t0, t0, 4
	add	a1, t0, a1
	bgeu	a1, a7, .LBB0_9
.LBB0_3:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_4 Depth 2
                                        #     Child Loop BB0_7 Depth 2
	add	t0, a1, a0
	slli	t0, t0, 2
	add	t1, a4, t0
	addi	t2, t1, 1024
	mv	t3, a5
	fmv.s	fa4, fa5
.LBB0_4:                                #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	flw	fa3, 0(t1)
	flw	fa2, 0(t3)
	fmadd.s	fa4, fa3, fa2, fa4
	addi	t1, t1, 64
	addi	t3, t3, 64
	bne	t1, t2, .LBB0_4
# %bb.5:                                #   in Loop: Header=BB0_3 Depth=1
	fsw	fa4, 0(a3)
	li	t1, 8
	j	.LBB0_7
.LBB0_6:                                #   in Loop: Header=BB0_7 Depth=2
	srli	t1, t1, 1
	vx_join	t2
	beqz	t1, .LBB0_2
.LBB0_7:                                #   Parent Loop BB0_3 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	sltu	t2, a0, t1
	vx_split	t2, t2
	bgeu	a0, t1, .LBB0_6
# %bb.8:                                #   in Loop: Header=BB0_7 Depth=2
	slli	t3, t1, 2
	add	t3, a3, t3
	flw	fa4, 0(a3)
	flw	fa3, 0(t3)
	fadd.s	fa4, fa4, fa3
	fsw	fa4, 0(a3)
	j	.LBB0_6
.LBB0_9:
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
	.zero	1024
	.size	begin_signature, 1024

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
	.addrsig_sym vorion.vx_split
	.addrsig_sym vorion.vx_join
