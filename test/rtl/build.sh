#!/usr/bin/env bash
# Makes FOLDER/Bench, the rasterizer in SystemVerilog with its test bench; with "backward" a pair of lanes and the gather
# of the backward mode with theirs. usage: test/rtl/build.sh FOLDER [backward]
set -euo pipefail
# Installed, what it includes of the simulator lies beside it.
Here=$(cd "$(dirname "$0")" && pwd -P)
Compiler=$(command -v clang++-19 || command -v c++) || { echo "build.sh: error: no C++ compiler, expected c++" >&2; exit 1; }
case "$#:${2:-}" in
  1:) Top=top Bench=Bench.cpp Modules=(cut pixel_bank dispatch fetch tile_writer rasterizer) ;;
  2:backward) Top=backward_top Bench=BackwardBench.cpp Modules=(backward) ;;
  *) echo "usage: test/rtl/build.sh FOLDER [backward]" >&2; exit 2 ;;
esac
Sources=()
for Module in fp32 exp_table triangle lane "${Modules[@]}" "$Top"; do Sources+=("$Here/$Module.sv"); done
# Sources are small and run for seconds: time goes to compiling. ccache shares objects among folders.
verilator --cc --exe --build -j 2 --hierarchical --top-module "$Top" --Mdir "$1" -o Bench \
  -Wall -Wno-DECLFILENAME -Wno-UNUSEDSIGNAL \
  -MAKEFLAGS "OBJCACHE=$(command -v ccache || true) CXX=$Compiler LINK=$Compiler OPT_FAST=-O1 OPT_SLOW=-O0 OPT_GLOBAL=-O0" -CFLAGS "-std=c++20 -I$Here -I$Here/../../isasim" \
  "${Sources[@]}" "$Here/$Bench"
