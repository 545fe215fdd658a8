/* Pictures for verbs in Lua: facts of files, differences, and frames as pictures.
 *
 * Whether two pictures show the same is decided row by row, span by span. Coded values are
 * compared: sRGB, straight, at 16 bits when both pictures hold integers and as floats when one of
 * them does not.
 */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "celspan/plane.h"
#include "common/difference.h"
#include "inside/colour.h"
#include "inside/context.h"
#include "inside/files.h"
#include "inside/pictures.h"
#include "inside/sinks.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/lua_film.h"
#include "process/interrupt.h"
#include "program/film/service.h"
#include "program/film/shown.h"
#include "program/film/view.h"
#include "program/outputs/outputs.h"
#include "program/outputs/target.h"
#include "writers/still/still.h"

/* ---------------------------------------------------------------- what a picture holds */

typedef struct picture {
  celspan_context *context;
  const cs_picture_module *module;
  cs_picture_reader *reader;
  cs_picture_part *parts;
  size_t count, capacity;
  celspan_status status; /* the status of adding a part */
} picture;

static int close_picture(lua_State *L) {
  picture *p = lua_touserdata(L, 1);
  if (p->reader)
    p->module->close(p->reader);
  p->reader = NULL;
  if (p->parts)
    cs_mem_free(p->context->memory, p->parts, p->capacity * sizeof *p->parts);
  p->parts = NULL;
  return 0;
}

static bool add_part(void *user, const cs_picture_part *part) {
  picture *p = user;
  p->status = CS_RESERVE(p->context, p->parts, p->capacity, p->count + 1);
  if (p->status == CELSPAN_OK)
    p->parts[p->count++] = *part;
  return p->status == CELSPAN_OK;
}

static celspan_status read_picture(picture *p, const char *path, cs_picture_header *header) {
  const cs_picture_request request = {.file = path};
  cs_picture_failure failure;
  CS_TRY(cs_store_module(p->context, CELSPAN_INPUT, &p->module));
  celspan_status status = p->module->open(&request, &p->reader, header, &failure);
  if (status == CELSPAN_OK)
    status = p->module->list(p->reader, add_part, p, &failure);
  return status == CELSPAN_OK ? p->status : cs_fail(p->context, status, "%s", failure.text);
}

