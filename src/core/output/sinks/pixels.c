/* Each depth has a coder, which turns colours into bytes, many at once. It gets one colour of a
 * single span, all colours of an array, and up to CHUNK colours of a gradient at a time. The coding
 * in which nearly every frame is written, 8 bits, sRGB, straight, has rows of its own
 * (output/sinks/pixels8.h). */
#include "output/sinks/pixels.h"

#include <assert.h>
#include <math.h>

#include "base/description.h"
#include "base/vector.h"
#include "model/colour/space.h"
#include "model/colour/srgb8_lanes.h"
#include "model/colour/transfer.h"
#include "output/sinks/pixels8.h"
#include "output/sinks/straight.h"

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "pixels are written little endian");

enum {
  CHUNK = 64,          /* pixels that are coded together */
  CURVE_TOGETHER = 16, /* numbers of which the vector code is quicker */
  MOST_BYTES = 16      /* bytes of a pixel */
};

size_t celspan_coding_pixel_size(const celspan_coding *coding) {
  celspan_coding whole;
  return cs_pixels_read(NULL, &coding, &whole) == CELSPAN_OK ? cs_pixels_size(coding) : 0;
}

size_t cs_pixels_size(const celspan_coding *coding) {
  switch (coding->depth) {
  case CELSPAN_DEPTH_16:
  case CELSPAN_DEPTH_HALF:
    return 8;
  case CELSPAN_DEPTH_FLOAT:
    return 16;
  default:
    return 4;
  }
}

celspan_status cs_pixels_read(celspan_context *context, const celspan_coding **coding,
                              celspan_coding *whole) {
  *whole = CELSPAN_CODING;
  if (*coding)
    CS_TRY(cs_description_read(context, "coding", &cs_celspan_coding_description, *coding, whole));
  *coding = whole;
  return context ? cs_pixels_check(context, whole) : CELSPAN_OK;
}

celspan_status cs_pixels_check(celspan_context *context, const celspan_coding *coding) {
  if (!coding || ((unsigned)coding->depth <= CELSPAN_DEPTH_8_DITHER &&
                  (unsigned)coding->transfer <= CELSPAN_TRANSFER_CINEON &&
                  (unsigned)coding->alpha <= CELSPAN_ALPHA_PREMULTIPLIED &&
                  (unsigned)coding->space <= CELSPAN_SPACE_SRGB))
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                 "coding: depth %d, transfer %d, alpha %d or space %d is not a known value",
                 (int)coding->depth, (int)coding->transfer, (int)coding->alpha, (int)coding->space);
}

celspan_coding cs_pixels_resolve(const celspan_coding *coding, celspan_depth default_depth) {
  celspan_coding resolved = coding ? *coding : CELSPAN_CODING;
  resolved.struct_size = sizeof resolved;
  if (resolved.depth == CELSPAN_DEPTH_DEFAULT)
    resolved.depth = default_depth == CELSPAN_DEPTH_DEFAULT ? CELSPAN_DEPTH_8 : default_depth;
  if (resolved.depth == CELSPAN_DEPTH_8_DITHER)
    resolved.depth = CELSPAN_DEPTH_8;
  bool integer = resolved.depth == CELSPAN_DEPTH_8 || resolved.depth == CELSPAN_DEPTH_16;
  if (resolved.convert)
    resolved.transfer = CS_TRANSFER_CONVERTED;
  if (resolved.transfer == CELSPAN_TRANSFER_DEFAULT)
    resolved.transfer = integer ? CELSPAN_TRANSFER_SRGB : CELSPAN_TRANSFER_LINEAR;
  if (resolved.alpha == CELSPAN_ALPHA_DEFAULT)
    resolved.alpha = integer ? CELSPAN_ALPHA_STRAIGHT : CELSPAN_ALPHA_PREMULTIPLIED;
  return resolved;
}

const char *cs_pixels_colour(const celspan_coding *coding) {
  if (!coding->convert)
    return cs_transfer_name(coding->transfer);
  return coding->colour ? coding->colour : "converted";
}

bool cs_pixels_primaries(const celspan_coding *coding, float xy[CS_PRIMARIES]) {
  if (coding->convert)
    return cs_primaries_of(coding->convert, coding->user, xy);
  memcpy(xy, cs_primaries_known[0].xy, CS_PRIMARIES * sizeof *xy);
  return true;
}

