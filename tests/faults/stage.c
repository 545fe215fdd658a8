#include "tests/faults/stage.h"

#include <dirent.h>
#include <lauxlib.h>
#include <lualib.h>
#include <unistd.h>

#include "base/context.h"
#include "tests/support/check.h"

enum { PATH_SIZE = 512, FLOATS = 4, MOST_SIDE = 512 };

/* ---------------------------------------------------------------- opening */

static void *allocate(void *user, void *block, size_t old_size, size_t new_size) {
  stage *s = user;
  if (new_size == 0) {
    free(block);
    return NULL;
  }
  bool grows = !block || new_size > old_size;
  return grows && fault_comes(&s->lua, "Lua's memory") ? NULL : realloc(block, new_size);
}

static int no_panic(lua_State *L) {
  CHECK(!"an error left a protected call");
  fprintf(stderr, "%s\n", lua_tostring(L, -1));
  return 0;
}

static celspan_status refuse(stage *s, celspan_context *context, const char *call) {
  return fault_comes(&s->host, call)
             ? celspan_context_fail(context, CELSPAN_CALLBACK, "the %s refuses", call)
             : CELSPAN_OK;
}

/* The host's procedure that a script calls. */
static int visit(lua_State *L) {
  stage *s = lua_touserdata(L, lua_upvalueindex(1));
  return fault_comes(&s->host, "a procedure") ? luaL_error(L, "the procedure refuses") : 0;
}

/* Every render has its film in the registry, so that Lua needs no memory to find it. */
static void keep_renders(stage *s) {
  for (lua_Integer i = 1; s->item_count < STAGE_RENDERS && lua_rawgeti(s->L, 1, i) == LUA_TTABLE;
       i++) {
    stage_item *item = &s->items[s->item_count++];
    lua_getfield(s->L, -1, "workers");
    item->workers = (int)luaL_optinteger(s->L, -1, 1);
    lua_getfield(s->L, -2, "film");
    item->film = luaL_ref(s->L, LUA_REGISTRYINDEX);
    lua_settop(s->L, 1);
  }
  lua_settop(s->L, 1);
}

/* ---------------------------------------------------------------- the surface */

static celspan_status fill(void *user, celspan_context *context, const celspan_rectangle *rectangle,
                           void *destination, size_t stride, int32_t *rows) {
  stage *s = user;
  for (int32_t y = 0; y < rectangle->height; y++) {
    unsigned char *row = (unsigned char *)destination + (size_t)y * stride;
    for (int32_t i = 0; i < 4 * rectangle->width; i++)
      row[i] = (unsigned char)(255 - i * (rectangle->y + y + 3));
  }
  *rows = rectangle->height;
  return refuse(s, context, "surface");
}

static celspan_status show(stage *s, celspan_texture *texture) {
  const celspan_rect_desc rect = {sizeof rect, 1, 1, 22, 16, 0, texture};
  celspan_object *object;
  celspan_cel *cel;
  celspan_cel_desc cel_desc = CELSPAN_CEL_DESC;
  celspan_rostrum_desc rostrum_desc = CELSPAN_ROSTRUM_DESC;
  CS_TRY(celspan_object_create_rect(s->context, &rect, &object));
  cel_desc.objects = &object;
  cel_desc.object_count = 1;
  celspan_status status = celspan_cel_create(s->context, &cel_desc, &cel);
  celspan_object_unref(object);
  if (status != CELSPAN_OK)
    return status;
  rostrum_desc.cels = &cel;
  rostrum_desc.cel_count = 1;
  status = celspan_rostrum_create(s->context, &rostrum_desc, &s->surface);
  celspan_cel_unref(cel);
  return status;
}

static celspan_status make_surface(stage *s) {
  celspan_surface_desc desc = CELSPAN_SURFACE_DESC;
  celspan_surface *surface;
  celspan_texture *texture;
  desc.width = 90;
  desc.height = 70;
  desc.fill = fill;
  desc.user = s;
  desc.has_key = true;
  CS_TRY(celspan_surface_create(s->context, &desc, &surface));
  const celspan_picture_desc picture = {.struct_size = sizeof picture, .surface = surface};
  celspan_status status = celspan_texture_create_picture(s->context, &picture, &texture);
  celspan_surface_unref(surface);
  if (status != CELSPAN_OK)
    return status;
  status = show(s, texture);
  celspan_texture_unref(texture);
  return status;
}

static void add_surface(stage *s) {
  if (CHECK(make_surface(s) == CELSPAN_OK && s->item_count < STAGE_RENDERS))
    s->items[s->item_count++] = (stage_item){LUA_NOREF, 1};
  else
    fprintf(stderr, "the surface: %s\n", celspan_context_error(s->context));
}

