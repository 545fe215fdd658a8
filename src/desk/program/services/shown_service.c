/* program.shown(): a frame of a film, or the frame that a file shows, for the verbs that write it,
 * print its spans or cut it into tiles.
 *
 *   shown --> a file, pixels
 *         --> spans, counts
 *         --> pyramid, record of an earlier run --> tiles   (writers/tiles)
 */
#include <stdio.h>
#include <string.h>

#include "inside/clock.h"
#include "inside/context.h"
#include "inside/frames.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "program/film/script.h"
#include "program/film/service.h"
#include "program/film/shown.h"
#include "program/outputs/outputs.h"
#include "program/outputs/target.h"
#include "writers/tiles/tile_render.h"

#define PIXELS_MOST (1 << 26) /* pixels of a picture in memory */

typedef struct shown {
  celspan_context *context;
  bool is_film;
  cs_script script;         /* open if is_film */
  cs_still still;           /* open if it is not a film */
  celspan_frame_desc frame; /* the whole frame, under the options */
  cs_pyramid pyramid;       /* its texts are fields of the table in Lua */
  cs_tile_log log;
  cs_progress *progress; /* borrowed */
} shown;

static int close_shown(lua_State *L) {
  shown *s = lua_touserdata(L, 1);
  cs_tile_log_close(s->context, &s->log);
  if (s->is_film)
    cs_script_close(&s->script);
  else
    cs_still_close(&s->still);
  return 0;
}

static shown *self(lua_State *L) { return cs_service_opened(L); }

static celspan_status draw(void *user, const celspan_frame_desc *frame, const celspan_sink *sink) {
  const shown *s = user;
  return s->is_film ? celspan_frame_render(s->context, frame, sink, NULL)
                    : cs_still_render(s->context, &s->still, frame, sink);
}

/* ---------------------------------------------------------------- spans */

static void print_colour(const celspan_span *span, int32_t x) {
  float rgba[4];
  celspan_span_colour(span, x, rgba);
  printf(" %.9g %.9g %.9g %.9g", (double)rgba[0], (double)rgba[1], (double)rgba[2],
         (double)rgba[3]);
}

static void print_span(int32_t y, const celspan_span *span) {
  static const char *const kinds[] = {[CELSPAN_SPAN_SINGLE] = "single",
                                      [CELSPAN_SPAN_GRADIENT] = "gradient",
                                      [CELSPAN_SPAN_ARRAY] = "array"};
  printf("%d %d %d %s", y, span->x0, span->x1, kinds[span->kind]);
  if (span->kind == CELSPAN_SPAN_ARRAY)
    printf(" %d", span->x1 - span->x0);
  else
    print_colour(span, span->x0);
  if (span->kind == CELSPAN_SPAN_GRADIENT)
    print_colour(span, span->x1 - 1);
  putchar('\n');
}

static celspan_status print_row(void *user, celspan_context *context, int32_t y,
                                const celspan_span *spans, size_t span_count) {
  const int32_t *first_row = user;
  for (size_t i = 0; i < span_count; i++)
    print_span(*first_row + y, &spans[i]);
  (void)context;
  /* reported in the same way as for every text */
  return ferror(stdout) ? CELSPAN_OUTPUT : CELSPAN_OK;
}

/* The rows that are arguments 2 and 3, or all. They are a crop of full width, so that columns keep
 * their numbers. */
static celspan_frame_desc rows_of(lua_State *L) {
  celspan_frame_desc frame = self(L)->frame;
  if (lua_isnoneornil(L, 2))
    return frame;
  frame.crop_y = (int32_t)luaL_checkinteger(L, 2);
  frame.crop_width = frame.width;
  frame.crop_height = (int32_t)luaL_checkinteger(L, 3) - frame.crop_y + 1;
  return frame;
}

/* Ends the verb if the frame could not be made, or printed. */
static void require_frame(lua_State *L, const shown *s, celspan_status status) {
  cs_service_require(L, ferror(stdout) ? cs_report_flush_output(CS_EXIT_OK)
                        : s->is_film   ? cs_script_failure(&s->script, status)
                                       : cs_report_failure(s->context, status, NULL));
}