bool cs_pixels_takes_codes(const celspan_coding *coding) {
  return coding->depth == CELSPAN_DEPTH_8 && coding->transfer == CELSPAN_TRANSFER_SRGB &&
         coding->alpha == CELSPAN_ALPHA_STRAIGHT;
}

celspan_span cs_pixels_crop(const celspan_span *span, int32_t x, int32_t count) {
  celspan_span cropped = *span;
  size_t cut = 4 * (size_t)(x - span->x0);
  cropped.x0 = 0;
  cropped.x1 = count;
  cropped.origin = span->origin - x;
  if (span->kind == CELSPAN_SPAN_ARRAY && span->codes)
    cropped.codes += cut;
  else if (span->kind == CELSPAN_SPAN_ARRAY)
    cropped.array += cut;
  return cropped;
}

/* ---------------------------------------------------------------- one pixel */

static uint32_t float_bits(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

/* x, clamped to 0..1, times `most`, rounded half up. The product is exact in double. NaN becomes
 * 0. */
static unsigned to_integer(float x, double most) {
  return !(x > 0) ? 0 : x >= 1 ? (unsigned)most : (unsigned)((double)x * most + 0.5);
}

/* IEEE 754 binary16, rounded half to even. A number that is too large becomes 65504; NaN remains
 * NaN. */
static uint16_t to_half(float x) {
  uint32_t bits = float_bits(x), sign = bits >> 16 & 0x8000, size = bits & 0x7fffffff;
  if (size > 0x7f800000)
    return (uint16_t)(sign | 0x7e00);
  if (size >= 0x477ff000)
    return (uint16_t)(sign | 0x7bff);
  if (size <
      0x38800000) { /* below 2^-14, the number is a multiple of 2^-24, and so is one above 1/2 */
    float above_half = fabsf(x) + 0.5f;
    return (uint16_t)(sign | (float_bits(above_half) - 0x3f000000));
  }
  uint32_t even = size >> 13 & 1;
  return (uint16_t)(sign | ((size - 0x38000000 + 0xfff + even) >> 13));
}

/* Whether the numbers of spans need no conversion for the coding. */
static bool is_in_codes(const celspan_coding *coding) {
  return coding->space == CELSPAN_SPACE_SRGB && coding->transfer == CELSPAN_TRANSFER_SRGB;
}

/* Whether the colour is divided by alpha before a conversion: not where it is clear, and has no
 * colour that could be multiplied by alpha again, nor light over black, which is opaque. */
static bool is_divided(const celspan_coding *coding, const float rgba[4]) {
  return coding->alpha != CS_ALPHA_BLACK && rgba[3] > 0;
}

/* Codes of sRGB as light. count: at most CHUNK. */
static void decode(size_t count, float colours[][4]) {
  float shares[CHUNK][4];
  for (size_t i = 0; i < count; i++)
    cs_v4_store(shares[i], cs_v4_all(colours[i][3]));
  CS_WIDE_CHOOSE(cs_isa_best(), cs_space_pixels)
  (CELSPAN_SPACE_LINEAR, shares[0], (int32_t)count, colours[0]);
}

/* Conversions mix channels and have curves, so that only straight light can be given to them. Light
 * without alpha is converted as if it were opaque. */
static void make_straight(const celspan_coding *coding, float rgba[4]) {
  bool is_dark = coding->alpha == CELSPAN_ALPHA_STRAIGHT && rgba[3] <= 0;
  for (int c = 0; c < 3; c++)
    rgba[c] = is_dark ? 0 : is_divided(coding, rgba) ? rgba[c] / rgba[3] : rgba[c];
}

static void finish_converted(const celspan_coding *coding, const float rgba[4], float out[4]) {
  bool is_multiplied =
      coding->alpha == CELSPAN_ALPHA_PREMULTIPLIED || coding->alpha == CS_ALPHA_CODED;
  bool is_clear = rgba[3] == 0 && rgba[0] == 0 && rgba[1] == 0 && rgba[2] == 0;
  for (int c = 0; c < 3 && is_multiplied; c++)
    out[c] = is_clear ? 0 : rgba[3] > 0 ? out[c] * rgba[3] : out[c];
  out[3] = rgba[3];
}

/* count: at most CHUNK, because conversions are quicker for many colours at once. */
static void convert(const celspan_coding *coding, const float *rgba, size_t count, float out[][4]) {
  memcpy(out, rgba, 4 * count * sizeof *rgba);
  if (coding->space == CELSPAN_SPACE_SRGB)
    decode(count, out);
  for (size_t i = 0; i < count; i++)
    make_straight(coding, out[i]);
  coding->convert(coding->user, out[0], count);
  for (size_t i = 0; i < count; i++)
    finish_converted(coding, rgba + 4 * i, out[i]);
}

/* The curve of sRGB is quicker for many numbers at once; both ways give the same bits. */
static void apply_curve(celspan_transfer transfer, size_t count, float *numbers) {
  if (transfer == CELSPAN_TRANSFER_SRGB && count >= CURVE_TOGETHER)
    CS_WIDE_CHOOSE(cs_isa_best(), cs_space_codes)((int32_t)count, numbers);
  else
    for (size_t i = 0; i < count && transfer != CELSPAN_TRANSFER_LINEAR; i++)
      numbers[i] = cs_transfer_encode(transfer, numbers[i]);
}

static void multiply(const float *rgba, size_t count, float coded[][4]) {
  for (size_t i = 0; i < count; i++)
    for (int c = 0; c < 3; c++)
      coded[i][c] *= rgba[4 * i + 3] > 0 ? rgba[4 * i + 3] : 1;
}

static void encode_by_curve(const celspan_coding *coding, const float *rgba, size_t count,
                            float coded[][4]) {
  bool is_coded = is_in_codes(coding), is_multiplied = coding->alpha == CS_ALPHA_CODED;
  memcpy(coded, rgba, 4 * count * sizeof *rgba);
  if (coding->space == CELSPAN_SPACE_SRGB && !is_coded)
    decode(count, coded);
  if (coding->alpha == CELSPAN_ALPHA_STRAIGHT || is_multiplied)
    CS_WIDE_CHOOSE(cs_isa_best(), cs_straight_divide)(coded[0], (int32_t)count, is_multiplied);
  if (!is_coded)
    apply_curve(coding->transfer, 4 * count, coded[0]);
  if (is_multiplied)
    multiply(rgba, count, coded);
  for (size_t i = 0; i < count; i++)
    coded[i][3] = rgba[4 * i + 3];
}

/* count: at most CHUNK. */
static void encode(const celspan_coding *coding, const float *rgba, size_t count,
                   float coded[][4]) {
  if (coding->convert)
    convert(coding, rgba, count, coded);
  else
    encode_by_curve(coding, rgba, count, coded);
}

void cs_pixels_encode(const celspan_coding *coding, const float rgba[4], float coded[4]) {
  encode(coding, rgba, 1, (float(*)[4])coded);
}

/* ---------------------------------------------------------------- runs */

typedef void (*coder)(const celspan_coding *coding, const float *rgba, size_t count,
                      unsigned char *out);

static inline size_t portion_of(size_t count) { return count < CHUNK ? count : CHUNK; }

static void code_8_srgb_straight(const celspan_coding *coding, const float *rgba, size_t count,
                                 unsigned char *out) {
  (void)coding;
  cs_srgb8_choose(cs_isa_best())(rgba, count, out);
}

static void code_8_codes_straight(const celspan_coding *coding, const float *rgba, size_t count,
                                  unsigned char *out) {
  (void)coding;
  cs_srgb8_choose_codes(cs_isa_best())(rgba, count, out);
}

/* Light without alpha cannot be divided by alpha: it is coded as if it were opaque. */
static void code_8_srgb_premultiplied(const celspan_coding *coding, const float *rgba, size_t count,
                                      unsigned char *out) {
  cs_srgb8 code = cs_srgb8_choose(cs_isa_best());
  (void)coding;
  for (size_t portion; count > 0; count -= portion, rgba += 4 * portion, out += 4 * portion) {
    float opaque[4 * CHUNK];
    portion = portion_of(count);
    memcpy(opaque, rgba, 4 * portion * sizeof *rgba);
    for (size_t i = 0; i < portion; i++)
      opaque[4 * i + 3] = 1;
    code(opaque, portion, out);
    for (size_t i = 0; i < portion; i++)
      out[4 * i + 3] = (unsigned char)to_integer(rgba[4 * i + 3], 255);
  }
}

static void code_8(const celspan_coding *coding, const float *rgba, size_t count,
                   unsigned char *out) {
  for (size_t portion; count > 0; count -= portion, rgba += 4 * portion) {
    float coded[CHUNK][4];
    portion = portion_of(count);
    encode(coding, rgba, portion, coded);
    for (size_t i = 0; i < 4 * portion; i++)
      *out++ = (unsigned char)to_integer(coded[i / 4][i % 4], 255);
  }
}

static void code_16(const celspan_coding *coding, const float *rgba, size_t count,
                    unsigned char *out) {
  for (size_t portion; count > 0; count -= portion, rgba += 4 * portion, out += 8 * portion) {
    float coded[CHUNK][4];
    uint16_t words[4 * CHUNK];
    portion = portion_of(count);
    encode(coding, rgba, portion, coded);
    CS_WIDE_CHOOSE(cs_isa_best(), cs_straight_words)(coded[0], 4 * (int32_t)portion, words);
    memcpy(out, words, 8 * portion);
  }
}

static void code_half(const celspan_coding *coding, const float *rgba, size_t count,
                      unsigned char *out) {
  for (size_t portion; count > 0; count -= portion, rgba += 4 * portion, out += 8 * portion) {
    float coded[CHUNK][4];
    uint16_t words[4 * CHUNK];
    portion = portion_of(count);
    encode(coding, rgba, portion, coded);
    for (size_t i = 0; i < 4 * portion; i++)
      words[i] = to_half(coded[i / 4][i % 4]);
    memcpy(out, words, 8 * portion);
  }
}

static void code_float(const celspan_coding *coding, const float *rgba, size_t count,
                       unsigned char *out) {
  for (size_t portion; count > 0; count -= portion, rgba += 4 * portion, out += 16 * portion) {
    float coded[CHUNK][4];
    portion = portion_of(count);
    encode(coding, rgba, portion, coded);
    memcpy(out, coded, 16 * portion);
  }
}

static coder choose_coder_8(const celspan_coding *coding) {
  if (cs_pixels_takes_codes(coding))
    return is_in_codes(coding) ? code_8_codes_straight : code_8_srgb_straight;
  bool is_usual = coding->transfer == CELSPAN_TRANSFER_SRGB &&
                  coding->space != CELSPAN_SPACE_SRGB &&
                  coding->alpha == CELSPAN_ALPHA_PREMULTIPLIED;
  return is_usual ? code_8_srgb_premultiplied : code_8;
}

static coder choose_coder(const celspan_coding *coding) {
  switch (coding->depth) {
  case CELSPAN_DEPTH_16:
    return code_16;
  case CELSPAN_DEPTH_HALF:
    return code_half;
  case CELSPAN_DEPTH_FLOAT:
    return code_float;
  default:
    return choose_coder_8(coding);
  }
}

void cs_pixels_code(const celspan_coding *coding, const float rgba[4], void *pixel) {
  choose_coder(coding)(coding, rgba, 1, pixel);
}

/* ---------------------------------------------------------------- spans */

/* Pixels of adjacent gradients, collected so that they are coded together, because gradients may be
 * short. */
typedef struct gathered {
  float rgba[CHUNK][4];
  size_t count; /* pixels waiting */
  unsigned char *out;
} gathered;

static void flush(gathered *waiting, const celspan_coding *coding, coder code) {
  if (waiting->count > 0)
    code(coding, waiting->rgba[0], waiting->count, waiting->out);
  waiting->count = 0;
}

static void put_gradient(gathered *waiting, const celspan_coding *coding, coder code,
                         const celspan_span *span, size_t pixel_size, unsigned char *out) {
  cs_v4 colour = cs_v4_load(span->colour), slope = cs_v4_load(span->slope);
  for (int32_t x = span->x0; x < span->x1;) {
    if (waiting->count == 0)
      waiting->out = out + (size_t)(x - span->x0) * pixel_size;
    size_t room = CHUNK - waiting->count, rest = (size_t)(span->x1 - x);
    size_t count = rest < room ? rest : room;
    for (size_t k = 0; k < count; k++, x++)
      cs_v4_store(waiting->rgba[waiting->count + k], colour + slope * (float)(x - span->origin));
    waiting->count += count;
    if (waiting->count == CHUNK)
      flush(waiting, coding, code);
  }
}

/* The coded colours of the single spans among `count` spans, at most CHUNK, one after another. */
static void code_singles(const celspan_coding *coding, coder code, const celspan_span *spans,
                         size_t count, unsigned char *coded) {
  float rgba[CHUNK][4];
  size_t singles = 0;
  for (size_t i = 0; i < count; i++)
    if (spans[i].kind == CELSPAN_SPAN_SINGLE)
      memcpy(rgba[singles++], spans[i].colour, sizeof spans[i].colour);
  code(coding, rgba[0], singles, coded);
}

static void code_array(const celspan_coding *coding, coder code, const celspan_span *span,
                       size_t pixel_size, unsigned char *out) {
  size_t count = (size_t)(span->x1 - span->x0);
  if (span->codes)
    memcpy(out, span->codes, count * pixel_size);
  else
    code(coding, span->array, count, out);
}

/* waiting: gradients, which the next portion may continue. count: at most CHUNK. */
static void code_portion(const celspan_coding *coding, coder code, const celspan_span *spans,
                         size_t count, gathered *waiting, unsigned char *row) {
  unsigned char coded[MOST_BYTES * CHUNK], *single = coded;
  size_t pixel_size = cs_pixels_size(coding);
  code_singles(coding, code, spans, count, coded);
  for (const celspan_span *span = spans; span < spans + count; span++) {
    unsigned char *out = row + (size_t)span->x0 * pixel_size;
    if (span->kind == CELSPAN_SPAN_GRADIENT) {
      put_gradient(waiting, coding, code, span, pixel_size, out);
      continue;
    }
    flush(waiting, coding, code);
    if (span->kind == CELSPAN_SPAN_ARRAY) {
      code_array(coding, code, span, pixel_size, out);
      continue;
    }
    size_t size = (size_t)(span->x1 - span->x0) * pixel_size;
    CS_WIDE_CHOOSE(cs_isa_best(), cs_fill_run)(out, size, single, pixel_size);
    single += pixel_size;
  }
}

static void code_spans(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
                       unsigned char *row) {
  coder code = choose_coder(coding);
  gathered waiting;
  waiting.count = 0;
  for (size_t portion; span_count > 0; span_count -= portion, spans += portion) {
    portion = portion_of(span_count);
    code_portion(coding, code, spans, portion, &waiting, row);
  }
  flush(&waiting, coding, code);
}

void cs_pixels_row(const celspan_coding *coding, const celspan_span *spans, size_t span_count,
                   void *row) {
  if (span_count == 0)
    return;
  if (!cs_pixels_takes_codes(coding))
    code_spans(coding, spans, span_count, row);
  else if (is_in_codes(coding))
    CS_WIDE_CHOOSE(cs_isa_best(), cs_pixels8_codes)(spans, span_count, row);
  else
    CS_WIDE_CHOOSE(cs_isa_best(), cs_pixels8_row)(spans, span_count, row);
}

/* ---------------------------------------------------------------- single colours */

/* Pixels that vector code handles together. The count is rounded up to a multiple, so that no pixel
 * is coded alone; the additional colours are remnants of earlier calls. */
enum { AT_ONCE = 4 };

void cs_single_colours_code(cs_single_colours *colours, const celspan_coding *coding,
                            const celspan_span *spans, size_t count) {
  for (size_t i = 0; i < count; i++)
    memcpy(colours->rgba + 4 * i, spans[i].colour, sizeof spans[i].colour);
  size_t whole = (count + AT_ONCE - 1) / AT_ONCE * AT_ONCE;
  celspan_span all = {.x1 = (int32_t)whole, .kind = CELSPAN_SPAN_ARRAY, .array = colours->rgba};
  cs_pixels_row(coding, &all, 1, colours->coded);
}
