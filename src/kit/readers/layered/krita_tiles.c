#include "readers/layered/krita_tiles.h"

#include <stdlib.h>
#include <string.h>

#include "readers/layered/contents.h"

#define SIDE 64 /* pixels of a tile */

typedef struct tiles_source {
  cs_rows_source base;
  cs_zip_member member; /* without its name */
  cs_krita_tiles_form form;
} tiles_source;

typedef struct tile {
  int32_t x, y;     /* from the corner of the rows; multiples of SIDE */
  size_t at, count; /* the place of its bytes */
} tile;

typedef struct tiles_rows {
  cs_rows base;
  const cs_input *input;
  unsigned char *bytes; /* the whole member */
  size_t size;
  tile *tiles; /* row by row, then column by column */
  size_t count, next;
  int32_t y;
  unsigned char *tile_row;        /* SIDE rows of pixels in the form of the file */
  unsigned char *planes, *pixels; /* one tile: as packed, and interleaved */
} tiles_rows;

bool cs_krita_tiles_form_of(const char *space, cs_krita_tiles_form *form) {
  static const struct {
    const char *name;
    int bits, channels;
  } spaces[] = {
      {"RGBA", 8, 4}, {"RGBA16", 16, 4}, {"GRAYA", 8, 2}, {"GRAYAU16", 16, 2}, {"GRAYA16", 16, 2}};
  for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++)
    if (strcmp(space, spaces[i].name) == 0) {
      form->is_grey = spaces[i].channels == 2;
      form->bits = spaces[i].bits;
      form->pixel_size = spaces[i].bits / 8 * spaces[i].channels;
      return true;
    }
  return false;
}

/* ---------------------------------------------------------------- LZF */

/* LZF, the packing of tiles: literal runs and copies of what was unpacked before.
 *
 *   000nnnnn                   n + 1 bytes follow
 *   lllooooo oooooooo          copy l + 2 bytes from o + 1 bytes back; l from 1 to 6
 *   111ooooo llllllll oooooooo   the same with l + 9 bytes
 *
 * False unless the packed bytes unpack to exactly out_size bytes. */
static bool unpack_lzf(const unsigned char *packed, size_t size, unsigned char *out,
                       size_t out_size) {
  size_t at = 0, done = 0;
  while (at < size) {
    size_t head = packed[at++], count = head >> 5;
    if (count == 0) {
      count = head + 1;
      if (count > size - at || count > out_size - done)
        return false;
      memcpy(out + done, packed + at, count);
      at += count;
      done += count;
      continue;
    }
    size_t needed = count == 7 ? 2 : 1;
    if (needed > size - at)
      return false;
    if (count == 7)
      count += packed[at++];
    count += 2;
    size_t back = ((head & 31) << 8 | packed[at++]) + 1;
    if (back > done || count > out_size - done)
      return false;
    /* may overlap its own output, which repeats a pattern */
    for (size_t i = 0; i < count; i++, done++)
      out[done] = out[done - back];
  }
  return done == out_size;
}

/* ---------------------------------------------------------------- lines of text */

/* Reads bytes of a member, from memory or from a stream. */
typedef struct reader {
  celspan_context *context;
  const cs_input *input;
  const char *name;
  cs_stream *stream;          /* NULL: reads from memory */
  const unsigned char *bytes; /* in memory */
  size_t at, size;
} reader;

static celspan_status fail(const reader *r, celspan_status status, const char *sentence) {
  return cs_input_fail(r->context, r->input, -1, status, "%s: byte %zu: %s", r->name, r->at,
                       sentence);
}

static celspan_status take(reader *r, void *out, size_t count) {
  if (r->stream)
    CS_TRY(cs_stream_read(r->stream, r->context, out, count, r->name));
  else if (count > r->size - r->at)
    return fail(r, CELSPAN_INPUT, "the tiles end too early");
  else
    memcpy(out, r->bytes + r->at, count);
  r->at += count;
  return CELSPAN_OK;
}