/* A script returns a list of renders, or a function that makes them one after the other. */
static bool run(stage *s, const char *script, const char *root) {
  bool is_done = luaL_loadfile(s->L, script) == LUA_OK;
  if (is_done) {
    lua_pushstring(s->L, root);
    lua_pushlightuserdata(s->L, s);
    lua_pushcclosure(s->L, visit, 1);
    is_done = lua_pcall(s->L, 2, 1, 0) == LUA_OK;
  }
  if (is_done && lua_istable(s->L, 1)) {
    keep_renders(s);
    add_surface(s);
  }
  if (!CHECK(is_done))
    fprintf(stderr, "%s: %s\n", script, lua_tostring(s->L, -1));
  return is_done;
}

bool stage_open(stage *s, const char *script, const char *root, const char *folder) {
  *s = (stage){.folder = folder};
  s->context = memory_watch_context(&s->watch);
  s->L = lua_newstate(allocate, s);
  lua_atpanic(s->L, no_panic);
  luaL_openlibs(s->L);
  lua_pushfstring(s->L, "package.path = '%s/?.lua;' .. package.path", root);
  CHECK(luaL_dostring(s->L, lua_tostring(s->L, -1)) == LUA_OK);
  CHECK(celspan_lua_open(s->L, s->context) == CELSPAN_OK);
  lua_settop(s->L, 0);
  return run(s, script, root);
}

void stage_close(stage *s) {
  lua_close(s->L);
  celspan_rostrum_unref(s->surface);
  celspan_context_destroy(s->context);
  CHECK(s->watch.blocks == 0 && s->watch.size_errors == 0);
}

/* ---------------------------------------------------------------- the list of renders */

const char *stage_render_text(const stage *s, size_t number, const char *field) {
  if (s->items[number].film == LUA_NOREF)
    return strcmp(field, "name") == 0 ? "surface" : NULL;
  lua_rawgeti(s->L, 1, (lua_Integer)number + 1);
  lua_getfield(s->L, -1, field);
  const char *text = lua_toboolean(s->L, -1) ? luaL_tolstring(s->L, -1, NULL) : NULL;
  if (text) { /* kept in the state */
    lua_pushvalue(s->L, -1);
    luaL_ref(s->L, LUA_REGISTRYINDEX);
  }
  lua_settop(s->L, 1);
  return text;
}

const char *stage_render_sink(const stage *s, size_t number, size_t n) {
  if (n == 0)
    return "digest";
  if (s->items[number].film == LUA_NOREF)
    return n == 1 ? "png" : NULL;
  lua_rawgeti(s->L, 1, (lua_Integer)number + 1);
  lua_getfield(s->L, -1, "sinks");
  lua_rawgeti(s->L, -1, (lua_Integer)n);
  const char *name = lua_tostring(s->L, -1); /* the table keeps it */
  lua_settop(s->L, 1);
  return name;
}

/* ---------------------------------------------------------------- digests */

static void begin_digest(stage_outcome *out) {
  out->result[0] = 0xcbf29ce484222325u;
  out->result[1] = 0;
  out->has_result = true;
}

/* FNV-1a, and a count. */
static void add_bytes(stage_outcome *out, const void *bytes, size_t size) {
  for (size_t i = 0; i < size; i++)
    out->result[0] = (out->result[0] ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
  out->result[1] += size;
}

static void add_spans(stage_outcome *out, const celspan_span *spans, size_t count) {
  float rgba[FLOATS];
  for (size_t i = 0; i < count; i++)
    for (int32_t x = spans[i].x0; x < spans[i].x1; x++) {
      celspan_span_colour(&spans[i], x, rgba);
      add_bytes(out, rgba, sizeof rgba);
    }
}

/* ---------------------------------------------------------------- sinks */

typedef struct own_sink {
  stage *stage;
  stage_outcome *out;
} own_sink;

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  own_sink *sink = user;
  (void)width, (void)height;
  return refuse(sink->stage, context, "sink's begin");
}

static celspan_status row(void *user, celspan_context *context, int32_t y,
                          const celspan_span *spans, size_t count) {
  own_sink *sink = user;
  add_bytes(sink->out, &y, sizeof y);
  add_spans(sink->out, spans, count);
  return refuse(sink->stage, context, "sink's row");
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  own_sink *sink = user;
  celspan_status status = refuse(sink->stage, context, "sink's end");
  return outcome != CELSPAN_OK ? outcome : status;
}

static celspan_status to_sink(stage *s, const celspan_frame_desc *frame, stage_outcome *out) {
  own_sink own = {s, out};
  const celspan_sink sink = {
      .struct_size = sizeof sink, .user = &own, .begin = begin, .row = row, .end = end};
  begin_digest(out);
  return celspan_frame_render(s->context, frame, &sink, NULL);
}

static celspan_status to_rows(stage *s, const celspan_frame_desc *frame, stage_outcome *out) {
  celspan_rows *rows = NULL;
  celspan_status status = celspan_rows_create(s->context, frame, &rows);
  begin_digest(out);
  for (int32_t y = 0; status == CELSPAN_OK && y < frame->height; y++) {
    const celspan_span *spans;
    size_t count;
    status = celspan_rows_get(rows, y, &spans, &count);
    if (status == CELSPAN_OK)
      add_spans(out, spans, count);
  }
  celspan_rows_destroy(rows);
  return status;
}

