#include "program/stage/stage.h"

#include <stdint.h>
#include <string.h>

#include "celspan/celspan.h"
#include "inside/png.h"
#include "inside/scene.h"
#include "inside/sinks.h"
#include "lua/bind/host.h"
#include "process/interrupt.h"

#define PIXELS_MOST (1 << 25) /* pixels of a picture in memory */

static const celspan_coding coding = {.struct_size = sizeof coding,
                                      .depth = CELSPAN_DEPTH_8,
                                      .transfer = CELSPAN_TRANSFER_SRGB,
                                      .alpha = CELSPAN_ALPHA_STRAIGHT};

/* ---------------------------------------------------------------- runs */

/* Pixels as they travel to the page of celspan watch: few bytes for flat colours, and fewer still
 * where a row is like the one above; made and read at the speed of memory.
 *
 *   head, pixel, pixel, ...   LITERAL: `count` pixels as they are
 *   head, pixel               FILL: `count` times this pixel
 *   head                      ABOVE: `count` pixels like those a row higher
 *
 * All are words of 32 bits in the order of this machine: both ends are on it. The two highest bits
 * of a head say which it is, the others are `count`. A run may continue in the next row.
 */

enum { LITERAL, FILL, ABOVE };

/* The most words that `count` pixels can need. A run saves at least one word, and the head of the
 * literals after it needs one. */
static inline size_t runs_words(size_t count) { return count + 1; }

/* The shortest runs: shorter ones cost more time than they save bytes. */
enum { RUN_LEAST = 4 };

/* The number of equal places at the beginning of a and b, at most `most`. */
static size_t equal(const uint32_t *a, const uint32_t *b, size_t most) {
  size_t count = 0;
  for (uint64_t x, y; count + 2 <= most; count += 2) {
    memcpy(&x, a + count, sizeof x);
    memcpy(&y, b + count, sizeof y);
    if (x != y)
      break;
  }
  while (count < most && a[count] == b[count])
    count++;
  return count;
}

/* As equal, but 0 for fewer than `least`, as at most places: this is found without a loop. */
static inline size_t equal_run(const uint32_t *a, const uint32_t *b, size_t most, size_t least) {
  return most < least || memcmp(a, b, least * sizeof *a) != 0 ? 0 : equal(a, b, most);
}

static uint32_t head(uint32_t kind, size_t count) { return kind << 30 | (uint32_t)count; }

/* Writes the pixels [from, to) without changes. Returns the number of words. */
static size_t put_literals(const uint32_t *pixels, size_t from, size_t to, uint32_t *out) {
  if (from == to)
    return 0;
  out[0] = head(LITERAL, to - from);
  memcpy(out + 1, pixels + from, (to - from) * sizeof *out);
  return to - from + 1;
}

/* Packs rows of `width` pixels. out: room for runs_words(count). Returns the number of words. */
static size_t pack_runs(const uint32_t *pixels, size_t count, size_t width, uint32_t *out) {
  size_t used = 0, literal = 0; /* the pixels [literal, at) have not been put */
  for (size_t at = 0; at < count;) {
    const uint32_t *here = pixels + at;
    size_t above = at >= width ? equal_run(here, here - width, count - at, RUN_LEAST) : 0;
    size_t run = above ? above : equal_run(here + 1, here, count - at - 1, RUN_LEAST - 1) + 1;
    if (run == 1) {
      at++;
      continue;
    }
    used += put_literals(pixels, literal, at, out + used);
    out[used++] = head(run == above ? ABOVE : FILL, run);
    if (run != above)
      out[used++] = pixels[at];
    literal = at += run;
  }
  return used + put_literals(pixels, literal, count, out + used);
}

/* ---------------------------------------------------------------- bytes */

void cs_stage_release(cs_stage_picture *p) {
  if (p->context)
    cs_mem_free(p->context->memory, p->bytes, p->capacity);
  *p = (cs_stage_picture){0};
}

