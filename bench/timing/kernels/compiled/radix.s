	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"radix.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*512)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a2, vx_thread_id
	csrr	a0, vx_warp_id
	bnez	a0, .LBB0_15
# %bb.1:
	slli	a5, a2, 2
	lui	a1, 1048560
	add	a0, a5, a1
	addi	a1, a1, 1024
	add	a1, a5, a1
	mv	a3, a0
.LBB0_2:                                # =>This Inner Loop Header: Depth=1
	sw	zero, 0(a3)
	addi	a3, a3, 64
	bne	a3, a1, .LBB0_2
# %bb.3:
	slli	a3, a2, 7
	lui	a4, %hi(bits)
	addi	a4, a4, %lo(bits)
	add	a1, a4, a3
	addi	a6, a1, 128
	mv	a7, a1
.LBB0_4:                                # =>This Inner Loop Header: Depth=1
	lw	t0, 0(a7)
	slli	t0, t0, 28
	srli	t0, t0, 22
	add	t0, a0, t0
	lw	t1, 0(t0)
	addi	t1, t1, 1
	addi	a7, a7, 4
	sw	t1, 0(t0)
	bne	a7, a6, .LBB0_4
# %bb.5:
	li	t1, 0
	slli	a6, a2, 6
	lui	t0, 1048560
	add	a7, a6, t0
	addi	t0, t0, 64
	add	t0, a6, t0
.LBB0_6:                                # =>This Inner Loop Header: Depth=1
	lw	t2, 0(a7)
	sw	t1, 0(a7)
	addi	a7, a7, 4
	add	t1, t2, t1
	bne	a7, t0, .LBB0_6
# %bb.7:
	li	t0, 0
	li	a7, 0
	lui	t2, 1048560
	add	a5, a5, t2
	sw	t1, 1024(a5)
	addi	a5, t2, 1024
	li	t1, 16
	j	.LBB0_9
.LBB0_8:                                #   in Loop: Header=BB0_9 Depth=1
	vx_join	t2
	addi	t0, t0, 1
	addi	a5, a5, 4
	beq	t0, t1, .LBB0_11
.LBB0_9:                                # =>This Inner Loop Header: Depth=1
	sltu	t2, t0, a2
	vx_split	t2, t2
	bgeu	t0, a2, .LBB0_8
# %bb.10:                               #   in Loop: Header=BB0_9 Depth=1
	lw	t3, 0(a5)
	add	a7, t3, a7
	j	.LBB0_8
.LBB0_11:
	lui	a5, 1048560
	add	a2, a6, a5
	addi	a5, a5, 64
	add	a6, a6, a5
.LBB0_12:                               # =>This Inner Loop Header: Depth=1
	lw	a5, 0(a2)
	add	a5, a5, a7
	sw	a5, 0(a2)
	addi	a2, a2, 4
	bne	a2, a6, .LBB0_12
# %bb.13:
	add	a3, a4, a3
	addi	a2, a3, 128
	lui	a3, %hi(begin_signature)
	addi	a3, a3, %lo(begin_signature)
.LBB0_14:                               # =>This Inner Loop Header: Depth=1
	lw	a4, 0(a1)
	slli	a5, a4, 28
	srli	a5, a5, 22
	add	a5, a0, a5
	lw	a6, 0(a5)
	addi	a7, a6, 1
	sw	a7, 0(a5)
	slli	a6, a6, 2
	add	a6, a3, a6
	addi	a1, a1, 4
	sw	a4, 0(a6)
	bne	a1, a2, .LBB0_14
.LBB0_15:
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
	.zero	2048
	.size	begin_signature, 2048

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
	.addrsig_sym vorion.vx_split
	.addrsig_sym vorion.vx_join
