/* Pictures to their code and back.
 *
 *      c | b     a channel is foreseen from its neighbours: as the less or the greater of a and b
 *     ---+---    where c is beyond the other one, else on the plane through all three
 *      a | x
 *
 * The less its neighbours differ, the nearer it will be: the sizes of their differences choose the
 * models.
 */
#include "picture.h"

enum { CONTEXTS = 16, PIXEL = 4 };

/* Channels are coded in this order; red and blue are foreseen to be as far off as green. */
static const unsigned char order[4] = {3, 1, 0, 2};
enum { GREEN = 1 };

typedef struct coding {
  pf_number models[4][CONTEXTS];
  const pf_texel *rows[2]; /* the one above, or NULL, and that of the pixel */
  int64_t green;           /* by how much it was off */
} coding;

/* What is known of a channel before it is read; *model: of the rest. */
static int64_t foresee(coding *k, uint32_t x, int c, pf_number **model) {
  const pf_texel *row = k->rows[1], *upper = k->rows[0];
  int32_t left = x > 0 ? row[x - 1].coded[c] : 0, above = upper ? upper[x].coded[c] : 0;
  int32_t corner = upper && x > 0 ? upper[x - 1].coded[c] : 0;
  int32_t low = left < above ? left : above, high = left < above ? above : left;
  uint32_t context = 0;
  for (int32_t change = abs(above - corner) + abs(left - corner);
       change > 0 && context + 1 < CONTEXTS; change >>= 1)
    context++;
  *model = &k->models[c][context];
  int64_t seen = corner >= high ? low : corner <= low ? high : left + above - corner;
  return c == 0 || c == 2 ? seen + k->green : seen;
}

/* The next row. */
static void begin_row(coding *k, const pf_texel *row) {
  k->rows[0] = k->rows[1];
  k->rows[1] = row;
}

static coding *begin(const pf_memory *memory) {
  coding *k = pf_make(memory, sizeof *k, 1);
  if (k)
    pf_models_begin(k->models, sizeof k->models);
  return k;
}

/* ---------------------------------------------------------------- good pictures */

static bool is_size(uint32_t width, uint32_t height) {
  return width - 1 < PLANEFILE_PICTURE_SIDE && height - 1 < PLANEFILE_PICTURE_SIDE;
}

static uint64_t least_code(uint32_t width, uint32_t height) {
  return ((uint64_t)width * height + PF_PIXELS_PAID - 1) / PF_PIXELS_PAID;
}

bool pf_picture_is_good(const planefile_picture *picture) {
  size_t name = picture->kind == PLANEFILE_NAMED && picture->name ? strlen(picture->name) : 0;
  return is_size(picture->width, picture->height) && picture->kind <= PLANEFILE_NAMED &&
         picture->row && name <= PLANEFILE_NAME && (name > 0 || picture->kind != PLANEFILE_NAMED);
}

/* ---------------------------------------------------------------- encoding */

static void put_row(pf_encoder *encoder, coding *k, uint32_t width) {
  pf_number *model;
  for (uint32_t x = 0; x < width; x++)
    for (int i = 0; i < 4; i++) {
      int c = order[i];
      int64_t off = k->rows[1][x].coded[c] - foresee(k, x, c, &model);
      pf_put_signed(encoder, model, off);
      k->green = c == GREEN ? off : k->green;
    }
}

/* Bytes of zero, until there are as many as pay for the pixels. */
static void pay(pf_encoder *encoder, const planefile_picture *picture) {
  uint64_t paid = PF_PICTURE_BYTES + least_code(picture->width, picture->height);
  size_t count = encoder->count;
  if (paid <= count)
    return;
  unsigned char *bytes = paid > SIZE_MAX / 2 ? NULL
                                             : pf_grow(&encoder->memory, encoder->bytes, 1,
                                                       &encoder->capacity, (size_t)paid);
  encoder->failed |= bytes == NULL;
  if (!bytes)
    return;
  encoder->bytes = bytes;
  encoder->count = (size_t)paid;
  memset(bytes + count, 0, encoder->count - count);
}

/* bytes: room for a row; rows: for two. */
static bool put_rows(pf_encoder *encoder, coding *k, const planefile_picture *picture,
                     unsigned char *bytes, pf_texel *rows) {
  for (uint32_t y = 0; y < picture->height; y++) {
    pf_texel *row = rows + (y % 2) * (size_t)picture->width;
    bool is_light = picture->kind == PLANEFILE_LIGHT;
    if (!picture->row(picture->user, y, is_light ? (void *)row : bytes))
      return false;
    for (size_t i = 0; !is_light && i < PIXEL * (size_t)picture->width; i++)
      row[i / PIXEL].coded[i % PIXEL] = bytes[i];
    begin_row(k, row);
    put_row(encoder, k, picture->width);
  }
  pf_encoder_end(encoder);
  pay(encoder, picture);
  return true;
}

static planefile_status encode_pixels(const pf_memory *memory, const planefile_picture *picture,
                                      pf_encoder *out) {
  size_t width = picture->width;
  coding *k = begin(memory);
  pf_texel *rows = pf_make(memory, sizeof *rows, 2 * width);
  unsigned char *bytes = pf_make(memory, PIXEL, width);
  bool is_made = k && rows && bytes;
  planefile_status status = PLANEFILE_NO_MEMORY;
  if (is_made)
    status = put_rows(out, k, picture, bytes, rows) ? PLANEFILE_OK : PLANEFILE_READ_FAILED;
  pf_free(memory, bytes, PIXEL, width);
  pf_free(memory, rows, sizeof *rows, 2 * width);
  pf_free(memory, k, sizeof *k, 1);
  return out->failed ? PLANEFILE_NO_MEMORY : status;
}