/* shown:print_spans(first, last): prints the spans of these rows, or of all. */
static int print_spans(lua_State *L) {
  celspan_frame_desc frame = rows_of(L);
  const celspan_sink sink = {.struct_size = sizeof sink, .user = &frame.crop_y, .row = print_row};
  require_frame(L, self(L), draw(self(L), &frame, &sink));
  return 0;
}

/* Pushes the names of the counts in their order, and each count under its name. */
static void push_counts(lua_State *L, const celspan_statistics *s, cs_cache_counts kept) {
  const struct {
    const char *name;
    uint64_t count;
  } all[] = {{"rows", s->rows},
             {"spans", s->spans},
             {"single", s->single},
             {"gradient", s->gradient},
             {"array", s->array},
             {"pixels_in_arrays", s->pixels_in_arrays},
             {"maps", s->maps},
             {"maps_made", s->maps_made},
             {"swept", s->swept},
             {"rows_held", s->rows_held},
             {"colour_evaluations", s->colour_evaluations},
             {"allocations", s->allocations},
             {"peak_bytes", s->peak_bytes},
             {"bands_made", kept.made},
             {"bands_found", kept.found},
             {"bands_bytes", kept.bytes}};
  lua_newtable(L);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    lua_pushstring(L, all[i].name);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
    cs_put_integer(L, all[i].name, (lua_Integer)all[i].count);
  }
}

/* shown:measure(first, last) -> the counts of these rows of a film, or of all; seconds */
static int measure(lua_State *L) {
  const shown *s = self(L);
  const celspan_frame_desc frame = rows_of(L);
  celspan_coding coding = {.struct_size = sizeof coding};
  const celspan_sink nowhere = {.struct_size = sizeof nowhere, .row = NULL};
  celspan_statistics counts = CELSPAN_STATISTICS;
  double started = cs_clock_seconds();
  bool has_pixels = cs_request_read(cs_service_session(L)->request, "--pixels", &coding.depth);
  require_frame(L, s,
                has_pixels ? celspan_frame_pixels(s->context, &frame, &coding, NULL, 0, &counts)
                           : celspan_frame_render(s->context, &frame, &nowhere, &counts));
  double seconds = cs_clock_seconds() - started;
  push_counts(L, &counts, cs_defocus_bands_count(s->context));
  lua_pushnumber(L, seconds);
  return 2;
}

/* ---------------------------------------------------------------- files and pixels */

/* shown:write(path): writes what a file shows to another file. */
static int write_shown(lua_State *L) {
  const shown *s = self(L);
  const cs_request *request = cs_service_session(L)->request;
  const char *path = luaL_checkstring(L, 2);
  const cs_output *output = cs_output_of(request, path, 1);
  celspan_coding coding;
  celspan_file_desc file = cs_target_file(request, &coding);
  const cs_page page = {.frame = &s->frame, .plane = s->still.plane, .path = path, .file = &file};
  cs_service_try(L, output->write ? output->write(s->context, request, output, &page)
                                  : cs_still_write(s->context, &s->still, &s->frame, path, &file));
  return 0;
}

/* shown:pixels(path) -> the picture that a file shows: RGBA of 16 bits, sRGB, straight; whether it
 * has alpha */
static int pixels(lua_State *L) {
  static const celspan_coding coding = {.struct_size = sizeof coding,
                                        .depth = CELSPAN_DEPTH_16,
                                        .transfer = CELSPAN_TRANSFER_SRGB,
                                        .alpha = CELSPAN_ALPHA_STRAIGHT};
  shown *s = self(L);
  const int width = s->frame.width, height = s->frame.height;
  const size_t stride = 4 * sizeof(uint16_t) * (size_t)width;
  celspan_sink sink = CELSPAN_SINK;
  if ((int64_t)width * height > PIXELS_MOST)
    cs_service_try(L, cs_fail(s->context, CELSPAN_LIMIT,
                              "%s: has %d x %d pixels, of which this verb takes %d at most",
                              luaL_checkstring(L, 2), width, height, PIXELS_MOST));
  void *bytes = lua_newuserdatauv(L, stride * (size_t)height, 0);
  cs_service_try(L, cs_sink_memory(s->context, &coding, bytes, stride, &sink));
  cs_service_try(L, draw(s, &s->frame, &sink));
  lua_pushlstring(L, bytes, stride * (size_t)height);
  lua_pushboolean(L, s->still.info.has_alpha);
  return 2;
}

