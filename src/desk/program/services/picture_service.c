/* Pictures for verbs in Lua: facts of files, and frames as pictures. */
#include "celspan/plane.h"
#include "inside/colour.h"
#include "inside/context.h"
#include "inside/pictures.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/nouns/lua_film.h"
#include "program/film/service.h"
#include "program/film/view.h"
#include "program/outputs/outputs.h"
#include "program/outputs/target.h"
#include "program/outputs/writers.h"
#include "program/stage/stage.h"
#include "writers/parcels/plot.h"
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

enum { NESTS_MOST = 16 }; /* planes in each other */

/* Reads all planes in a plane, however deep. deepest: at least `depth`, that of the plane. Returns
 * their number. */
static int64_t check_inner(lua_State *L, const char *path, const celspan_plane *plane, int depth,
                           int *deepest) {
  celspan_context *context = cs_service_session(L)->context;
  uint32_t count = (uint32_t)cs_plane_count(plane).inner;
  int64_t all = count;
  *deepest = depth > *deepest ? depth : *deepest;
  if (count > 0 && depth == NESTS_MOST)
    cs_service_try(L, cs_fail(context, CELSPAN_INPUT, "%s: more than %d planes are in each other",
                              path, NESTS_MOST));
  luaL_checkstack(L, 4, NULL);
  celspan_plane **inner =
      cs_userdata_push_holder(L, "celspan.program.plane", sizeof(celspan_plane *), close_plane);
  for (uint32_t i = 0; i < count; i++) {
    const char *name = lua_pushfstring(L, "%s: plane %d", path, (int)i + 1);
    cs_service_try(L, cs_plane_enter(context, name, plane, i, inner));
    check_frames(L, name, *inner);
    all += check_inner(L, name, *inner, depth + 1, deepest);
    celspan_plane_unref(*inner);
    *inner = NULL;
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  return all;
}

/* plane(path) -> counts for the whole file: `pictures` of all frames, `planes` in it however deep,
 * `levels` of planes in each other; otherwise of the first frame of the outer plane */
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
  int deepest = 1;
  int64_t planes = check_inner(L, path, *plane, 1, &deepest);
  lua_createtable(L, 0, 15);
  cs_put_integer(L, "pictures", pictures);
  cs_put_integer(L, "planes", planes);
  cs_put_integer(L, "levels", deepest);
  cs_put_integer(L, "windows", (int64_t)facts.shown);
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

/* ---------------------------------------------------------------- frames as pictures */

CS_HOLDER_FINISH(finish_frame, cs_film_frame_finish)

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

/* ---------------------------------------------------------------- frames as pages */

/* Adds a frame of the film that is argument 1 as a page. */
static celspan_status add_page(lua_State *L, const cs_film_info *film, int64_t number,
                               cs_plot *pages) {
  celspan_frame_desc desc = CELSPAN_FRAME_DESC;
  cs_film_frame frame = {0};
  cs_plot_facts facts;
  desc.width = (int32_t)film->width;
  desc.height = (int32_t)film->height;
  CS_TRY(cs_lua_film_build(L, 1, number, &frame));
  cs_film_expose(film, &frame, &desc);
  celspan_status status = cs_plot_add_frame(pages, &desc, &facts);
  cs_film_frame_finish(&frame);
  return status;
}

/* pages(film, path): writes a film as a PDF with a page for each frame, a point for each unit. */
static int write_pages(lua_State *L) {
  const cs_session *session = cs_service_session(L);
  const char *path = luaL_checkstring(L, 2);
  cs_film_info film;
  cs_plot *pages;
  cs_lua_film_read(L, 1, &film);
  cs_plot_desc desc = cs_write_describe(session->request, true);
  desc.flat = CS_FLAT_REGIONS;
  desc.title = film.title;
  celspan_status status = cs_plot_begin(session->context, path, &desc, &pages);
  cs_service_try(L, status);
  for (int64_t i = 0; i < film.count && status == CELSPAN_OK; i++)
    status = add_page(L, &film, film.first + i, pages);
  cs_service_try(L, cs_plot_end(pages, status));
  return 0;
}

/* ---------------------------------------------------------------- a picture in memory */

CS_HOLDER_FINISH(release_png, cs_stage_release)

/* png(film) -> the first frame of a film as the bytes of a PNG of 8 bits, its width, its height */
static int make_png(lua_State *L) {
  celspan_frame_desc desc;
  expose_first(L, &desc);
  cs_stage_picture *png =
      cs_userdata_push_holder(L, "celspan.program.png", sizeof *png, release_png);
  png->is_opaque = celspan_frame_is_opaque(&desc);
  png->has_workers = true;
  cs_service_try(L, cs_stage_make(png, cs_service_session(L)->context, &desc, CS_STAGE_PNG));
  lua_pushlstring(L, (const char *)png->bytes, png->size);
  cs_stage_release(png); /* Lua does not know how large it is */
  lua_pushinteger(L, desc.width);
  lua_pushinteger(L, desc.height);
  return 3;
}

const luaL_Reg cs_services_pictures[] = {
    {"picture", read_facts}, {"spans", read_spans}, {"plane", read_plane}, {"write", write_frame},
    {"pages", write_pages},  {"png", make_png},     {NULL, NULL}};
