/// Random numbers by counting: the same words for the same key and counter,
/// wherever and in whatever order they are asked for. Philox 4x32 of ten rounds
/// (J. K. Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3").
/// Compiled as C++ and as OpenCL C.
#pragma once

// NOLINTBEGIN(readability-identifier-naming): OpenCL names, as in layout.h.

/// Four words of 32 random bits.
typedef struct {
  uint word[4];
} philox_words;

static inline philox_words philox(uint key0, uint key1, uint counter0,
                                  uint counter1, uint counter2, uint counter3) {
  philox_words c = {{counter0, counter1, counter2, counter3}};
  for (int round = 0; round < 10; ++round) {
    const ulong left = (ulong)0xD2511F53U * c.word[0];
    const ulong right = (ulong)0xCD9E8D57U * c.word[2];
    const philox_words next = {
        {(uint)(right >> 32) ^ c.word[1] ^ key0, (uint)right,
         (uint)(left >> 32) ^ c.word[3] ^ key1, (uint)left}};
    c = next;
    key0 += 0x9E3779B9U;
    key1 += 0xBB67AE85U;
  }
  return c;
}

/// What the numbers are for: the last word of the counter.
enum {
  STREAM_START = 1,      ///< random points; counter 0 is the point
  STREAM_VIEWS = 2,      ///< the order of views; place and round
  STREAM_SPLIT = 3,      ///< samples of a split; identity, child and iteration
  STREAM_CLOCK = 4,      ///< iterations that are timed; block and its length
  STREAM_CHILD = 5,      ///< identities; the parent's, child and iteration
  STREAM_BACKGROUND = 6, ///< of a picture; its place in the run, two words
  STREAM_DRAW = 7,       ///< draws of Gaussians; number, what for, iteration
  STREAM_NOISE = 8       ///< random steps; identity, 0 and iteration
};

/// The middle of one of 2^23 equal parts of (0, 1): never 0, never 1.
static inline float philox_unit(uint word) {
  return ((float)(word >> 9) + 0.5F) * (1.0F / 8388608.0F);
}

// NOLINTEND(readability-identifier-naming)