/* ---------------------------------------------------------------- the pyramid */

/* Four whole numbers of the stack, from index on. */
static cs_pyramid_box box_at(lua_State *L, int index) {
  return (cs_pyramid_box){
      (int32_t)luaL_checkinteger(L, index), (int32_t)luaL_checkinteger(L, index + 1),
      (int32_t)luaL_checkinteger(L, index + 2), (int32_t)luaL_checkinteger(L, index + 3)};
}

static int32_t number_of(lua_State *L, const char *name) {
  lua_getfield(L, 2, name);
  int32_t number = (int32_t)lua_tointeger(L, -1);
  lua_pop(L, 1);
  return number;
}

/* shown:pyramid{ layout =, tile =, overlap =, folder =, name =, ending = } -> the top level, and
 * the highest that is a single tile */
static int pyramid(lua_State *L) {
  shown *s = self(L);
  s->pyramid =
      (cs_pyramid){.layout = strcmp(cs_service_text(L, "layout"), "iiif") == 0 ? CS_PYRAMID_IIIF
                                                                               : CS_PYRAMID_DZI,
                   .width = s->frame.width,
                   .height = s->frame.height,
                   .tile = number_of(L, "tile"),
                   .overlap = number_of(L, "overlap"),
                   .folder = cs_service_text(L, "folder"),
                   .name = cs_service_text(L, "name"),
                   .ending = cs_service_text(L, "ending")};
  lua_pushvalue(L, 2);
  lua_setfield(L, 1, "described");
  lua_pushinteger(L, cs_pyramid_top(&s->pyramid));
  lua_pushinteger(L, cs_pyramid_single(&s->pyramid));
  return 2;
}

/* shown:touched(level, x0, y0, x1, y1) -> the tiles of a level that these pixels of the frame
 * touch, by default those of --crop: the first column and row, and the ends */
static int touched(lua_State *L) {
  const shown *s = self(L);
  const celspan_frame_desc *frame = &s->frame;
  cs_pyramid_box box = {frame->crop_x, frame->crop_y, frame->crop_x + frame->crop_width,
                        frame->crop_y + frame->crop_height};
  bool is_part = frame->crop_width || !lua_isnoneornil(L, 3);
  if (!lua_isnoneornil(L, 3))
    box = box_at(L, 3);
  box = cs_pyramid_tiles(&s->pyramid, (int32_t)luaL_checkinteger(L, 2), is_part ? &box : NULL);
  lua_pushinteger(L, box.x0);
  lua_pushinteger(L, box.y0);
  lua_pushinteger(L, box.x1);
  lua_pushinteger(L, box.y1);
  return 4;
}

/* ---------------------------------------------------------------- the record */

static bool is_given(lua_State *L, const char *option) {
  return cs_request_has(cs_service_session(L)->request, option);
}

/* shown:find_tiles() -> which tiles are there: "nothing", the "same" as now, "other" tiles of an
 * earlier run, or "foreign" ones, of another program */
static int find_tiles(lua_State *L) {
  static const char *const states[] = {[CS_TILE_LOG_NEW] = "nothing",
                                       [CS_TILE_LOG_SAME] = "same",
                                       [CS_TILE_LOG_OTHER] = "other",
                                       [CS_TILE_LOG_FOREIGN] = "foreign"};
  shown *s = self(L);
  const cs_tile_inputs inputs = {.frame = &s->frame,
                                 .file = cs_service_session(L)->request->operands[0],
                                 .is_script = s->is_film,
                                 .given = s->script.given,
                                 .skips_empty = is_given(L, "--skip-empty"),
                                 .is_sparse = is_given(L, "--sparse")};
  cs_tile_log_state state = CS_TILE_LOG_NEW;
  cs_service_try(L, cs_tile_log_find(s->context, &s->pyramid, &inputs, &s->log, &state));
  lua_pushstring(L, states[state]);
  return 1;
}