static celspan_status pass(reader *r, size_t count) {
  unsigned char bytes[4096];
  for (size_t step; r->stream && count > 0; count -= step) {
    step = count < sizeof bytes ? count : sizeof bytes;
    CS_TRY(take(r, bytes, step));
  }
  if (count > r->size - r->at && !r->stream)
    return fail(r, CELSPAN_INPUT, "the tiles end too early");
  r->at += count;
  return CELSPAN_OK;
}

/* A line without its end. */
static celspan_status read_line(reader *r, char line[64]) {
  size_t done = 0;
  for (;; done++) {
    if (done == 64)
      return fail(r, CELSPAN_INPUT, "a line of the layer's tiles is too long");
    CS_TRY(take(r, line + done, 1));
    if (line[done] == '\n')
      break;
  }
  line[done] = 0;
  return CELSPAN_OK;
}

/* The whole number of at most nine digits at the beginning of *at; *at is moved after it. */
static bool read_whole(const char **at, int32_t *out) {
  bool is_negative = **at == '-';
  int32_t number = 0;
  const char *digit = *at + is_negative, *first = digit;
  for (; *digit >= '0' && *digit <= '9' && digit - first < 9; digit++)
    number = 10 * number + (*digit - '0');
  *at = digit;
  *out = is_negative ? -number : number;
  return digit > first;
}

/* A line "WORD number". */
static celspan_status read_setting(reader *r, const char *word, int32_t *out) {
  char line[64];
  size_t size = strlen(word);
  CS_TRY(read_line(r, line));
  const char *at = line + size;
  if (strncmp(line, word, size) != 0 || !read_whole(&at, out) || *at || *out < 0)
    return fail(r, CELSPAN_INPUT, "the head of the layer's tiles is damaged");
  return CELSPAN_OK;
}

static celspan_status read_head(reader *r, int pixel_size, int32_t *count) {
  int32_t version, width, height, size;
  CS_TRY(read_setting(r, "VERSION ", &version));
  CS_TRY(read_setting(r, "TILEWIDTH ", &width));
  CS_TRY(read_setting(r, "TILEHEIGHT ", &height));
  CS_TRY(read_setting(r, "PIXELSIZE ", &size));
  CS_TRY(read_setting(r, "DATA ", count));
  if (version != 2 || width != SIDE || height != SIDE)
    return fail(r, CELSPAN_INPUT,
                "tiles of an unknown kind; those of version 2, 64 x 64, are read");
  if (size != pixel_size)
    return fail(r, CELSPAN_INPUT, "the pixels have another size than those of the colour space");
  return CELSPAN_OK;
}

static bool parse_tile(const char *line, tile *out, int32_t *count) {
  const char *at = line;
  if (!read_whole(&at, &out->x) || *at++ != ',' || !read_whole(&at, &out->y) ||
      strncmp(at, ",LZF,", 5) != 0)
    return false;
  at += 5;
  return read_whole(&at, count) && *at == 0 && out->x % SIDE == 0 && out->y % SIDE == 0;
}

/* The line of a tile: its place, and the number of bytes that follow. */
static celspan_status read_tile(reader *r, int pixel_size, tile *out) {
  char line[64];
  int32_t count;
  CS_TRY(read_line(r, line));
  if (!parse_tile(line, out, &count) || count < 1 || count > SIDE * SIDE * pixel_size + 1)
    return fail(r, CELSPAN_INPUT, "the line of a tile is damaged");
  out->at = r->at;
  out->count = (size_t)count;
  return pass(r, out->count);
}

/* ---------------------------------------------------------------- the rectangle */

typedef struct bounds {
  int64_t x0, y0, x1, y1; /* empty where x0 >= x1 */
} bounds;

