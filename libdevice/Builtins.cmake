# The functions that the compiler calls for what rv32imf has no instruction
# for, from compiler-rt's sources: 64-bit integers, conversions with them, half, double in software
# (printf of C programs, kernels that ask for it), and long double, which has 128 bits.
set(VORION_BUILTINS_FOLDER "${VORION_SOURCES}/llvm/compiler-rt/lib/builtins")
set(VORION_BUILTINS
  # 64-bit integers
  ashldi3 ashrdi3 lshrdi3 muldi3 divdi3 moddi3 divmoddi4 udivdi3 umoddi3 udivmoddi4 cmpdi2 ucmpdi2 negdi2
  clzdi2 ctzdi2 popcountdi2 paritydi2 paritysi2 bswapdi2 mulodi4 mulosi4
  # float and 64-bit integers, half
  fixsfdi fixunssfdi floatdisf floatundisf powisf2 extendhfsf2 truncsfhf2
  # double
  adddf3 subdf3 muldf3 divdf3 negdf2 comparedf2 extendsfdf2 truncdfsf2 truncdfhf2 fixdfsi fixdfdi fixunsdfsi
  fixunsdfdi floatsidf floatunsidf floatdidf floatundidf powidf2 fp_mode
  # long double
  addtf3 subtf3 multf3 divtf3 comparetf2 extendhftf2 extendsftf2 extenddftf2 trunctfhf2 trunctfsf2 trunctfdf2
  fixtfsi fixtfdi fixunstfsi fixunstfdi floatsitf floatunsitf floatditf floatunditf powitf2
  # _Complex
  mulsc3 divsc3 muldc3 divdc3 multc3 divtc3)