/* shown:clear_tiles(): removes the tiles of an earlier run. */
static int clear_tiles(lua_State *L) {
  shown *s = self(L);
  cs_service_try(L, cs_tile_log_clear(s->context, &s->pyramid, &s->log));
  return 0;
}

/* ---------------------------------------------------------------- the tiles */

/* The back light of a rostrum, premultiplied, in the space of the film. */
static void find_back(const celspan_rostrum *rostrum, celspan_space film, float out[4]) {
  celspan_space space = cs_space_inside(rostrum->space, film);
  const cs_light scaled = cs_scene_back(rostrum, &rostrum->back);
  celspan_light back = cs_light_in(&scaled, space);
  const float light[4] = {back.r, back.g, back.b, back.a};
  memcpy(out, light, sizeof light);
  for (int c = 0; c < 3 && space != film; c++)
    out[c] = cs_space_channel(film, out[c], out[3]);
}

/* The background, premultiplied, in the space of the film; transparent for a picture. */
static void set_background(const shown *s, float out[4]) {
  celspan_space film = cs_space_inside(s->frame.space, CELSPAN_SPACE_LINEAR);
  size_t count = s->is_film ? s->frame.exposure_count : 0;
  bool is_plain = count == 1 && s->frame.exposures[0].weight == 1;
  memset(out, 0, 4 * sizeof *out);
  for (size_t i = 0; i < count; i++) {
    float back[4];
    find_back(s->frame.exposures[i].rostrum, film, back);
    if (!is_plain)
      cs_space_decode(film, back);
    for (int c = 0; c < 4; c++)
      out[c] += (float)s->frame.exposures[i].weight * back[c];
  }
  if (out[3] > 1)
    out[3] = 1;
  if (!is_plain)
    cs_space_encode(film, out);
}

/* Pushes the colour around the tiles, "#rrggbb". */
static void push_background(lua_State *L, const shown *s, const float background[4]) {
  unsigned char pixel[4];
  char text[8];
  const celspan_coding coding = {.struct_size = sizeof coding,
                                 .depth = CELSPAN_DEPTH_8,
                                 .transfer = CELSPAN_TRANSFER_SRGB,
                                 .alpha = CELSPAN_ALPHA_STRAIGHT,
                                 .space = s->frame.space};
  cs_pixels_code(&coding, background, pixel);
  snprintf(text, sizeof text, "#%02x%02x%02x", pixel[0], pixel[1], pixel[2]);
  lua_pushstring(L, background[3] <= 0 ? "#14151a" : text);
}