planefile_status pf_picture_encode(const pf_memory *memory, const planefile_picture *picture,
                                   pf_encoder *out) {
  size_t name = picture->kind == PLANEFILE_NAMED ? strlen(picture->name) : 0;
  pf_encoder_begin(out, memory, PF_PICTURE_BYTES + name);
  if (out->failed)
    return PLANEFILE_NO_MEMORY;
  pf_store_32(out->bytes, picture->width);
  pf_store_32(out->bytes + 4, picture->height);
  pf_store_32(out->bytes + 8, picture->kind);
  if (picture->kind != PLANEFILE_NAMED)
    return encode_pixels(memory, picture, out);
  pf_store_64(out->bytes + 12, picture->key[0]);
  memcpy(out->bytes + PF_PICTURE_BYTES, picture->name, name);
  return PLANEFILE_OK;
}

/* ---------------------------------------------------------------- decoding */

const char pf_no_memory[] = "no memory";

static bool get_row(pf_decoder *decoder, coding *k, uint32_t width, uint32_t kind, pf_texel *row) {
  const int64_t most = kind == PLANEFILE_LIGHT ? PLANEFILE_BRIGHT : 255;
  pf_number *model;
  for (uint32_t x = 0; x < width; x++)
    for (int i = 0; i < 4; i++) {
      int c = order[i];
      int64_t seen = foresee(k, x, c, &model), off = pf_get_signed(decoder, model);
      k->green = c == GREEN ? off : k->green;
      off += seen;
      if (off > most || off < (kind == PLANEFILE_LIGHT ? -most : 0))
        return false;
      row[x].coded[c] = (int32_t)off;
    }
  return !decoder->is_beyond;
}

static const char *get_rows(pf_decoder *decoder, coding *k, const pf_picture *out, uint32_t kind) {
  pf_texel *row = out->texels;
  for (uint32_t y = 0; y < out->height; y++, row += out->width) {
    begin_row(k, row);
    if (!get_row(decoder, k, out->width, kind, row))
      return "its code is not allowed";
  }
  return pf_decoder_is_whole(decoder) ? NULL : "its code does not end where it should";
}

static const char *decode_pixels(const pf_memory *memory, pf_picture_code code, uint32_t kind,
                                 pf_picture *out) {
  if (least_code(out->width, out->height) > code.size)
    return "it claims more than its bytes can hold";
  coding *k = begin(memory);
  const char *reason = pf_no_memory;
  pf_decoder decoder;
  pf_decoder_begin(&decoder, code.bytes, code.size);
  if (k && pf_picture_make(memory, out))
    reason = get_rows(&decoder, k, out, kind);
  pf_free(memory, k, sizeof *k, 1);
  return reason;
}

/* The host's codes of a named picture. */
static const char *find_pixels(const planefile_source *source, const pf_memory *memory,
                               pf_picture_code code, uint64_t key, pf_picture *out) {
  char name[PLANEFILE_NAME + 1] = {0};
  if (!source->picture || code.size == 0 || code.size > PLANEFILE_NAME)
    return "its pixels are not there";
  memcpy(name, code.bytes, code.size);
  const planefile_picture wanted = {.width = out->width,
                                    .height = out->height,
                                    .kind = PLANEFILE_NAMED,
                                    .key = {key},
                                    .name = name};
  const unsigned char *codes = source->picture(source->user, &wanted);
  if (!codes)
    return "its pixels are not there";
  if (!pf_picture_make(memory, out))
    return pf_no_memory;
  for (size_t i = 0; i < PIXEL * (size_t)out->width * out->height; i++)
    out->texels[i / PIXEL].coded[i % PIXEL] = codes[i];
  return NULL;
}

/* Texels as they were coded become light. */
static void find_light(pf_picture *picture, const pf_light_curve *curve, uint32_t kind) {
  for (size_t i = 0; i < (size_t)picture->width * picture->height; i++) {
    pf_texel *texel = &picture->texels[i], coded = *texel;
    float alpha = (float)coded.coded[3] * (1.0f / 255);
    for (int c = 0; c < 4; c++)
      texel->light[c] = kind == PLANEFILE_LIGHT ? (float)coded.coded[c] * (1.0f / PLANEFILE_WHITE)
                        : c < 3                 ? curve->codes[coded.coded[c]] * alpha
                                                : alpha;
  }
}

const char *pf_picture_decode(const planefile_source *source, const pf_memory *memory,
                              const pf_light_curve *curve, pf_picture_code code, pf_picture *out) {
  if (code.size < PF_PICTURE_BYTES)
    return "it is too short";
  uint32_t kind = pf_load_32(code.bytes + 8);
  uint64_t key = pf_load_64(code.bytes + 12);
  out->width = pf_load_32(code.bytes);
  out->height = pf_load_32(code.bytes + 4);
  code.bytes += PF_PICTURE_BYTES;
  code.size -= PF_PICTURE_BYTES;
  if (!is_size(out->width, out->height) || kind > PLANEFILE_NAMED)
    return "it is not allowed";
  const char *reason = kind == PLANEFILE_NAMED ? find_pixels(source, memory, code, key, out)
                                               : decode_pixels(memory, code, kind, out);
  if (!reason) {
    find_light(out, curve, kind);
    pf_picture_fill(out);
  }
  return reason;
}
