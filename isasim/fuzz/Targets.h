/// What the fuzzers call, and tests replay: a function that must come back
/// whatever the bytes are, with every promise kept that it checks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vorion::isasim::fuzz {

/// The bytes as an ELF file and as a .vxbin file.
void readImage(std::span<const std::byte> Bytes);

/// The bytes as instructions, on all lanes of two cores, with registers that
/// point into all memory, after the first 4 bytes, which choose some of them.
/// Aborts if the guest wrote outside its memory, or if the run differs with an
/// observer or with the translator.
void execute(std::span<const std::byte> Bytes);

/// The bytes as what a debugger says, a packet a line; lines that begin with
/// '!' are sent without a frame. Aborts if a debugger that only looks changes
/// the run.
void debug(std::span<const std::byte> Bytes);

/// The bytes as a program that writes and reads rasterizer CSRs and memory in
/// any order, on cores of two sockets. Aborts if the run differs with the
/// clock, an observer, the checkers or the numeric sanitizer.
void rasterize(std::span<const std::byte> Bytes);

/// The bytes as a saved region, as they are and with its sizes and sums made
/// right; one of a small machine is run. Aborts if an error says nothing, or is
/// not the file's.
void restore(std::span<const std::byte> Bytes);

/// Inputs to begin with: programs whole and damaged.
std::vector<std::vector<std::byte>> imageSeeds();
/// Programs of random instructions, mostly valid ones.
std::vector<std::vector<std::byte>> programSeeds(unsigned Count, unsigned Seed);
/// Sessions with gdb.
std::vector<std::vector<std::byte>> debuggerSeeds();
/// Commands of every mode, most of them valid.
std::vector<std::vector<std::byte>> rasterSeeds(unsigned Count, unsigned Seed);
/// Regions of machines of several shapes.
std::vector<std::vector<std::byte>> regionSeeds();

} // namespace vorion::isasim::fuzz
