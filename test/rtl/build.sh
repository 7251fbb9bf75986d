#!/usr/bin/env bash
# Makes FOLDER/Bench, the rasterizer in SystemVerilog with its test bench. usage: test/rtl/build.sh FOLDER
set -euo pipefail
Here=$(cd "$(dirname "$0")" && pwd)
[ $# = 1 ] || { echo "usage: test/rtl/build.sh FOLDER" >&2; exit 2; }
# Sources are small and run for seconds: time goes to compiling.
verilator --cc --exe --build -j 2 --hierarchical --top-module top --Mdir "$1" -o Bench \
  -Wall -Wno-DECLFILENAME -Wno-UNUSEDSIGNAL \
  -MAKEFLAGS "CXX=clang++-19 LINK=clang++-19 OPT_FAST=-O1 OPT_SLOW=-O0 OPT_GLOBAL=-O0" -CFLAGS "-std=c++20 -I$Here/../../isasim" \
  "$Here"/{fp32,exp_table,lane,cut,pixel_bank,dispatch,fetch,tile_writer,rasterizer,top}.sv "$Here/Bench.cpp"
