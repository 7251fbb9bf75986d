# How CoreMark's Makefile compiles and runs it:
#   make PORT_DIR=.../bench/coremark run1.log              on the machine, by one lane
#   make PORT_DIR=.../bench/coremark TARGET=qemu run1.log  as an rv32 program under qemu-riscv32
LEVEL = -O2
FLAGS_STR = "$(LEVEL) $(XCFLAGS)"
CFLAGS = $(LEVEL) -I$(PORT_DIR) -I. -DFLAGS_STR=\"$(FLAGS_STR)\"
PORT_SRCS = $(PORT_DIR)/core_portme.c
OUTFLAG = -o
OPATH = ./
MKDIR = mkdir -p

ifeq ($(TARGET),qemu)
ROOT = $(PORT_DIR)/../..
RT = $(or $(VORION_SOURCES),$(ROOT)/build/sources)/llvm/compiler-rt/lib/builtins
CC = clang-19 --target=riscv32-unknown-linux-gnu -march=rv32imaf -mabi=ilp32f -mno-relax -fno-pic -ffreestanding -w
CFLAGS += -I$(ROOT)/libdevice/print -nostdlib -static -fuse-ld=lld
PORT_SRCS += $(PORT_DIR)/linux.c $(addprefix $(ROOT)/libdevice/print/,decimal.c float.c format.c integer.c) \
  $(addprefix $(RT)/,adddf3.c ashldi3.c comparedf2.c divdf3.c divdi3.c fixunsdfsi.c floatsidf.c floatunsidf.c fp_mode.c \
  lshrdi3.c muldf3.c subdf3.c udivdi3.c udivmoddi4.c umoddi3.c)
EXE = .linux
SIMULATOR = qemu-riscv32
else
CC = vorion-clang
EXE = .elf
SIMULATOR = vorion-sim --one-hart
endif

# The Makefile gives the program arguments, for which the machine has no room.
RUN = sh -c 'exec $(SIMULATOR) $$0'
LOAD = :
.PHONY: port_prebuild port_postbuild port_prerun port_postrun port_preload port_postload
port_pre% port_post%: ;