static void include(bounds *b, int64_t x0, int64_t y0, int64_t x1, int64_t y1) {
  bool is_empty = b->x0 >= b->x1;
  b->x0 = is_empty || x0 < b->x0 ? x0 : b->x0;
  b->y0 = is_empty || y0 < b->y0 ? y0 : b->y0;
  b->x1 = is_empty || x1 > b->x1 ? x1 : b->x1;
  b->y1 = is_empty || y1 > b->y1 ? y1 : b->y1;
}

static celspan_status find_bounds(reader *r, int pixel_size, bounds *out) {
  int32_t count;
  CS_TRY(read_head(r, pixel_size, &count));
  for (int32_t i = 0; i < count; i++) {
    tile found;
    CS_TRY(read_tile(r, pixel_size, &found));
    include(out, found.x, found.y, (int64_t)found.x + SIDE, (int64_t)found.y + SIDE);
    if (r->at > CS_KRITA_TILES_BYTES)
      return fail(r, CELSPAN_LIMIT, "the tiles of a layer have more than 1073741824 bytes");
  }
  return CELSPAN_OK;
}

/* Whether the pixel outside the tiles is visible: alpha is its last channel. */
static bool is_beyond_clear(const cs_krita_tiles_form *form) {
  int bytes = form->bits / 8;
  return form->beyond[form->pixel_size - 1] == 0 && form->beyond[form->pixel_size - bytes] == 0;
}

