/* Numbers to bytes and back: an adaptive binary range coder.
 *
 *   number --class, leading bits--> bits, each with a model of how often it is 1 --range--> bytes
 *
 *   class of a number   its length in bits: 0 for 0, 1 for 1, 2 for 2 and 3, ... 32
 *   coded as            class, 6 bits by a tree | the two bits after the first one, by a tree |
 *                       the rest, as they are
 *
 * A model is the probability of a 0 in 1/4096, which every bit moves towards itself by 1/16.
 *
 * INVARIANT: a decoder accepts any bytes: after the last one it reads zeros, and says so in the end
 * (pf_decoder_is_whole).
 */
#pragma once

#include "layout.h"

#define PF_EVEN 2048 /* the model of a bit of which nothing is known */

/* How often the bits of numbers of a kind are 0. */
typedef struct pf_number {
  uint16_t classes[64];
  uint16_t leading[33][4];
  uint16_t sign[2]; /* a tree of one bit */
} pf_number;

/* models: a struct of nothing else. */
static inline void pf_models_begin(void *models, size_t size) {
  uint16_t *all = models;
  for (size_t i = 0; i < size / sizeof *all; i++)
    all[i] = PF_EVEN;
}

typedef struct pf_encoder {
  pf_memory memory;
  unsigned char *bytes;
  size_t count, capacity;
  uint64_t low;
  uint32_t range;
  unsigned char held; /* a byte that a carry may still change, and how many of 255 follow it */
  size_t held_count;
  bool failed; /* no memory */
} pf_encoder;

typedef struct pf_decoder {
  const unsigned char *at, *end;
  uint32_t range, code;
  bool is_beyond; /* zeros were read after the end */
} pf_decoder;

/* head: bytes before the code, which are 0 at first. */
void pf_encoder_begin(pf_encoder *encoder, const pf_memory *memory, size_t head);
void pf_encoder_end(pf_encoder *encoder);
void pf_encoder_finish(pf_encoder *encoder); /* frees its bytes */

void pf_decoder_begin(pf_decoder *decoder, const unsigned char *bytes, size_t size);
/* Whether all that was read was there, and all that is there, except zeros, was read. */
bool pf_decoder_is_whole(const pf_decoder *decoder);

/* The length of a number in bits. */
static inline uint32_t pf_class_of(uint32_t number) {
  return number > 0 ? 64 - (uint32_t)__builtin_clzll(number) : 0;
}

/* A symbol of `bits` bits, by a tree of 2^bits models, of which the first is not used. */
void pf_put_symbol(pf_encoder *encoder, uint16_t *tree, int bits, uint32_t symbol);
uint32_t pf_get_symbol(pf_decoder *decoder, uint16_t *tree, int bits);
void pf_put_number(pf_encoder *encoder, pf_number *model, uint32_t number);
uint32_t pf_get_number(pf_decoder *decoder, pf_number *model);
/* Numbers from -(2^31 - 1) to 2^31 - 1; a decoder can return any that 33 bits hold. */
void pf_put_signed(pf_encoder *encoder, pf_number *model, int64_t number);
int64_t pf_get_signed(pf_decoder *decoder, pf_number *model);