/* Pushes the rows of the record: { { level, row, first column, end of columns }, ... }. */
static void push_rows(lua_State *L, const cs_tile_log *log) {
  lua_createtable(L, (int)log->count, 0);
  for (size_t i = 0; i < log->count; i++) {
    const cs_tile_row *row = &log->rows[i];
    cs_push_numbers(L, (const double[]){row->level, row->row, row->first, row->end}, 4);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

/* Pushes the jobs of the list that is argument 2: { { level, x0, y0, x1, y1 }, ... }. */
static cs_tile_job *push_jobs(lua_State *L, size_t count) {
  cs_tile_job *jobs = lua_newuserdatauv(L, (count + 1) * sizeof *jobs, 0);
  for (size_t i = 0; i < count; i++) {
    lua_rawgeti(L, 2, (lua_Integer)i + 1);
    int top = lua_gettop(L);
    for (int k = 1; k <= 5; k++)
      lua_rawgeti(L, top, k);
    jobs[i] = (cs_tile_job){(int32_t)luaL_checkinteger(L, top + 1), box_at(L, top + 2)};
    lua_settop(L, top - 1);
  }
  return jobs;
}

static void finished(void *user, cs_tile_row row) {
  const shown *s = user;
  char what[32];
  snprintf(what, sizeof what, "level %d", row.level);
  cs_progress_frame(s->progress, row.row, what, "made");
}

/* The progress counts only finished rows of tiles. */
static bool tick(void *user) {
  const shown *s = user;
  return cs_progress_tick(s->progress, 0);
}

/* shown:tiles(jobs): makes the tiles that are missing -> how many were written, linked to equal
 * ones, left out; the colour around them; the rows of tiles of this run and earlier ones */
static int tiles(lua_State *L) {
  shown *s = self(L);
  const cs_request *request = cs_service_session(L)->request;
  size_t count = lua_rawlen(L, 2);
  cs_tile_render render = {.context = s->context,
                           .frame = &s->frame,
                           .pyramid = &s->pyramid,
                           .jobs = push_jobs(L, count),
                           .job_count = count,
                           .log = &s->log,
                           .skips_empty = is_given(L, "--skip-empty"),
                           .is_sparse = is_given(L, "--sparse"),
                           .draw = draw,
                           .finished = finished,
                           .tick = tick,
                           .user = s};
  cs_service_try(L, cs_tile_log_open(s->context, &s->pyramid, &s->log));
  set_background(s, render.background);
  cs_request_read(request, "--workers", &render.workers);
  cs_progress_start(s->progress, request, CS_PROGRESS_AUTO, cs_tile_render_row_count(&render));
  s->progress->noun = "tile row";
  cs_service_try(L, cs_tile_render_run(&render));
  lua_pushinteger(L, (lua_Integer)render.output.written);
  lua_pushinteger(L, (lua_Integer)render.output.linked);
  lua_pushinteger(L, (lua_Integer)render.output.skipped);
  push_background(L, s, render.background);
  push_rows(L, &s->log);
  return 5;
}

/* ---------------------------------------------------------------- opening */

static cs_exit open_script(shown *s, const cs_request *request, const char *path) {
  CS_TRY_EXIT(cs_script_open(s->context, request, path, false, &s->script));
  return cs_script_frame(&s->script, request, &s->frame);
}

static cs_exit open_still(shown *s, const cs_request *request, const char *path) {
  CS_TRY_EXIT(cs_shown_open(s->context, request, path, true, &s->still));
  return cs_shown_frame(request, &s->still, &s->frame);
}

/* shown(path, is_film) -> { width =, height =, film_width =, film_height =, title = } and methods:
 * the frame of --frame, under the request, of the script or the film that a file is, or of a
 * picture */
static int open_shown(lua_State *L) {
  static const luaL_Reg methods[] = {
      {"write", write_shown}, CS_SERVICE(pixels),  CS_SERVICE(print_spans), CS_SERVICE(measure),
      CS_SERVICE(pyramid),    CS_SERVICE(touched), CS_SERVICE(find_tiles),  CS_SERVICE(clear_tiles),
      CS_SERVICE(tiles),      {NULL, NULL}};
  cs_session *session = cs_service_session(L);
  const char *path = luaL_checkstring(L, 1);
  bool is_film = lua_toboolean(L, 2);
  lua_newtable(L);
  shown *s = cs_userdata_push_holder(L, "celspan.program.shown", sizeof *s, close_shown);
  s->context = session->context;
  s->log.descriptor = -1;
  s->progress = &session->progress;
  s->is_film = is_film;
  cs_service_require(L, (is_film ? open_script : open_still)(s, session->request, path));
  lua_setfield(L, -2, "open");
  cs_put_integer(L, "width", s->frame.width);
  cs_put_integer(L, "height", s->frame.height);
  cs_put_number(L, "film_width", s->frame.film_width);
  cs_put_number(L, "film_height", s->frame.film_height);
  cs_put_text(L, "title", s->script.film.title);
  cs_service_add(L, methods);
  return 1;
}

/* is_film(path) -> whether a file is shown as the frame of its film: a drawing, or a painting
 * without a merged picture */
static int is_film(lua_State *L) {
  lua_pushboolean(L, cs_shown_is_film(luaL_checkstring(L, 1)));
  return 1;
}

const luaL_Reg cs_services_shown[] = {{"shown", open_shown}, CS_SERVICE(is_film), {NULL, NULL}};