static celspan_status to_floats(stage *s, const celspan_frame_desc *frame, stage_outcome *out) {
  const celspan_coding coding = {.struct_size = sizeof coding, .depth = CELSPAN_DEPTH_FLOAT};
  size_t stride = (size_t)frame->width * FLOATS * sizeof(float);
  void *pixels = calloc((size_t)frame->height, stride);
  celspan_status status = celspan_frame_pixels(s->context, frame, &coding, pixels, stride, NULL);
  begin_digest(out);
  add_bytes(out, pixels, stride * (size_t)frame->height);
  free(pixels);
  return status;
}

static celspan_status to_probes(stage *s, const celspan_frame_desc *frame, stage_outcome *out) {
  celspan_status status = CELSPAN_OK;
  begin_digest(out);
  for (int i = 0; i < 9 && status == CELSPAN_OK; i++) {
    double rgba[4];
    celspan_point at = {frame->film_width * (1 + i % 3) / 4,
                        frame->film_height * (1 + i / 3.0) / 4};
    status = celspan_probe(s->context, frame, at, rgba);
    if (status == CELSPAN_OK)
      add_bytes(out, rgba, sizeof rgba);
  }
  return status;
}

/* Digests the file, if it exists, and removes it. */
static void take_file(const char *path, stage_outcome *out) {
  char bytes[4096];
  FILE *file = fopen(path, "rb");
  if (!file)
    return;
  begin_digest(out);
  for (size_t size; (size = fread(bytes, 1, sizeof bytes, file)) > 0;)
    add_bytes(out, bytes, size);
  fclose(file);
  unlink(path);
}

static celspan_status to_file(stage *s, const celspan_frame_desc *frame, const char *sink,
                              char path[PATH_SIZE]) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coded = CELSPAN_CODING;
  file.coding = &coded;
  bool is_deep = strcmp(sink, "png16") == 0, dithers = strncmp(sink, "dither.", 7) == 0;
  coded.depth = is_deep   ? CELSPAN_DEPTH_16
                : dithers ? CELSPAN_DEPTH_8_DITHER
                          : CELSPAN_DEPTH_DEFAULT;
  snprintf(path, PATH_SIZE, "%s/frame.%s", s->folder, is_deep ? "png" : dithers ? sink + 7 : sink);
  return celspan_frame_write(s->context, frame, path, &file, NULL);
}

/* ---------------------------------------------------------------- rendering */

static bool ask_progress(void *user, int32_t rows_done, int32_t rows_total) {
  stage *s = user;
  (void)rows_done, (void)rows_total;
  return !fault_comes(&s->host, "progress");
}

static celspan_status render(stage *s, const celspan_frame_desc *frame, const char *sink,
                             char path[PATH_SIZE], stage_outcome *out) {
  if (strcmp(sink, "digest") == 0) {
    out->has_result = true;
    return celspan_frame_digest(s->context, frame, NULL, out->result);
  }
  if (strcmp(sink, "sink") == 0)
    return to_sink(s, frame, out);
  if (strcmp(sink, "rows") == 0)
    return to_rows(s, frame, out);
  if (strcmp(sink, "float") == 0)
    return to_floats(s, frame, out);
  if (strcmp(sink, "probe") == 0)
    return to_probes(s, frame, out);
  return to_file(s, frame, sink, path);
}

/* No call fails any more. */
static void disarm(stage *s) {
  s->watch.fail_at = 0;
  fault_disarm(&s->lua);
  fault_disarm(&s->host);
  fault_disarm(&fault_calls);
}

void stage_render(stage *s, size_t number, const char *sink, stage_outcome *out) {
  char path[PATH_SIZE] = "";
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  *out = (stage_outcome){.has_result = false};
  const celspan_exposure surface = {s->surface, 1};
  bool is_surface = s->items[number].film == LUA_NOREF;
  if (is_surface) {
    frame.exposures = &surface;
    frame.exposure_count = 1;
    frame.film_width = frame.width = 24;
    frame.film_height = frame.height = 18;
  } else {
    lua_rawgeti(s->L, LUA_REGISTRYINDEX, s->items[number].film);
    out->status = celspan_lua_frame(s->L, -1, 1, &frame);
    lua_settop(s->L, 1);
  }
  frame.workers = s->items[number].workers;
  frame.progress = ask_progress;
  frame.progress_user = s;
  frame.strip_rows = 4;
  if (out->status == CELSPAN_OK)
    out->status = render(s, &frame, sink, path, out);
  disarm(s);
  if (out->status != CELSPAN_OK) {
    snprintf(out->sentence, sizeof out->sentence, "%s", celspan_context_error(s->context));
    out->has_result = false;
  }
  if (path[0])
    take_file(path, out);
  if (!is_surface)
    celspan_lua_frame_drop(&frame);
}

int stage_count_files(const stage *s) {
  int count = 0;
  DIR *entries = opendir(s->folder);
  while (entries && readdir(entries))
    count++;
  if (entries)
    closedir(entries);
  return count - 2;
}
