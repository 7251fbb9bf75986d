	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"ranksort.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*128)

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
	lui	a2, %hi(bits)
	addi	a2, a2, %lo(bits)
	li	a3, 128
	lui	a4, %hi(begin_signature)
	addi	a4, a4, %lo(begin_signature)
.LBB0_2:                                # =>This Loop Header: Depth=1
                                        #     Child Loop BB0_3 Depth 2
	add	a6, a1, a0
	slli	a5, a6, 2
	add	a5, a2, a5
	lw	a5, 0(a5)
	li	t0, 0
	li	a7, 0
	mv	t1, a2
.LBB0_3:                                #   Parent Loop BB0_2 Depth=1
                                        # =>  This Inner Loop Header: Depth=2
	lw	t2, 0(t1)
	sltu	t3, t2, a5
	xor	t2, t2, a5
	seqz	t2, t2
	sltu	t4, t0, a6
	and	t2, t4, t2
	or	t2, t3, t2
	add	a7, a7, t2
	addi	t0, t0, 1
	addi	t1, t1, 4
	bne	t0, a3, .LBB0_3
# %bb.4:                                #   in Loop: Header=BB0_2 Depth=1
	slli	a7, a7, 2
	add	a7, a4, a7
	sw	a5, 0(a7)
	csrr	a5, vx_num_warps
	slli	a5, a5, 4
	add	a1, a5, a1
	bltu	a1, a3, .LBB0_2
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
	.zero	512
	.size	begin_signature, 512

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