/* Sets the rectangle of the rows. */
static celspan_status set_rectangle(const reader *r, const bounds *b, cs_krita_tiles_form *form) {
  int64_t width = b->x1 - b->x0, height = b->y1 - b->y0;
  if (width > CS_KRITA_TILES_SIDE || height > CS_KRITA_TILES_SIDE)
    return fail(r, CELSPAN_LIMIT, "the tiles of a layer cover more than 131072 pixels a side");
  CS_TRY(cs_contents_check_size(r->context, r->input, r->name, width, height));
  form->x = (int32_t)b->x0;
  form->y = (int32_t)b->y0;
  form->width = (int32_t)width;
  form->height = (int32_t)height;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

static int compare(const void *a, const void *b) {
  const tile *p = a, *q = b;
  if (p->y != q->y)
    return p->y < q->y ? -1 : 1;
  if (p->x != q->x)
    return p->x < q->x ? -1 : 1;
  return p->at < q->at ? -1 : p->at > q->at;
}

static celspan_status index_tiles(tiles_rows *rows, celspan_context *context) {
  const tiles_source *source = (const tiles_source *)rows->base.source;
  reader r = {.context = context,
              .input = rows->input,
              .name = source->member.name,
              .bytes = rows->bytes,
              .size = rows->size};
  int32_t count;
  CS_TRY(read_head(&r, source->form.pixel_size, &count));
  if ((size_t)count > rows->size / 8) /* the shortest line of a tile, and one byte */
    return fail(&r, CELSPAN_INPUT, "there are fewer tiles than the head declares");
  if (count == 0)
    return CELSPAN_OK;
  rows->tiles = cs_mem_array(rows->base.memory, (size_t)count, sizeof *rows->tiles);
  if (!rows->tiles)
    return cs_fail_memory(context);
  rows->count = (size_t)count;
  for (size_t i = 0; i < rows->count; i++) {
    tile *found = &rows->tiles[i];
    CS_TRY(read_tile(&r, source->form.pixel_size, found));
    found->x -= source->form.x;
    found->y -= source->form.y;
    if (found->x < 0 || found->y < 0 || found->x >= source->form.width ||
        found->y >= source->form.height)
      return fail(&r, CELSPAN_INPUT, "the tiles have changed since the painting was read");
  }
  qsort(rows->tiles, rows->count, sizeof *rows->tiles, compare);
  return CELSPAN_OK;
}

/* Unpacks a tile into the pixels in order. */
static bool unpack(tiles_rows *rows, const tile *t, size_t pixel_size) {
  const unsigned char *from = rows->bytes + t->at;
  size_t size = SIDE * SIDE * pixel_size;
  if (from[0] == 0 && t->count == size + 1)
    memcpy(rows->pixels, from + 1, size);
  if (from[0] == 0)
    return t->count == size + 1;
  if (from[0] != 1 || !unpack_lzf(from + 1, t->count - 1, rows->planes, size))
    return false;
  for (size_t i = 0; i < size; i++)
    rows->pixels[i % (SIDE * SIDE) * pixel_size + i / (SIDE * SIDE)] = rows->planes[i];
  return true;
}

static void put_tile(const tiles_rows *rows, const tile *t, size_t pixel_size) {
  size_t stride = (size_t)rows->base.source->width * pixel_size, right = (size_t)t->x + SIDE;
  size_t width = (size_t)rows->base.source->width;
  size_t count = (right < width ? SIDE : width - (size_t)t->x) * pixel_size;
  for (size_t y = 0; y < SIDE; y++)
    memcpy(rows->tile_row + y * stride + (size_t)t->x * pixel_size,
           rows->pixels + y * SIDE * pixel_size, count);
}

static void clear_tile_row(const tiles_rows *rows, const cs_krita_tiles_form *form) {
  size_t pixels = (size_t)SIDE * (size_t)form->width, size = (size_t)form->pixel_size;
  for (size_t i = 0; i < pixels; i++)
    memcpy(rows->tile_row + i * size, form->beyond, size);
}

static celspan_status fill_tile_row(tiles_rows *rows, celspan_context *context) {
  const tiles_source *source = (const tiles_source *)rows->base.source;
  clear_tile_row(rows, &source->form);
  for (; rows->next < rows->count && rows->tiles[rows->next].y < rows->y + SIDE; rows->next++) {
    const tile *t = &rows->tiles[rows->next];
    if (!unpack(rows, t, (size_t)source->form.pixel_size))
      return cs_input_fail(context, rows->input, -1, CELSPAN_INPUT,
                           "%s: byte %zu: a tile is damaged", source->member.name, t->at);
    put_tile(rows, t, (size_t)source->form.pixel_size);
  }
  return CELSPAN_OK;
}

/* Converts pixel x of a row of tiles to the form of the rows. */
static void convert(const cs_krita_tiles_form *form, const unsigned char *from, void *row,
                    size_t x) {
  static const int colour[] = {2, 1, 0, 3}, grey[] = {0, 0, 0, 1};
  const int *order = form->is_grey ? grey : colour;
  for (size_t c = 0; c < 4; c++) {
    const unsigned char *value = from + order[c] * (form->bits / 8);
    uint16_t wide = (uint16_t)(value[0] | (form->bits == 16 ? value[1] << 8 : 0));
    if (form->bits == 16)
      memcpy((unsigned char *)row + 8 * x + 2 * c, &wide, sizeof wide);
    else
      ((unsigned char *)row)[4 * x + c] = (unsigned char)wide;
  }
}

static celspan_status next(cs_rows *base, celspan_context *context, void *row) {
  tiles_rows *rows = (tiles_rows *)base;
  const cs_krita_tiles_form *form = &((const tiles_source *)base->source)->form;
  if (rows->y % SIDE == 0)
    CS_TRY(fill_tile_row(rows, context));
  size_t width = (size_t)base->source->width, size = (size_t)form->pixel_size;
  const unsigned char *from = rows->tile_row + (size_t)(rows->y % SIDE) * width * size;
  for (size_t x = 0; x < width; x++)
    convert(form, from + x * size, row, x);
  rows->y++;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static size_t tile_size(const cs_krita_tiles_form *form) {
  return (size_t)SIDE * SIDE * (size_t)form->pixel_size;
}

static size_t tile_row_size(const cs_krita_tiles_form *form) {
  return (size_t)SIDE * (size_t)form->width * (size_t)form->pixel_size;
}

static void end(cs_rows *base) {
  tiles_rows *rows = (tiles_rows *)base;
  const cs_krita_tiles_form *form = &((const tiles_source *)base->source)->form;
  cs_mem_free(base->memory, rows->bytes, rows->size + 1);
  cs_mem_free(base->memory, rows->tiles, rows->count * sizeof *rows->tiles);
  cs_mem_free(base->memory, rows->tile_row, tile_row_size(form));
  cs_mem_free(base->memory, rows->planes, tile_size(form));
  cs_mem_free(base->memory, rows->pixels, tile_size(form));
  cs_mem_free(base->memory, rows, sizeof *rows);
}

static celspan_status open(tiles_rows *rows, celspan_context *context) {
  const tiles_source *source = (const tiles_source *)rows->base.source;
  cs_memory *memory = rows->base.memory;
  rows->tile_row = cs_mem_resize(memory, NULL, 0, tile_row_size(&source->form));
  rows->planes = cs_mem_resize(memory, NULL, 0, tile_size(&source->form));
  rows->pixels = cs_mem_resize(memory, NULL, 0, tile_size(&source->form));
  if (!rows->tile_row || !rows->planes || !rows->pixels)
    return cs_fail_memory(context);
  CS_TRY(cs_zip_load(context, rows->input, &source->member, CS_KRITA_TILES_BYTES, &rows->bytes,
                     &rows->size));
  return index_tiles(rows, context);
}

static celspan_status begin(const cs_rows_source *source, celspan_context *context,
                            const cs_input *input, cs_rows **out) {
  tiles_rows *rows = cs_mem_array(source->memory, 1, sizeof *rows);
  if (!rows)
    return cs_fail_memory(context);
  rows->base = (cs_rows){source, source->memory};
  rows->input = input;
  celspan_status status = open(rows, context);
  return CS_GIVE(status, &rows->base, end, out);
}

static void destroy(cs_rows_source *source) {
  cs_mem_free(source->memory, source, sizeof(tiles_source));
}

static const cs_rows_kind kind = {begin, next, end, destroy};

/* Reads the places of the tiles, not their pixels. */
static celspan_status scan(celspan_context *context, const cs_input *input,
                           const cs_zip_member *member, cs_krita_tiles_form *form, bool *is_empty) {
  cs_zip_stream stream;
  CS_TRY(cs_zip_open(context, input, member, &stream));
  reader r = {.context = context, .input = input, .name = member->name, .stream = stream.bytes};
  bounds found = {0, 0, 0, 0};
  celspan_status status = find_bounds(&r, form->pixel_size, &found);
  cs_zip_close(&stream);
  CS_TRY(status);
  form->scanned = (int64_t)r.at;
  if (!is_beyond_clear(form)) {
    int64_t x = form->x, y = form->y;
    /* Rows of tiles begin where tiles do. */
    x -= (x % SIDE + SIDE) % SIDE;
    y -= (y % SIDE + SIDE) % SIDE;
    include(&found, x, y, (int64_t)form->x + form->width, (int64_t)form->y + form->height);
  }
  *is_empty = found.x0 >= found.x1;
  return *is_empty ? CELSPAN_OK : set_rectangle(&r, &found, form);
}

celspan_status cs_krita_tiles_create(celspan_context *context, const cs_input *input,
                                     const cs_zip_member *member, cs_krita_tiles_form *form,
                                     cs_rows_source **out) {
  bool is_empty;
  CS_TRY(scan(context, input, member, form, &is_empty));
  if (is_empty)
    return CELSPAN_OK;
  tiles_source *source;
  CS_TRY(CS_MAKE(context, source, 1));
  *source = (tiles_source){.base = {&kind, context->memory, form->width, form->height, form->bits},
                           .member = *member,
                           .form = *form};
  source->member.name = "the tiles of a layer"; /* the archive's table is freed earlier */
  *out = &source->base;
  return CELSPAN_OK;
}