/* Pushes the subimages, and the layers of the first subimage, which are not subimages. */
static void push_parts(lua_State *L, const picture *p) {
  lua_createtable(L, (int)p->count, 0);
  for (size_t i = 0; i < p->count; i++) {
    const cs_picture_part *part = &p->parts[i];
    lua_createtable(L, 0, 6);
    if (part->subimage >= 0)
      cs_put_integer(L, "subimage", part->subimage);
    cs_put_text(L, "name", part->name);
    cs_put_integer(L, "width", part->width);
    cs_put_integer(L, "height", part->height);
    cs_put_integer(L, "channels", part->channels);
    cs_put_text(L, "depth", part->depth);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* Sets what the header says of colours. */
static void push_meaning(lua_State *L, const cs_picture_header *header) {
  cs_put_text(L, "colour", header->info.colour);
  lua_pushboolean(L, header->names_colour);
  lua_setfield(L, -2, "named");
  if (header->space[0])
    cs_put_text(L, "space", header->space);
  if (header->profile[0])
    cs_put_text(L, "profile", header->profile);
  if (!header->has_primaries)
    return;
  double unused[9];
  bool is_light = cs_primaries_to_bt709(header->primaries, unused);
  const char *name = cs_primaries_name(header->primaries);
  cs_put_text(L, "primaries", name ? name : is_light ? "other" : "none");
  if (!is_light)
    return;
  lua_createtable(L, CS_PRIMARIES, 0);
  for (int i = 0; i < CS_PRIMARIES; i++) {
    lua_pushnumber(L, (lua_Number)header->primaries[i]);
    lua_rawseti(L, -2, i + 1);
  }
  lua_setfield(L, -2, "chromaticities");
}

/* picture(path)
 *   -> { format =, width =, height =, channels =, alpha =, colour =, named =, space =,
 *        chromaticities =, primaries =, bytes =, parts = }
 *
 * alpha is nil, "straight" or "premultiplied". named: whether the file says its colour. space: the
 * name of one that celspan does not have. chromaticities: eight numbers, which `primaries` names.
 * The last three are nil if the file does not have them. */
static int read_facts(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  picture *p = cs_userdata_push_holder(L, "celspan.program.picture", sizeof *p, close_picture);
  p->context = cs_service_session(L)->context;
  cs_picture_header header;
  cs_service_try(L, read_picture(p, path, &header));
  bool is_premultiplied = header.alpha == CS_PICTURE_ALPHA_CODED;
  lua_createtable(L, 0, 12);
  cs_put_text(L, "format", header.info.format);
  cs_put_integer(L, "width", header.info.width);
  cs_put_integer(L, "height", header.info.height);
  cs_put_integer(L, "channels", header.info.channels);
  if (header.info.has_alpha)
    cs_put_text(L, "alpha", is_premultiplied ? "premultiplied" : "straight");
  push_meaning(L, &header);
  cs_put_integer(L, "bytes", header.file_size);
  push_parts(L, p);
  lua_setfield(L, -2, "parts");
  return 1;
}

CS_HOLDER_RELEASE(close_spans, cs_span_reader, cs_span_reader_close)

/* spans(path) -> counts for the whole file */
static int read_spans(lua_State *L) {
  celspan_context *context = cs_service_session(L)->context;
  cs_span_reader **file =
      cs_userdata_push_holder(L, "celspan.program.spans", sizeof(cs_span_reader *), close_spans);
  spanfile_counts counts;
  cs_service_try(L, cs_span_reader_open(context, luaL_checkstring(L, 1), file));
  cs_service_try(L, cs_span_reader_check(*file, &counts));
  spanfile_info info = cs_span_reader_info(*file);
  lua_createtable(L, 0, 10);
  cs_put_integer(L, "width", info.width);
  cs_put_integer(L, "height", info.height);
  cs_put_text(L, "depth", info.format == SPANFILE_HALF ? "half" : "8");
  cs_put_integer(L, "bytes", (int64_t)cs_span_reader_bytes(*file));
  cs_put_integer(L, "rows_same", (int64_t)counts.same_rows);
  cs_put_integer(L, "rows_moved", (int64_t)counts.moved_rows);
  cs_put_integer(L, "rows_literal", (int64_t)counts.literal_rows);
  cs_put_integer(L, "runs", (int64_t)counts.spans[SPANFILE_RUN]);
  cs_put_integer(L, "raw_spans", (int64_t)counts.spans[SPANFILE_RAW]);
  cs_put_integer(L, "gradients", (int64_t)counts.spans[SPANFILE_GRADIENT]);
  return 1;
}

CS_HOLDER_RELEASE(close_plane, celspan_plane, celspan_plane_unref)

/* Reads all frames of a plane's file. Returns its number of pictures: the last frame knows all of
 * them. */
static int64_t check_frames(lua_State *L, const char *path, const celspan_plane *plane) {
  celspan_context *context = cs_service_session(L)->context;
  double rate;
  int64_t pictures = (int64_t)cs_plane_count(plane).pictures;
  celspan_plane **other =
      cs_userdata_push_holder(L, "celspan.program.plane", sizeof(celspan_plane *), close_plane);
  for (int32_t frame = 1; frame < celspan_plane_frames(plane, &rate); frame++) {
    cs_service_try(L, cs_plane_choose(context, path, plane, frame, other));
    pictures = (int64_t)cs_plane_count(*other).pictures;
    celspan_plane_unref(*other);
    *other = NULL;
  }
  lua_pop(L, 1);
  return pictures;
}

/* plane(path) -> counts for the whole file; `pictures`: of all frames, otherwise of the first */
static int read_plane(lua_State *L) {
  celspan_context *context = cs_service_session(L)->context;
  const char *path = luaL_checkstring(L, 1);
  celspan_plane **plane =
      cs_userdata_push_holder(L, "celspan.program.plane", sizeof(celspan_plane *), close_plane);
  cs_service_try(L, celspan_plane_read(context, path, plane));
  cs_plane_facts facts = cs_plane_count(*plane);
  double width, height, rate;
  int64_t pictures = check_frames(L, path, *plane);
  celspan_plane_size(*plane, &width, &height);
  lua_createtable(L, 0, 12);
  cs_put_integer(L, "pictures", pictures);
  cs_put_integer(L, "frames", celspan_plane_frames(*plane, &rate));
  cs_put_number(L, "fps", rate);
  cs_put_number(L, "width", width);
  cs_put_number(L, "height", height);
  cs_put_integer(L, "bytes", (int64_t)celspan_plane_bytes(*plane));
  cs_put_integer(L, "bands", (int64_t)facts.parts);
  cs_put_integer(L, "borders", (int64_t)facts.borders);
  cs_put_integer(L, "curves", (int64_t)facts.curves);
  cs_put_integer(L, "colours", (int64_t)facts.colours);
  cs_put_integer(L, "gradients", (int64_t)facts.gradients);
  lua_pushboolean(L, celspan_plane_is_opaque(*plane));
  lua_setfield(L, -2, "opaque");
  return 1;
}

/* ---------------------------------------------------------------- two pictures, row by row */

typedef struct comparison {
  celspan_coding coding;
  int32_t width, height;
  double tolerance;
  double largest;
  int32_t x, y; /* the place of the largest difference */
  int channel;
  uint64_t differing; /* pixels */
  uint8_t *picture;   /* with -o: a row of the picture of differences; borrowed */
  float *linear;      /* with -o: the same row for its sink; borrowed */
} comparison;

static double value(const comparison *c, const void *row, size_t i) {
  return c->coding.depth == CELSPAN_DEPTH_16 ? ((const uint16_t *)row)[i] / 65535.0
                                             : (double)((const float *)row)[i];
}

static double difference(double a, double b) {
  if (isnan(a) || isnan(b))
    return isnan(a) && isnan(b) ? 0 : (double)INFINITY;
  return a == b ? 0 : fabs(a - b); /* equal infinities are equal */
}

/* Compares coded pixels from column x0 on. Each pixel counts as `times` columns. */
static void compare_pixels(comparison *c, int32_t x0, int32_t y, int32_t count, int32_t times,
                           const void *pixels_a, const void *pixels_b) {
  for (int32_t x = 0; x < count; x++) {
    bool differs = false;
    double most = 0;
    for (int channel = 0; channel < 4; channel++) {
      size_t i = 4 * (size_t)x + (size_t)channel;
      double d = difference(value(c, pixels_a, i), value(c, pixels_b, i));
      differs |= d > c->tolerance;
      most = d > most ? d : most;
      if (d > c->largest) {
        c->largest = d;
        c->x = x0 + x;
        c->y = y;
        c->channel = channel;
      }
    }
    c->differing += differs ? (uint64_t)times : 0;
    if (differs && c->picture)
      cs_difference_mark(most, c->picture + 4 * (size_t)(x0 + x), (size_t)times);
  }
}

/* Codes `count` columns of a span, from column x on. */
static void code_columns(const comparison *c, const celspan_span *span, int32_t x, int32_t count,
                         void *pixels) {
  celspan_span columns = *span;
  columns.x0 = 0;
  columns.x1 = count;
  columns.origin = span->origin - x;
  if (span->kind == CELSPAN_SPAN_ARRAY)
    columns.array = span->array + 4 * (size_t)(x - span->x0);
  cs_pixels_row(&c->coding, &columns, 1, pixels);
}

/* Compares columns [x0, x1), which belong to a single span in each picture. If both spans have a
 * single colour, one pixel is enough. */
static void compare_columns(comparison *c, int32_t y, const celspan_span *a, const celspan_span *b,
                            int32_t x0, int32_t x1) {
  enum { CHUNK = 1024 };
  float pixels_a[4 * CHUNK], pixels_b[4 * CHUNK];
  bool is_even = a->kind == CELSPAN_SPAN_SINGLE && b->kind == CELSPAN_SPAN_SINGLE;
  if (is_even && memcmp(a->colour, b->colour, sizeof a->colour) == 0)
    return;
  for (int32_t x = x0, next; x < x1; x = next) {
    next = is_even || x1 - x < CHUNK ? x1 : x + CHUNK;
    int32_t count = is_even ? 1 : next - x;
    code_columns(c, a, x, count, pixels_a);
    code_columns(c, b, x, count, pixels_b);
    compare_pixels(c, x, y, count, is_even ? next - x : 1, pixels_a, pixels_b);
  }
}

/* Makes the row of the picture of differences, without any marks. */
static void begin_row(const comparison *c, const celspan_span *spans, size_t count) {
  static const celspan_coding coding = {.struct_size = sizeof coding,
                                        .depth = CELSPAN_DEPTH_8,
                                        .transfer = CELSPAN_TRANSFER_SRGB,
                                        .alpha = CELSPAN_ALPHA_STRAIGHT};
  cs_pixels_row(&coding, spans, count, c->picture);
  cs_difference_pale(c->picture, (size_t)c->width);
}

static celspan_status compare_row(comparison *c, int32_t y, cs_still_rows *rows_a,
                                  cs_still_rows *rows_b) {
  const celspan_span *a = NULL, *b = NULL;
  size_t count_a = 0, count_b = 0;
  celspan_status status = cs_still_rows_get(rows_a, y, &a, &count_a);
  if (status == CELSPAN_OK && c->picture)
    begin_row(c, a, count_a);
  if (status == CELSPAN_OK)
    status = cs_still_rows_get(rows_b, y, &b, &count_b);
  for (int32_t x = 0, next; x < c->width && status == CELSPAN_OK; x = next) {
    next = a->x1 < b->x1 ? a->x1 : b->x1;
    compare_columns(c, y, a, b, x, next);
    a += a->x1 == next;
    b += b->x1 == next;
  }
  return status;
}

/* Gives the row of the picture of differences to its sink, as codes that the sink does not
 * change. */
static celspan_status put_row(celspan_context *context, const comparison *c,
                              const celspan_sink *sink, int32_t y) {
  float *pixels = c->linear;
  for (size_t i = 0; i < 4 * (size_t)c->width; i++)
    pixels[i] = i % 4 == 3 ? 1 : cs_transfer_decode(CELSPAN_TRANSFER_SRGB, c->picture[i] / 255.0f);
  const celspan_span span = {.x1 = c->width, .kind = CELSPAN_SPAN_ARRAY, .array = pixels};
  return sink->row(sink->user, context, y, &span, 1);
}

/* sink: NULL without -o. */
static celspan_status compare_all(celspan_context *context, comparison *c, cs_still_rows *a,
                                  cs_still_rows *b, const celspan_sink *sink) {
  celspan_status status = sink ? sink->begin(sink->user, context, c->width, c->height) : CELSPAN_OK;
  for (int32_t y = 0; y < c->height && status == CELSPAN_OK; y++) {
    status = cs_interrupt_signal() ? CELSPAN_CANCELLED : compare_row(c, y, a, b);
    if (status == CELSPAN_OK && sink)
      status = put_row(context, c, sink, y);
  }
  return sink ? sink->end(sink->user, context, status) : status;
}

/* sink: NULL without -o; it is ended in any case. */
static celspan_status compare_stills(celspan_context *context, comparison *c,
                                     const celspan_sink *sink, const cs_still *still_a,
                                     const celspan_frame_desc *frame_a, const cs_still *still_b,
                                     const celspan_frame_desc *frame_b) {
  cs_still_rows a = {NULL, NULL, NULL}, b = a;
  celspan_status status = cs_still_rows_create(context, still_a, frame_a, &a);
  if (status == CELSPAN_OK)
    status = cs_still_rows_create(context, still_b, frame_b, &b);
  if (status == CELSPAN_OK)
    status = compare_all(context, c, &a, &b, sink);
  else if (sink)
    status = sink->end(sink->user, context, status);
  cs_still_rows_destroy(&a);
  cs_still_rows_destroy(&b);
  return status;
}

/* Allocates the rows and the sink for -o, if it was given, and compares. */
static celspan_status compare_into(celspan_context *context, comparison *c, const char *output,
                                   const cs_still *still_a, const celspan_frame_desc *frame_a,
                                   const cs_still *still_b, const celspan_frame_desc *frame_b) {
  if (!output)
    return compare_stills(context, c, NULL, still_a, frame_a, still_b, frame_b);
  size_t channels = 4 * (size_t)c->width;
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_sink sink = CELSPAN_SINK;
  file.is_opaque = true;
  c->picture = cs_mem_array(context->memory, channels, sizeof *c->picture);
  c->linear = cs_mem_array(context->memory, channels, sizeof *c->linear);
  celspan_status status = c->picture && c->linear
                              ? celspan_file_sink_create(context, output, &file, &sink)
                              : cs_fail_memory(context);
  if (status == CELSPAN_OK)
    status = compare_stills(context, c, &sink, still_a, frame_a, still_b, frame_b);
  cs_mem_free(context->memory, c->picture, channels * sizeof *c->picture);
  cs_mem_free(context->memory, c->linear, channels * sizeof *c->linear);
  return status;
}

static void push_answer(lua_State *L, const comparison *c) {
  lua_createtable(L, 0, 6);
  cs_put_number(L, "largest", c->largest);
  cs_put_integer(L, "x", c->x);
  cs_put_integer(L, "y", c->y);
  lua_pushlstring(L, &"rgba"[c->channel], 1);
  lua_setfield(L, -2, "channel");
  cs_put_integer(L, "differing", (int64_t)c->differing);
  cs_put_integer(L, "pixels", (int64_t)c->width * c->height);
}

static void push_sizes(lua_State *L, const cs_still stills[2]) {
  lua_createtable(L, 0, 1);
  lua_createtable(L, 4, 0);
  for (int i = 0; i < 2; i++) {
    lua_pushinteger(L, stills[i].info.width);
    lua_rawseti(L, -2, 2 * i + 1);
    lua_pushinteger(L, stills[i].info.height);
    lua_rawseti(L, -2, 2 * i + 2);
  }
  lua_setfield(L, -2, "sizes");
}

static int close_stills(lua_State *L) {
  cs_still *stills = lua_touserdata(L, 1);
  cs_still_close(&stills[0]);
  cs_still_close(&stills[1]);
  return 0;
}

/* A plane has no size of its own: it gets the size of the other picture. */
static void fit_plane(cs_still stills[2]) {
  for (int i = 0; i < 2; i++)
    if (stills[i].plane && !stills[1 - i].plane) {
      stills[i].info.width = stills[1 - i].info.width;
      stills[i].info.height = stills[1 - i].info.height;
    }
}

/* Opens one of two pictures. --frame is the frame of a plane file. */
static void open_compared(lua_State *L, const char *path, cs_still *out) {
  const cs_session *session = cs_service_session(L);
  cs_service_require(
      L, cs_shown_open(session->context, session->request, path, cs_plane_accepts(path), out));
}

/* Chooses how values are compared: with a plane, multiplied by alpha, because a picture rounds the
 * colours of nearly clear pixels. */
static celspan_coding coding_of(const cs_still stills[2]) {
  bool is_float = stills[0].info.is_float || stills[1].info.is_float;
  bool has_plane = stills[0].plane || stills[1].plane;
  return (celspan_coding){.struct_size = sizeof(celspan_coding),
                          .depth = is_float ? CELSPAN_DEPTH_FLOAT : CELSPAN_DEPTH_16,
                          .transfer = CELSPAN_TRANSFER_SRGB,
                          .alpha =
                              has_plane ? CELSPAN_ALPHA_PREMULTIPLIED : CELSPAN_ALPHA_STRAIGHT};
}

/* compare(a, b, difference or nil) -> { largest =, x =, y =, channel =, differing =, pixels = }, or
 * { sizes = { w, h, w, h } } if the sizes differ */
static int compare(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  const char *output = luaL_optstring(L, 3, NULL);
  cs_still *stills =
      cs_userdata_push_holder(L, "celspan.program.stills", 2 * sizeof *stills, close_stills);
  celspan_frame_desc frames[2];
  for (int i = 0; i < 2; i++)
    open_compared(L, luaL_checkstring(L, i + 1), &stills[i]);
  fit_plane(stills);
  const celspan_picture_info *a = &stills[0].info, *b = &stills[1].info;
  if (a->width != b->width || a->height != b->height) {
    push_sizes(L, stills);
    return 1;
  }
  for (int i = 0; i < 2; i++)
    cs_service_require(L, cs_shown_frame(session->request, &stills[i], &frames[i]));
  comparison c = {.coding = coding_of(stills), .width = a->width, .height = a->height};
  cs_request_read(session->request, "--fail", &c.tolerance);
  cs_service_try(L, compare_into(session->context, &c, output, &stills[0], &frames[0], &stills[1],
                                 &frames[1]));
  push_answer(L, &c);
  return 1;
}

static int finish_frame(lua_State *L) {
  cs_film_frame_finish(lua_touserdata(L, 1));
  return 0;
}

/* Describes the first frame of a film, or of a rostrum that has a size, which is argument 1, under
 * the request. Pushes what the frame is made of. */
static void expose_first(lua_State *L, celspan_frame_desc *out) {
  const cs_session *session = cs_service_session(L);
  cs_film_info film;
  luaL_argcheck(L, cs_lua_film_push(L, 1), 1, "must be a film or a rostrum");
  const int index = lua_gettop(L);
  cs_lua_film_read(L, index, &film);
  cs_film_frame *frame =
      cs_userdata_push_holder(L, "celspan.program.frame", sizeof *frame, finish_frame);
  cs_service_require(L, cs_view_frame(session->request, film.width, film.height, out));
  cs_service_try(L, cs_lua_film_build(L, index, film.first, frame));
  cs_film_expose(&film, frame, out);
}

/* write(film, path): writes the first frame of a film, or a rostrum that has a size, as a picture
 * under the request. */
static int write_frame(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  const char *path = luaL_checkstring(L, 2);
  celspan_coding coding;
  celspan_file_desc file = cs_target_file(session->request, &coding);
  celspan_frame_desc desc;
  expose_first(L, &desc);
  const cs_output *output = cs_output_of(session->request, path, 1);
  const cs_page page = {.frame = &desc, .path = path, .file = &file};
  cs_service_try(L, output && output->write
                        ? output->write(session->context, session->request, output, &page)
                        : celspan_frame_write(session->context, &desc, path, &file, NULL));
  return 0;
}

/* ---------------------------------------------------------------- a picture in memory */

typedef struct open_file {
  celspan_context *context;
  cs_file *file;
} open_file;

static int discard_file(lua_State *L) {
  open_file *open = lua_touserdata(L, 1);
  cs_file_discard(open->file, open->context);
  open->file = NULL;
  return 0;
}

static celspan_status draw_png(const open_file *open, const celspan_frame_desc *desc,
                               const char *path) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coding = CELSPAN_CODING;
  celspan_sink sink;
  coding.depth = CELSPAN_DEPTH_8;
  coding.space = desc->space;
  file.coding = &coding;
  file.is_opaque = celspan_frame_is_opaque(desc);
  file.workers = desc->workers;
  CS_TRY(cs_sink_png_part(open->context, path, open->file, &file, &sink));
  return celspan_frame_render(open->context, desc, &sink, NULL);
}

static celspan_status read_back(const open_file *open, const char *path, void *bytes, size_t size) {
  const char *name;
  CS_TRY(cs_file_temporary(open->file, open->context, &name));
  int descriptor = cs_open_to_read(name);
  ssize_t got = descriptor < 0 ? -1 : cs_open_read_at(descriptor, bytes, size, 0);
  int error = errno;
  if (descriptor >= 0)
    close(descriptor);
  return got == (ssize_t)size
             ? CELSPAN_OK
             : cs_fail(open->context, CELSPAN_OUTPUT, "%s: cannot read it back: %s", path,
                       got < 0 ? strerror(error) : "bytes are missing");
}

/* png(film, path) -> the first frame of a film as the bytes of a PNG of 8 bits, its width, its
 * height. path: of the output of which it becomes a part; a temporary file is beside that. */
static int make_png(lua_State *L) {
  const char *path = luaL_checkstring(L, 2);
  celspan_frame_desc desc;
  expose_first(L, &desc);
  open_file *open =
      cs_userdata_push_holder(L, "celspan.program.open_file", sizeof *open, discard_file);
  open->context = cs_service_session(L)->context;
  cs_service_try(L, cs_file_create(open->context, NULL, path, &open->file));
  cs_service_try(L, draw_png(open, &desc, path));
  const size_t size = (size_t)cs_file_size(open->file);
  void *bytes = lua_newuserdatauv(L, size, 0);
  cs_service_try(L, read_back(open, path, bytes, size));
  cs_file_discard(open->file, open->context);
  open->file = NULL;
  lua_pushlstring(L, bytes, size);
  lua_pushinteger(L, desc.width);
  lua_pushinteger(L, desc.height);
  return 3;
}

const luaL_Reg cs_services_pictures[] = {
    {"picture", read_facts}, {"spans", read_spans}, {"plane", read_plane}, CS_SERVICE(compare),
    {"write", write_frame},  {"png", make_png},     {NULL, NULL}};
