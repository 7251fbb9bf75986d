	.text
	.attribute	4, 16
	.attribute	5, "rv32i2p1_m2p0_a2p1_f2p2_zicsr2p0_zmmul1p0_zacas1p0_xvortex2p0"
	.file	"transpose.c"
                                        # Start of file scope inline assembly
	.globl	end_signature
.set end_signature, begin_signature+(4*4096)

                                        # End of file scope inline assembly
	.globl	main                            # -- Begin function main
	.p2align	2
	.type	main,@function
main:                                   # @main
# %bb.0:
	csrr	a0, vx_thread_id
	csrr	a1, vx_warp_id
	slli	a1, a1, 4
	srli	a2, a1, 12
	bnez	a2, .LBB0_3
# %bb.1:
	lui	a2, %hi(ones)
	addi	a2, a2, %lo(ones)
	lui	a3, %hi(begin_signature)
	addi	a3, a3, %lo(begin_signature)
.LBB0_2:                                # =>This Inner Loop Header: Depth=1
	add	a4, a1, a0
	slli	a4, a4, 2
	add	a4, a2, a4
	flw	fa5, 0(a4)
	srli	a4, a1, 6
	andi	a5, a1, 48
	add	a5, a5, a0
	slli	a5, a5, 6
	add	a4, a5, a4
	slli	a4, a4, 2
	add	a4, a3, a4
	fsw	fa5, 0(a4)
	csrr	a4, vx_num_warps
	slli	a4, a4, 4
	add	a1, a4, a1
	srli	a4, a1, 12
	beqz	a4, .LBB0_2
.LBB0_3:
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
	.zero	16384
	.size	begin_signature, 16384

	.ident	"Debian clang version 19.1.7 (3~deb12u1)"
	.section	".note.GNU-stack","",@progbits
	.addrsig
