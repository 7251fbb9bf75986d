#!/usr/bin/env bash
# Makes FOLDER/Bench, the rasterizer in SystemVerilog with its test bench. usage: test/rtl/build.sh FOLDER
set -euo pipefail
# Installed, what it includes of the simulator lies beside it.
Here=$(cd "$(dirname "$0")" && pwd -P)
Compiler=$(command -v clang++-19 || command -v c++) || { echo "build.sh: error: no C++ compiler, expected c++" >&2; exit 1; }
[ $# = 1 ] || { echo "usage: test/rtl/build.sh FOLDER" >&2; exit 2; }
# Sources are small and run for seconds: time goes to compiling.
verilator --cc --exe --build -j 2 --hierarchical --top-module top --Mdir "$1" -o Bench \
  -Wall -Wno-DECLFILENAME -Wno-UNUSEDSIGNAL \
  -MAKEFLAGS "CXX=$Compiler LINK=$Compiler OPT_FAST=-O1 OPT_SLOW=-O0 OPT_GLOBAL=-O0" -CFLAGS "-std=c++20 -I$Here -I$Here/../../isasim" \
  "$Here"/{fp32,exp_table,lane,cut,pixel_bank,dispatch,fetch,tile_writer,rasterizer,top}.sv "$Here/Bench.cpp"
