/* program.compare(): whether two pictures show the same, row by row, span by span. Coded values are
 * compared: sRGB, straight, at 16 bits when both pictures hold integers and as floats when one of
 * them does not.
 */
#include <math.h>
#include <string.h>

#include "celspan/plane.h"
#include "common/difference.h"
#include "inside/colour.h"
#include "inside/context.h"
#include "inside/pictures.h"
#include "inside/sinks.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "process/interrupt.h"
#include "program/film/service.h"
#include "program/film/shown.h"
#include "writers/still/still.h"

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

const luaL_Reg cs_services_compare[] = {CS_SERVICE(compare), {NULL, NULL}};