static celspan_status append(cs_stage_picture *p, const void *bytes, size_t size) {
  CS_TRY(CS_RESERVE(p->context, p->bytes, p->capacity, p->size + size));
  memcpy(p->bytes + p->size, bytes, size);
  p->size += size;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- a PNG in memory */

static celspan_status put_chunk(cs_stage_picture *p, const char *type, const void *bytes,
                                size_t size) {
  unsigned char head[CS_PNG_CHUNK_HEAD], tail[CS_PNG_CHUNK_TAIL];
  cs_png_chunk_ends(type, bytes, size, head, tail);
  CS_TRY(append(p, head, sizeof head));
  CS_TRY(append(p, bytes, size));
  return append(p, tail, sizeof tail);
}

static celspan_status put_data(void *user, celspan_context *context, const void *bytes,
                               size_t size) {
  (void)context;
  return put_chunk(user, "IDAT", bytes, size);
}

static celspan_status begin_png(void *user, celspan_context *context, int32_t width,
                                int32_t height) {
  cs_stage_picture *p = user;
  static const char software[] = "Software\0celspan";
  const cs_png_picture desc = {.coding = p->coding,
                               .is_opaque = p->is_opaque,
                               .width = width,
                               .height = height,
                               .workers = p->workers};
  unsigned char header[CS_PNG_HEADER] = {0};
  cs_png_store_32(header, (uint32_t)width);
  cs_png_store_32(header + 4, (uint32_t)height);
  header[8] = 8;
  header[9] = p->is_opaque ? 2 : 6; /* RGB or RGBA */
  CS_TRY(append(p, cs_png_signature, sizeof cs_png_signature));
  CS_TRY(put_chunk(p, "IHDR", header, sizeof header));
  CS_TRY(put_chunk(p, "sRGB", "", 1));
  CS_TRY(put_chunk(p, "tEXt", software, sizeof software - 1));
  return cs_png_strips_create(context, &desc, put_data, p, &p->strips);
}

static celspan_status put_png_row(void *user, celspan_context *context, int32_t y,
                                  const celspan_span *spans, size_t span_count) {
  const cs_stage_picture *p = user;
  (void)y;
  return cs_png_strips_row(p->strips, context, spans, span_count);
}

static celspan_status end_png(void *user, celspan_context *context, celspan_status outcome) {
  cs_stage_picture *p = user;
  if (outcome == CELSPAN_OK)
    outcome = cs_png_strips_finish(p->strips, context);
  if (outcome == CELSPAN_OK)
    outcome = put_chunk(p, "IEND", "", 0);
  cs_png_strips_destroy(p->strips, context);
  p->strips = NULL;
  return outcome;
}

/* ---------------------------------------------------------------- pictures */

/* The description of the frame that was built last. */
static celspan_frame_desc frame_of(lua_State *L, const cs_script *script) {
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  cs_request_read(cs_service_session(L)->request, "--workers", &desc.workers);
  cs_film_expose(&script->film, &script->frame, &desc);
  desc.progress = cs_interrupt_progress;
  return desc;
}

/* Reads the size and the crop from index 2 on: six numbers. */
static bool read_view(lua_State *L, celspan_frame_desc *desc) {
  int64_t view[6];
  for (int i = 0; i < 6; i++) {
    view[i] = luaL_checkinteger(L, 2 + i);
    if (view[i] < (i == 2 || i == 3 ? 0 : 1) || view[i] > CS_SIDE_MAX)
      return false;
  }
  desc->width = (int32_t)view[0];
  desc->height = (int32_t)view[1];
  desc->crop_x = (int32_t)view[2];
  desc->crop_y = (int32_t)view[3];
  desc->crop_width = (int32_t)view[4];
  desc->crop_height = (int32_t)view[5];
  return view[2] + view[4] <= view[0] && view[3] + view[5] <= view[1] &&
         view[4] * view[5] <= PIXELS_MOST;
}

bool cs_stage_frame(lua_State *L, const cs_script *script, celspan_frame_desc *out) {
  *out = frame_of(L, script);
  if (read_view(L, out))
    return true;
  luaL_pushfail(L);
  lua_pushfstring(L, "the crop is not within the frame, or has more than %d pixels", PIXELS_MOST);
  return false;
}

/* Writes the kinds of spans as colours; the first pixel of each span is brighter. */
static celspan_status put_kinds_row(void *user, celspan_context *context, int32_t y,
                                    const celspan_span *spans, size_t span_count) {
  static const unsigned char colours[][4] = {[CELSPAN_SPAN_SINGLE] = {60, 130, 255, 110},
                                             [CELSPAN_SPAN_GRADIENT] = {40, 200, 90, 130},
                                             [CELSPAN_SPAN_ARRAY] = {255, 70, 60, 150}};
  const cs_stage_picture *p = user;
  (void)context;
  unsigned char *row = p->bytes + p->stride * (size_t)y;
  for (size_t i = 0; i < span_count; i++) {
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++)
      memcpy(row + 4 * (size_t)x, colours[spans[i].kind], 4);
    row[4 * (size_t)spans[i].x0 + 3] = 255;
  }
  return CELSPAN_OK;
}

