#include "coder.h"

enum { MODEL_BITS = 12, SPEED = 4 };
#define LEAST (UINT32_C(1) << 24) /* of a range */

/* ---------------------------------------------------------------- encoding bits */

void pf_encoder_finish(pf_encoder *encoder) {
  pf_free(&encoder->memory, encoder->bytes, 1, encoder->capacity);
}

static void put_byte(pf_encoder *encoder, unsigned char byte) {
  void *bytes =
      pf_grow(&encoder->memory, encoder->bytes, 1, &encoder->capacity, encoder->count + 1);
  encoder->failed |= bytes == NULL;
  if (bytes) {
    encoder->bytes = bytes;
    encoder->bytes[encoder->count++] = byte;
  }
}

void pf_encoder_begin(pf_encoder *encoder, const pf_memory *memory, size_t head) {
  *encoder = (pf_encoder){.memory = *memory, .range = UINT32_MAX};
  for (size_t i = 0; i < head; i++)
    put_byte(encoder, 0);
}

/* Writes the uppermost byte of `low`, once it is known whether a carry changes it. */
static void shift(pf_encoder *encoder) {
  uint32_t carry = (uint32_t)(encoder->low >> 32);
  if (carry || encoder->low < UINT32_C(0xff000000)) {
    if (encoder->held_count > 0)
      put_byte(encoder, (unsigned char)(encoder->held + carry));
    while (encoder->held_count > 1) {
      put_byte(encoder, (unsigned char)(255 + carry));
      encoder->held_count--;
    }
    encoder->held = (unsigned char)(encoder->low >> 24);
    encoder->held_count = 0;
  }
  encoder->held_count++;
  encoder->low = (encoder->low & 0xffffff) << 8;
}

void pf_encoder_end(pf_encoder *encoder) {
  for (int i = 0; i < 5; i++)
    shift(encoder);
}

static void put_bit(pf_encoder *encoder, uint16_t *model, uint32_t bit) {
  uint32_t bound = (encoder->range >> MODEL_BITS) * *model;
  if (bit) {
    encoder->low += bound;
    encoder->range -= bound;
    *model = (uint16_t)(*model - (*model >> SPEED));
  } else {
    encoder->range = bound;
    *model = (uint16_t)(*model + (((1 << MODEL_BITS) - *model) >> SPEED));
  }
  for (; encoder->range < LEAST; encoder->range <<= 8)
    shift(encoder);
}

static void put_plain(pf_encoder *encoder, uint32_t number, int bits) {
  while (bits-- > 0) {
    encoder->range >>= 1;
    if (number >> bits & 1)
      encoder->low += encoder->range;
    for (; encoder->range < LEAST; encoder->range <<= 8)
      shift(encoder);
  }
}

/* ---------------------------------------------------------------- decoding bits */

static inline uint32_t next_byte(pf_decoder *decoder) {
  if (decoder->at < decoder->end)
    return *decoder->at++;
  decoder->is_beyond = true;
  return 0;
}

void pf_decoder_begin(pf_decoder *decoder, const unsigned char *bytes, size_t size) {
  *decoder = (pf_decoder){.at = bytes, .end = bytes + size, .range = UINT32_MAX};
  for (int i = 0; i < 4; i++)
    decoder->code = decoder->code << 8 | next_byte(decoder);
}

bool pf_decoder_is_whole(const pf_decoder *decoder) {
  bool is_whole = !decoder->is_beyond;
  for (const unsigned char *at = decoder->at; at < decoder->end; at++)
    is_whole = is_whole && *at == 0;
  return is_whole;
}

static void widen(pf_decoder *decoder) {
  for (; decoder->range < LEAST; decoder->range <<= 8)
    decoder->code = decoder->code << 8 | next_byte(decoder);
}

static uint32_t get_bit(pf_decoder *decoder, uint16_t *model) {
  uint32_t bound = (decoder->range >> MODEL_BITS) * *model, bit = decoder->code >= bound;
  if (bit) {
    decoder->code -= bound;
    decoder->range -= bound;
    *model = (uint16_t)(*model - (*model >> SPEED));
  } else {
    decoder->range = bound;
    *model = (uint16_t)(*model + (((1 << MODEL_BITS) - *model) >> SPEED));
  }
  widen(decoder);
  return bit;
}

static uint32_t get_plain(pf_decoder *decoder, int bits) {
  uint32_t number = 0;
  while (bits-- > 0) {
    decoder->range >>= 1;
    uint32_t bit = decoder->code >= decoder->range;
    decoder->code -= bit ? decoder->range : 0;
    number = number << 1 | bit;
    widen(decoder);
  }
  return number;
}

/* ---------------------------------------------------------------- numbers */

void pf_put_symbol(pf_encoder *encoder, uint16_t *tree, int bits, uint32_t symbol) {
  uint32_t node = 1;
  while (bits-- > 0) {
    uint32_t bit = symbol >> bits & 1;
    put_bit(encoder, &tree[node], bit);
    node = 2 * node + bit;
  }
}

uint32_t pf_get_symbol(pf_decoder *decoder, uint16_t *tree, int bits) {
  uint32_t node = 1;
  for (int i = 0; i < bits; i++)
    node = 2 * node + get_bit(decoder, &tree[node]);
  return node - (UINT32_C(1) << bits);
}

/* Bits of a number of a class after the first one: those that are modelled, and the rest. */
static inline int led_bits(uint32_t class) { return class > 2 ? 2 : class > 1 ? 1 : 0; }
static inline int plain_bits(uint32_t class) { return class > 3 ? (int)class - 3 : 0; }

void pf_put_number(pf_encoder *encoder, pf_number *model, uint32_t number) {
  uint32_t class = pf_class_of(number);
  int led = led_bits(class), plain = plain_bits(class);
  pf_put_symbol(encoder, model->classes, 6, class);
  pf_put_symbol(encoder, model->leading[class], led, number >> plain & ((1U << led) - 1));
  put_plain(encoder, number, plain);
}

uint32_t pf_get_number(pf_decoder *decoder, pf_number *model) {
  uint32_t class = pf_get_symbol(decoder, model->classes, 6);
  class = class > 32 ? 32 : class;
  if (class == 0)
    return 0;
  int led = led_bits(class), plain = plain_bits(class);
  uint32_t number = 1U << led | pf_get_symbol(decoder, model->leading[class], led);
  return number << plain | get_plain(decoder, plain);
}

void pf_put_signed(pf_encoder *encoder, pf_number *model, int64_t number) {
  pf_put_number(encoder, model, (uint32_t)(number < 0 ? -number : number));
  if (number != 0)
    pf_put_symbol(encoder, model->sign, 1, number < 0);
}

int64_t pf_get_signed(pf_decoder *decoder, pf_number *model) {
  int64_t number = pf_get_number(decoder, model);
  return number != 0 && pf_get_symbol(decoder, model->sign, 1) ? -number : number;
}
