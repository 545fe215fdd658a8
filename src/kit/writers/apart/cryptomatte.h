/* Cryptomatte 1.2: for each pixel the names that are seen most, as numbers made of the names, and
 * how much each is seen. Source: Cryptomatte Specification 1.2.0 (Psyop, 2016 to 2018).
 *
 *   mattes   --weights--> sky .4  hill .1  tree .5   --sorted--> rank 0: tree   rank 1: sky ...
 *
 *   channels   CryptoCel00.R G B A   CryptoCel01.R G B A   CryptoCel02.R G B A
 *              id0 w0 id1 w1         id2 w2 id3 w3         id4 w4 id5 w5        32-bit floats
 *   header     cryptomatte/1234567/name, hash, conversion, manifest
 */
#pragma once

#include "writers/apart/apart.h"
#include "writers/apart/mattes.h"
#include "writers/apart/sources.h"
#include "writers/exr/exr.h"

enum {
  CS_CRYPTOMATTE_RANKS = 6,
  CS_CRYPTOMATTE_VALUES = 2 * CS_CRYPTOMATTE_RANKS, /* channels */
  CS_CRYPTOMATTE_ATTRIBUTES = 4
};

/* MurmurHash3_x86_32 with seed 0 of the name, with its exponent changed where it would be that of
 * no normal float. */
uint32_t cs_cryptomatte_id(const char *name);

typedef struct cs_cryptomatte {
  cs_mattes mattes;
  cs_sources sources; /* the frames of the steps, as floats */
  int32_t width;
  int32_t lines;         /* rows that are made together */
  unsigned char *alphas; /* the pixels of these rows */
  float *weights; /* the weights of a pixel, one a matte, for each row that is made together */
  uint32_t *ids;  /* the ids of the mattes */
  char *manifest;
  size_t manifest_size;                     /* as allocated */
  const char *layer;                        /* "CryptoCel" or "CryptoName" */
  char keys[CS_CRYPTOMATTE_ATTRIBUTES][40]; /* the names of the attributes */
  char names[CS_CRYPTOMATTE_VALUES][16];    /* names of the channels */
} cs_cryptomatte;

/* lines: the most rows of one call. which: not NONE. Must be finished, also after an error. Errors:
 * those of cs_mattes_make and of rendering. */
CELSPAN_CHECKED celspan_status cs_cryptomatte_begin(celspan_context *context,
                                                    const celspan_frame_desc *desc,
                                                    cs_apart_mattes which, int32_t lines,
                                                    cs_cryptomatte *out);
/* The channels, with values at `offset` of a row, in `stride` bytes a pixel; and the attributes. */
void cs_cryptomatte_describe(const cs_cryptomatte *crypto, size_t offset,
                             cs_exr_channel channels[CS_CRYPTOMATTE_VALUES],
                             cs_exr_attribute attributes[CS_CRYPTOMATTE_ATTRIBUTES]);
/* Rows y .. y + lines - 1: CS_CRYPTOMATTE_VALUES floats a pixel, with `stride` bytes from row to
 * row. Errors: those of rendering. */
CELSPAN_CHECKED celspan_status cs_cryptomatte_make(cs_cryptomatte *crypto, int32_t y, int32_t lines,
                                                   unsigned char *out, size_t stride);
void cs_cryptomatte_finish(cs_cryptomatte *crypto);
