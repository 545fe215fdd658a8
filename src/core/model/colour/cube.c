#include "model/colour/cube.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/cache.h"
#include "base/counted.h"
#include "base/decimal.h"
#include "base/error_text.h"
#include "base/number.h"
#include "base/open.h"
#include "base/tried.h"

/* bytes of tables that are kept although no grade uses them now */
#define BUDGET ((size_t)64 << 20)
#define FILE_MOST ((off_t)1 << 30) /* bytes; enough for the largest possible table */
#define ROW_LEAST 6                /* bytes of a row, "0 0 0" and its end */

/* ---------------------------------------------------------------- words of a file */

typedef struct reader {
  celspan_context *context;
  const char *file;
  const char *text, *end; /* the text that has not been read; a zero byte is at `end` */
  size_t line;
  cs_cube *cube;
  size_t filled; /* values that have been read */
} reader;

static celspan_status fail_line(const reader *r, const char *sentence) {
  return cs_fail(r->context, CELSPAN_INPUT, "%s:%zu: %s", r->file, r->line, sentence);
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

static void skip_blanks(reader *r) {
  while (is_blank(*r->text))
    r->text++;
}

static bool is_line_end(const reader *r) { return r->text >= r->end || *r->text == '\n'; }

static void skip_line(reader *r) {
  while (!is_line_end(r))
    r->text++;
  r->text += r->text < r->end;
}

/* Whether the line begins with the word; if so, skips the word. */
static bool take_word(reader *r, const char *word) {
  size_t length = strlen(word);
  if ((size_t)(r->end - r->text) < length || memcmp(r->text, word, length) != 0 ||
      !(r->text + length == r->end || is_blank(r->text[length]) || r->text[length] == '\n'))
    return false;
  r->text += length;
  return true;
}

static celspan_status take_numbers(reader *r, int count, double *out) {
  for (int i = 0; i < count; i++) {
    skip_blanks(r);
    const char *after = is_line_end(r) ? NULL : cs_decimal_read(r->text, &out[i]);
    if (!after || !(is_blank(*after) || *after == '\n' || after == r->end))
      return fail_line(r, count == 3 ? "there must be three numbers here"
                                     : "there must be a number here");
    if (!(fabs(out[i]) <= CS_NUMBER_LIMIT))
      return fail_line(r, "a number is too large; they must be between -1e12 and 1e12");
    r->text = after;
  }
  skip_blanks(r);
  return is_line_end(r) ? CELSPAN_OK : fail_line(r, "there are more numbers than belong here");
}

/* ---------------------------------------------------------------- lines */

static celspan_status take_size(reader *r, bool is_solid) {
  double side, most = is_solid ? CS_CUBE_3D_MOST : CS_CUBE_1D_MOST;
  cs_cube *cube = r->cube;
  if (cube->values)
    return fail_line(r, "a second table begins here; a file may have one, of one or of three "
                        "dimensions");
  CS_TRY(take_numbers(r, 1, &side));
  if (!(side >= 2 && side <= most) || side != floor(side))
    return fail_line(r, is_solid ? "LUT_3D_SIZE must be a whole number from 2 to 256"
                                 : "LUT_1D_SIZE must be a whole number from 2 to 65536");
  cube->is_solid = is_solid;
  cube->side = (size_t)side;
  size_t count = is_solid ? cube->side * cube->side * cube->side : cube->side;
  if ((size_t)(r->end - r->text) / ROW_LEAST + 1 < count)
    return cs_fail(r->context, CELSPAN_INPUT,
                   "%s:%zu: the table must have %zu lines, but the file is too short for them",
                   r->file, r->line, count);
  CS_TRY(CS_MAKE(r->context, cube->values, count));
  cube->count = count;
  return CELSPAN_OK;
}

/* Reads one range for all channels: some programs write the domain in this form. */
static celspan_status take_range(reader *r) {
  double range[2];
  skip_blanks(r);
  CS_TRY(take_numbers(r, 2, range));
  for (int c = 0; c < 3; c++) {
    r->cube->domain[c] = range[0];
    r->cube->domain[3 + c] = range[1];
  }
  return CELSPAN_OK;
}

static celspan_status take_row(reader *r) {
  double row[3];
  if (!r->cube->values)
    return fail_line(r, "LUT_1D_SIZE or LUT_3D_SIZE must come before the table");
  CS_TRY(take_numbers(r, 3, row));
  if (r->filled == r->cube->count)
    return fail_line(r, r->cube->is_solid
                            ? "the table has more lines than LUT_3D_SIZE times itself twice"
                            : "the table has more lines than LUT_1D_SIZE");
  for (int c = 0; c < 3; c++)
    r->cube->values[r->filled][c] = (float)row[c];
  r->filled++;
  return CELSPAN_OK;
}

static celspan_status take_line(reader *r) {
  skip_blanks(r);
  if (is_line_end(r) || *r->text == '#' || take_word(r, "TITLE"))
    return CELSPAN_OK;
  if (take_word(r, "LUT_1D_SIZE"))
    return take_size(r, false);
  if (take_word(r, "LUT_3D_SIZE"))
    return take_size(r, true);
  if (take_word(r, "DOMAIN_MIN"))
    return take_numbers(r, 3, r->cube->domain);
  if (take_word(r, "DOMAIN_MAX"))
    return take_numbers(r, 3, r->cube->domain + 3);
  if (take_word(r, "LUT_1D_INPUT_RANGE") || take_word(r, "LUT_3D_INPUT_RANGE"))
    return take_range(r);
  bool is_word = (*r->text >= 'A' && *r->text <= 'Z') || (*r->text >= 'a' && *r->text <= 'z');
  return is_word
             ? fail_line(r, "this is no line of a .cube file; lines are a row of three numbers, "
                            "TITLE, LUT_1D_SIZE, LUT_3D_SIZE, DOMAIN_MIN or DOMAIN_MAX")
             : take_row(r);
}

static celspan_status check_whole(const reader *r) {
  const cs_cube *cube = r->cube;
  if (!cube->values)
    return fail_line(r, "the file ends without LUT_1D_SIZE or LUT_3D_SIZE");
  if (r->filled < cube->count)
    return cs_fail(
        r->context, CELSPAN_INPUT,
        "%s:%zu: the file ends after %zu of the %zu lines of its table, LUT_%dD_SIZE %zu", r->file,
        r->line, r->filled, cube->count, cube->is_solid ? 3 : 1, cube->side);
  for (int c = 0; c < 3; c++)
    if (!(cube->domain[c] < cube->domain[3 + c]))
      return cs_fail(r->context, CELSPAN_INPUT,
                     "%s: DOMAIN_MIN must be less than DOMAIN_MAX in each channel", r->file);
  return CELSPAN_OK;
}

static void hash_cube(cs_cube *cube) {
  cs_hash hash = cs_hash_begin(cube->is_solid);
  cs_hash_word(&hash, cube->side);
  cs_hash_numbers(&hash, cube->domain, 6);
  for (size_t i = 0; i < cube->count; i++)
    for (int c = 0; c < 3; c++)
      cs_hash_number(&hash, (double)cube->values[i][c]);
  cube->hash = cs_hash_end(hash);
}

static celspan_status parse(reader *r) {
  while (r->text < r->end) {
    r->line++;
    CS_TRY(take_line(r));
    skip_line(r);
  }
  CS_TRY(check_whole(r));
  hash_cube(r->cube);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- files */

static celspan_status fail_file(celspan_context *context, const char *file, int error) {
  const char *tried = cs_tried_find(context, file);
  char text[CS_ERROR_TEXT_SIZE];
  return cs_fail(context, CELSPAN_INPUT, "%s: %s%s%s", file, cs_error_text(error, text),
                 tried ? "; also looked for at " : "", tried ? tried : "");
}

static celspan_status read_text(celspan_context *context, const char *file, char *text,
                                size_t size) {
  int descriptor = cs_open_to_read(file);
  ssize_t got = descriptor < 0 ? -1 : cs_open_read_at(descriptor, text, size, 0);
  int error = got < 0 ? errno : ENODATA;
  if (descriptor >= 0)
    close(descriptor);
  return got == (ssize_t)size ? CELSPAN_OK : fail_file(context, file, error);
}

static celspan_status read_cube(celspan_context *context, const char *file, size_t size,
                                cs_cube *cube) {
  char *text;
  CS_TRY(CS_MAKE(context, text, size + 1));
  reader r = {.context = context, .file = file, .text = text, .end = text + size, .cube = cube};
  celspan_status status = read_text(context, file, text, size);
  if (status == CELSPAN_OK)
    status = parse(&r);
  cs_mem_free(context->memory, text, size + 1);
  return status;
}

static celspan_status create(celspan_context *context, const char *file, size_t size,
                             cs_cube **out) {
  cs_cube *cube;
  CS_TRY(CS_COUNTED_MAKE(context, cube));
  for (int c = 0; c < 3; c++)
    cube->domain[3 + c] = 1;
  celspan_status status = read_cube(context, file, size, cube);
  return CS_GIVE(status, cube, cs_cube_unref, out);
}

static void destroy(cs_cube *cube) {
  cs_memory *memory = cube->memory;
  cs_mem_free(memory, cube->values, cube->count * sizeof *cube->values);
  cs_counted_free(memory, cube, sizeof *cube);
}

CS_COUNTED(cs_cube)

/* ---------------------------------------------------------------- the store */

typedef struct kept_cube {
  cs_cache_entry entry;
  cs_cube *cube;
} kept_cube;

typedef struct request {
  const char *file;
  size_t size;
} request;

static void clear_kept(cs_cache_entry *entry, cs_memory *memory) {
  (void)memory;
  cs_cube_unref(((kept_cube *)entry)->cube);
}

static celspan_status create_store(celspan_context *context, cs_service **out) {
  return cs_cache_service_create(context, sizeof(kept_cube), clear_kept, BUDGET, out);
}

static const cs_service_kind store_kind = {create_store, cs_cache_service_destroy,
                                           cs_cache_service_trim};

static celspan_status make_kept(void *user, celspan_context *context, cs_cache_entry *entry) {
  const request *wanted = user;
  kept_cube *kept = (kept_cube *)entry;
  CS_TRY(create(context, wanted->file, wanted->size, &kept->cube));
  entry->bytes = kept->cube->count * sizeof *kept->cube->values;
  return CELSPAN_OK;
}

static cs_cache_key key_of(const char *file, const struct stat *found) {
  cs_hash hash = cs_hash_begin(0);
  cs_hash_text(&hash, file);
  cs_hash_word(&hash, (uint64_t)found->st_ino);
  cs_hash_word(&hash, (uint64_t)found->st_dev);
  cs_hash_word(&hash, (uint64_t)found->st_mtim.tv_sec);
  cs_hash_word(&hash, (uint64_t)found->st_mtim.tv_nsec);
  hash = cs_hash_end(hash);
  return (cs_cache_key){hash.a, hash.b, (uint64_t)found->st_size};
}

celspan_status cs_cube_read(celspan_context *context, const char *file, cs_cube **out) {
  struct stat found;
  if (stat(file, &found) != 0)
    return fail_file(context, file, errno);
  if (!S_ISREG(found.st_mode))
    return cs_fail(context, CELSPAN_INPUT, "%s: is not a file; a table of colours must be one",
                   file);
  if (found.st_size > FILE_MOST)
    return cs_fail(context, CELSPAN_LIMIT,
                   "%s: the file has %" PRId64 " bytes; the limit is %" PRId64, file,
                   (int64_t)found.st_size, (int64_t)FILE_MOST);
  request wanted = {file, (size_t)found.st_size};
  cs_service *service;
  cs_cache_entry *entry;
  CS_TRY(cs_context_service(context, &store_kind, &service));
  CS_TRY(cs_cache_acquire(cs_cache_of(service), context, key_of(file, &found), make_kept, &wanted,
                          &entry));
  *out = cs_cube_ref(((kept_cube *)entry)->cube);
  cs_cache_unpin(cs_cache_of(service), entry);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- colours */

/* The place of a colour in one channel of the table: the index of the value before it, and how far
 * it is from there. */
typedef struct place {
  size_t index;
  double part;
} place;

static place find(const cs_cube *cube, int channel, double value) {
  double low = cube->domain[channel], high = cube->domain[3 + channel];
  double at = cs_number_clamp((value - low) / (high - low), 0, 1) * (double)(cube->side - 1);
  size_t index = (size_t)at < cube->side - 2 ? (size_t)at : cube->side - 2;
  return (place){index, at - (double)index};
}

static double between(double a, double b, double u) { return a + (b - a) * u; }

/* Interpolates channel c between two neighbours along red. */
static double along_red(const cs_cube *cube, size_t at, double part, int c) {
  return between((double)cube->values[at][c], (double)cube->values[at + 1][c], part);
}

static double in_solid(const cs_cube *cube, const place places[3], int c) {
  size_t side = cube->side, plane = side * side;
  size_t at = places[0].index + side * places[1].index + plane * places[2].index;
  double red = places[0].part, green = places[1].part;
  double near = between(along_red(cube, at, red, c), along_red(cube, at + side, red, c), green);
  double far = between(along_red(cube, at + plane, red, c),
                       along_red(cube, at + plane + side, red, c), green);
  return between(near, far, places[2].part);
}

void cs_cube_apply(const cs_cube *cube, double colour[3]) {
  place places[3];
  for (int c = 0; c < 3; c++)
    places[c] = find(cube, c, colour[c]);
  for (int c = 0; c < 3; c++)
    colour[c] = cube->is_solid ? in_solid(cube, places, c)
                               : along_red(cube, places[c].index, places[c].part, c);
}