/* Allocates the bytes of a crop. */
static celspan_status reserve_rows(cs_stage_picture *p, const celspan_frame_desc *desc) {
  p->stride = 4 * (size_t)desc->crop_width;
  p->size = p->stride * (size_t)desc->crop_height;
  return CS_RESERVE(p->context, p->bytes, p->capacity, p->size);
}

/* Packs the rows that were rendered. */
static celspan_status pack(cs_stage_picture *p) {
  size_t count = p->size / sizeof(uint32_t), capacity = 0;
  uint32_t *words = NULL;
  CS_TRY(CS_RESERVE(p->context, words, capacity, runs_words(count)));
  size_t used = pack_runs((const uint32_t *)p->bytes, count, p->stride / sizeof *words, words);
  cs_mem_free(p->context->memory, p->bytes, p->capacity);
  p->bytes = (unsigned char *)words;
  p->size = used * sizeof *words;
  p->capacity = capacity * sizeof *words;
  return CELSPAN_OK;
}

celspan_status cs_stage_make(cs_stage_picture *p, celspan_context *context,
                             const celspan_frame_desc *desc, cs_stage_kind kind) {
  p->context = context;
  p->coding = coding;
  p->coding.space = desc->space;
  p->workers = p->has_workers ? desc->workers : 1;
  celspan_sink sink = {.struct_size = sizeof sink,
                       .user = p,
                       .begin = begin_png,
                       .row = put_png_row,
                       .end = end_png,
                       .takes_codes = true};
  if (kind != CS_STAGE_PNG)
    CS_TRY(reserve_rows(p, desc));
  if (kind == CS_STAGE_KINDS)
    sink = (celspan_sink){.struct_size = sizeof(celspan_sink), .user = p, .row = put_kinds_row};
  if (kind == CS_STAGE_CODES || kind == CS_STAGE_RUNS)
    CS_TRY(cs_sink_memory(p->context, &p->coding, p->bytes, p->stride, &sink));
  CS_TRY(celspan_frame_render(p->context, desc, &sink, NULL));
  return kind == CS_STAGE_RUNS ? pack(p) : CELSPAN_OK;
}

/* ---------------------------------------------------------------- files */

/* Runs protected. -> the files that the script asked for, in the form of cs_stage_files */
static int join_asked(lua_State *L) {
  luaL_Buffer names;
  cs_host_push_asked(L);
  luaL_buffinit(L, &names);
  for (lua_Integer i = 1; lua_rawgeti(L, 1, i) == LUA_TSTRING; i++) {
    lua_rawget(L, 1);
    bool is_admitted = lua_toboolean(L, -1);
    lua_pop(L, 1);
    luaL_addchar(&names, is_admitted ? '+' : '-');
    lua_rawgeti(L, 1, i);
    luaL_addvalue(&names);
    luaL_addchar(&names, 0);
  }
  lua_pop(L, 1);
  luaL_pushresult(&names);
  return 1;
}

/* film:files() -> the paths that the script has asked for since the last call, each ended by a
 * zero; before each there is "+" if the script was allowed to read it, and otherwise "-" */
int cs_stage_files(lua_State *L) {
  lua_State *script = ((cs_script *)cs_service_opened(L))->L;
  lua_pushcfunction(script, join_asked);
  if (lua_pcall(script, 0, 1, 0) != LUA_OK)
    lua_pushliteral(L, "");
  else {
    size_t size;
    const char *names = lua_tolstring(script, -1, &size);
    lua_pushlstring(L, names ? names : "", size);
  }
  lua_pop(script, 1);
  return 1;
}
