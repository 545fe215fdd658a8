#include "writers/apart/cryptomatte.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "inside/sinks.h"
#include "inside/threads.h"

/* Weights below this are differences between roundings of equal alphas. */
#define LEAST 0x1p-16f

/* ---------------------------------------------------------------- ids */

static uint32_t rotate(uint32_t word, int bits) { return word << bits | word >> (32 - bits); }

static uint32_t scramble(uint32_t word) { return rotate(word * 0xcc9e2d51u, 15) * 0x1b873593u; }

static uint32_t murmur(const unsigned char *bytes, size_t size) {
  uint32_t hash = 0, rest = 0;
  size_t whole = size / 4 * 4;
  for (size_t i = 0; i < whole; i += 4) {
    uint32_t word = bytes[i] | (uint32_t)bytes[i + 1] << 8 | (uint32_t)bytes[i + 2] << 16 |
                    (uint32_t)bytes[i + 3] << 24;
    hash = rotate(hash ^ scramble(word), 13) * 5 + 0xe6546b64u;
  }
  for (size_t i = size; i-- > whole;)
    rest = rest << 8 | bytes[i];
  hash ^= scramble(rest) ^ (uint32_t)size;
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

uint32_t cs_cryptomatte_id(const char *name) {
  uint32_t hash = murmur((const unsigned char *)name, strlen(name));
  uint32_t exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ (uint32_t)1 << 23 : hash;
}

/* ---------------------------------------------------------------- the header */

/* A text of JSON; names have no control characters. Returns where it ends. */
static char *quote(char *out, const char *name) {
  *out++ = '"';
  for (; *name; name++) {
    if (*name == '"' || *name == '\\')
      *out++ = '\\';
    *out++ = *name;
  }
  *out++ = '"';
  return out;
}

/* The most bytes of a matte in the manifest: "name":"01234567", */
enum { ENTRY = 2 * CS_MARK_NAME + 16 };

static celspan_status make_manifest(celspan_context *context, cs_cryptomatte *crypto) {
  crypto->manifest_size = crypto->mattes.count * ENTRY + 3;
  CS_TRY(CS_MAKE(context, crypto->manifest, crypto->manifest_size));
  char *end = crypto->manifest;
  *end++ = '{';
  for (size_t i = 0; i < crypto->mattes.count; i++) {
    if (i > 0)
      *end++ = ',';
    end = quote(end, crypto->mattes.mattes[i].name);
    end += snprintf(end, ENTRY, ":\"%08" PRIx32 "\"", crypto->ids[i]);
  }
  *end++ = '}';
  *end = '\0';
  return CELSPAN_OK;
}

static void make_names(cs_cryptomatte *crypto) {
  static const char *const fields[] = {"name", "hash", "conversion", "manifest"};
  static const char letters[] = "RGBA";
  for (size_t i = 0; i < CS_CRYPTOMATTE_ATTRIBUTES; i++)
    snprintf(crypto->keys[i], sizeof crypto->keys[i], "cryptomatte/%07" PRIx32 "/%s",
             cs_cryptomatte_id(crypto->layer) >> 4, fields[i]);
  for (unsigned i = 0; i < CS_CRYPTOMATTE_VALUES; i++)
    snprintf(crypto->names[i], sizeof crypto->names[i], "%.10s%02u.%c", crypto->layer, i / 4,
             letters[i % 4]);
}

void cs_cryptomatte_describe(const cs_cryptomatte *crypto, size_t offset,
                             cs_exr_channel channels[CS_CRYPTOMATTE_VALUES],
                             cs_exr_attribute attributes[CS_CRYPTOMATTE_ATTRIBUTES]) {
  const char *const values[] = {crypto->layer, "MurmurHash3_32", "uint32_to_float32",
                                crypto->manifest};
  for (size_t i = 0; i < CS_CRYPTOMATTE_ATTRIBUTES; i++)
    attributes[i] = cs_exr_text(crypto->keys[i], values[i]);
  for (size_t i = 0; i < CS_CRYPTOMATTE_VALUES; i++)
    channels[i] = (cs_exr_channel){.name = crypto->names[i],
                                   .type = CS_EXR_FLOAT,
                                   .offset = offset + i * sizeof(float),
                                   .stride = CS_CRYPTOMATTE_VALUES * sizeof(float)};
}

/* ---------------------------------------------------------------- begin */

static celspan_status open_steps(celspan_context *context, const celspan_frame_desc *desc,
                                 cs_cryptomatte *crypto) {
  const celspan_coding floats = {sizeof floats, .depth = CELSPAN_DEPTH_FLOAT,
                                 .transfer = CELSPAN_TRANSFER_LINEAR, .space = desc->space};
  const cs_mattes *mattes = &crypto->mattes;
  celspan_frame_desc frame = *desc;
  frame.has_tolerance = true;
  frame.tolerance = CS_SOURCES_TOLERANCE;
  frame.exposure_count = 1;
  celspan_coding coding = cs_pixels_resolve(&floats, CELSPAN_DEPTH_FLOAT);
  CS_TRY(cs_sources_begin(context, &coding, crypto->width, mattes->step_count, &crypto->sources));
  for (size_t i = 0; i < mattes->step_count; i++) {
    frame.exposures = &mattes->steps[i].exposure;
    CS_TRY(cs_sources_open(&crypto->sources, i, &frame));
  }
  return CELSPAN_OK;
}

/* As many rows as fit into CS_SOURCES_PORTION, at least one. */
static int32_t choose_lines(const cs_cryptomatte *crypto, int32_t most) {
  size_t row = crypto->sources.count * crypto->sources.row;
  size_t fitting = row ? CS_SOURCES_PORTION / row : (size_t)most;
  return fitting < 1 ? 1 : fitting < (size_t)most ? (int32_t)fitting : most;
}

static size_t alphas_size(const cs_cryptomatte *crypto) {
  return crypto->sources.count * crypto->sources.row * (size_t)crypto->lines;
}

/* Without names nothing is rendered, and all values are 0. */
static celspan_status take_memory(celspan_context *context, cs_cryptomatte *crypto, int32_t lines) {
  size_t count = crypto->mattes.count;
  if (count == 0)
    return CELSPAN_OK;
  crypto->lines = choose_lines(crypto, lines);
  CS_TRY(CS_MAKE(context, crypto->ids, count));
  CS_TRY(CS_MAKE(context, crypto->weights, count * (size_t)crypto->lines));
  return CS_MAKE(context, crypto->alphas, alphas_size(crypto));
}

celspan_status cs_cryptomatte_begin(celspan_context *context, const celspan_frame_desc *desc,
                                    cs_apart_mattes which, int32_t lines, cs_cryptomatte *out) {
  bool by_objects = which == CS_APART_MATTES_NAMES;
  *out = (cs_cryptomatte){.width = desc->crop_width > 0 ? desc->crop_width : desc->width,
                          .layer = by_objects ? "CryptoName" : "CryptoCel"};
  make_names(out);
  CS_TRY(cs_mattes_make(context, desc->exposures, desc->exposure_count, by_objects, &out->mattes));
  CS_TRY(open_steps(context, desc, out));
  CS_TRY(take_memory(context, out, lines));
  for (size_t i = 0; i < out->mattes.count; i++)
    out->ids[i] = cs_cryptomatte_id(out->mattes.mattes[i].name);
  return make_manifest(context, out);
}

void cs_cryptomatte_finish(cs_cryptomatte *crypto) {
  celspan_context *context = crypto->mattes.context;
  if (!context)
    return;
  cs_memory *memory = context->memory;
  size_t count = crypto->mattes.count;
  cs_mem_free(memory, crypto->alphas, alphas_size(crypto));
  cs_mem_free(memory, crypto->weights, count * (size_t)crypto->lines * sizeof *crypto->weights);
  cs_mem_free(memory, crypto->ids, count * sizeof *crypto->ids);
  cs_mem_free(memory, crypto->manifest, crypto->manifest_size);
  cs_sources_finish(&crypto->sources);
  cs_mattes_finish(&crypto->mattes);
}

/* ---------------------------------------------------------------- rows */

static float alpha_of(const cs_cryptomatte *crypto, int32_t line, size_t step, int32_t x) {
  const unsigned char *row =
      crypto->alphas + ((size_t)line * crypto->sources.count + step) * crypto->sources.row;
  float alpha;
  memcpy(&alpha, row + (4 * (size_t)x + 3) * sizeof alpha, sizeof alpha);
  return alpha;
}

static void weigh(const cs_cryptomatte *crypto, int32_t line, int32_t x, float *weights) {
  const cs_mattes *mattes = &crypto->mattes;
  memset(weights, 0, mattes->count * sizeof *weights);
  float alpha = mattes->step_count ? alpha_of(crypto, line, 0, x) : 0;
  for (size_t i = 0; i < mattes->step_count; i++) {
    const cs_matte_step *step = &mattes->steps[i];
    bool has_next = i + 1 < mattes->step_count;
    float next = has_next ? alpha_of(crypto, line, i + 1, x) : 0;
    if (step->matte != CS_MATTE_NONE)
      weights[step->matte] += alpha - (step->is_last ? 0 : next);
    alpha = next;
  }
}

/* Of equal weights, the first stays before the others. */
static void rank(const cs_cryptomatte *crypto, const float *weights,
                 float out[CS_CRYPTOMATTE_VALUES]) {
  size_t count = 0;
  for (size_t i = 0; i < crypto->mattes.count; i++) {
    if (!(weights[i] > LEAST) ||
        (count == CS_CRYPTOMATTE_RANKS && weights[i] <= out[CS_CRYPTOMATTE_VALUES - 1]))
      continue;
    count += count < CS_CRYPTOMATTE_RANKS;
    size_t place = count - 1;
    for (; place > 0 && out[2 * place - 1] < weights[i]; place--)
      memcpy(out + 2 * place, out + 2 * place - 2, 2 * sizeof *out);
    memcpy(out + 2 * place, &crypto->ids[i], sizeof *out);
    out[2 * place + 1] = weights[i];
  }
}

typedef struct turn {
  const cs_cryptomatte *crypto;
  unsigned char *out;
  size_t stride;
} turn;

static void rank_row(void *user, int worker, int32_t line) {
  const turn *t = user;
  float *weights = t->crypto->weights + (size_t)line * t->crypto->mattes.count;
  unsigned char *out = t->out + (size_t)line * t->stride;
  (void)worker;
  for (int32_t x = 0; x < t->crypto->width; x++) {
    float values[CS_CRYPTOMATTE_VALUES] = {0};
    weigh(t->crypto, line, x, weights);
    rank(t->crypto, weights, values);
    memcpy(out + (size_t)x * sizeof values, values, sizeof values);
  }
}

static void clear_rows(const cs_cryptomatte *crypto, int32_t lines, const turn *t) {
  for (int32_t i = 0; i < lines; i++)
    memset(t->out + (size_t)i * t->stride, 0,
           (size_t)crypto->width * CS_CRYPTOMATTE_VALUES * sizeof(float));
}

celspan_status cs_cryptomatte_make(cs_cryptomatte *crypto, int32_t y, int32_t lines,
                                   unsigned char *out, size_t stride) {
  cs_sources *sources = &crypto->sources;
  turn t = {crypto, out, stride};
  if (crypto->mattes.count == 0)
    clear_rows(crypto, lines, &t);
  for (int32_t count; crypto->mattes.count > 0 && lines > 0; lines -= count, y += count) {
    count = lines < crypto->lines ? lines : crypto->lines;
    CS_TRY(cs_sources_make(sources, y, count, crypto->alphas, sources->count * sources->row));
    cs_thread_pool_run(sources->workers, count, rank_row, &t);
    t.out += (size_t)count * stride;
  }
  return CELSPAN_OK;
}
