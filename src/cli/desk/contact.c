/* celspan contact SCRIPT -o SHEET: frames of a film side by side.
 *
 *   frames of --frames, every N-th --> pages of C x R panels --contact.lua--> SHEET
 *
 * Without --every the frames are thinned until they fit on one page; with it there may be several,
 * numbered by #### in SHEET.
 */
#include <lauxlib.h>

#include "base/context.h"
#include "bind/host.h"
#include "bind/lua_error.h"
#include "cli/desk/desk.h"
#include "cli/script.h"
#include "cli/target.h"
#include "cli/verbs.h"
#include "cli/view.h"

enum { COLUMNS = 6, ROWS = 4, PANEL_MOST = 480, SHEET_MOST = 3840, PANEL_LEAST = 16 };

typedef struct contact {
  cs_script *script;
  const cs_request *request;
  cs_sequence frames;
  size_t every; /* of them one in so many */
  int32_t columns, rows;
  celspan_frame_desc panel; /* the size of a panel, and how it is made */
  size_t begin;             /* the first frame of the page, in `frames` */
  size_t filled;            /* panels of the page */
  unsigned char *pixels;    /* of the page's panels, one after the other; owned */
} contact;

/* ---------------------------------------------------------------- a page */

static size_t row_size(const contact *c) { return (size_t)c->panel.width * 8; }

static size_t panel_size(const contact *c) { return row_size(c) * (size_t)c->panel.height; }

static int64_t frame_of_panel(const contact *c, size_t i) {
  return c->frames.frames[c->begin + i * c->every];
}

/* Makes the frames of the page, one after the other, into `pixels`. */
static celspan_status make_panels(contact *c) {
  static const celspan_coding coding = {CELSPAN_DEPTH_16, CELSPAN_TRANSFER_SRGB,
                                        CELSPAN_ALPHA_STRAIGHT};
  for (size_t i = 0; i < c->filled; i++) {
    CS_TRY(cs_script_try(c->script, frame_of_panel(c, i)));
    c->panel.exposures = c->script->frame.exposures;
    c->panel.exposure_count = c->script->frame.count;
    CS_TRY(celspan_frame_pixels(c->script->context, &c->panel, &coding,
                                c->pixels + i * panel_size(c), row_size(c), NULL));
  }
  return CELSPAN_OK;
}

/* light userdata: a contact -> the page as a film of one frame. Runs protected. */
static int lay_out(lua_State *L) {
  const contact *c = lua_touserdata(L, 1);
  lua_createtable(L, (int)c->filled, 0);
  for (size_t i = 0; i < c->filled; i++) {
    lua_createtable(L, 0, 2);
    lua_pushlstring(L, (const char *)c->pixels + i * panel_size(c), panel_size(c));
    lua_setfield(L, -2, "pixels");
    lua_pushinteger(L, frame_of_panel(c, i));
    lua_setfield(L, -2, "number");
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
  lua_pushinteger(L, c->columns);
  lua_pushinteger(L, c->panel.width);
  lua_pushinteger(L, c->panel.height);
  cs_desk_call(L, cs_desk_contact, "@celspan/desk/contact.lua", 4, 1);
  return 1;
}

static celspan_status write_page(contact *c, int64_t page) {
  char path[4096];
  cs_film_info info;
  cs_film_frame built;
  lua_State *L = c->script->L;
  celspan_context *context = c->script->context;
  CS_TRY(cs_sequence_name(context, c->request->output, page, path, sizeof path));
  CS_TRY(cs_lua_film_build(L, lua_gettop(L), 1, &built));
  cs_lua_film_read(L, lua_gettop(L), &info);
  celspan_frame_desc frame = CELSPAN_FRAME_DESC;
  frame.film_width = frame.width = info.width;
  frame.film_height = frame.height = info.height;
  frame.workers = c->request->workers;
  frame.exposures = built.exposures;
  frame.exposure_count = built.count;
  celspan_file_desc file = cs_target_file(c->request);
  celspan_status status = celspan_frame_write(context, &frame, path, &file, NULL);
  cs_film_frame_finish(&built);
  return status;
}

static celspan_status make_page(contact *c, int64_t page) {
  lua_State *L = c->script->L;
  CS_TRY(make_panels(c));
  lua_pushcfunction(L, lay_out);
  lua_pushlightuserdata(L, c);
  cs_host_begin(L, CS_HOST_VERB, 0);
  int outcome = lua_pcall(L, 1, 1, 0);
  cs_host_end(L);
  if (outcome != LUA_OK)
    return cs_lua_error_report(L, outcome);
  celspan_status status = write_page(c, page);
  lua_pop(L, 1);
  return status;
}

static celspan_status make_pages(contact *c) {
  size_t most = (size_t)c->columns * (size_t)c->rows;
  for (int64_t page = 1; c->begin < c->frames.count; page++, c->begin += most * c->every) {
    size_t left = (c->frames.count - c->begin + c->every - 1) / c->every;
    c->filled = left < most ? left : most;
    CS_TRY(make_page(c, page));
  }
  return CELSPAN_OK;
}

static cs_exit make(contact *c) {
  celspan_context *context = c->script->context;
  size_t panels = (size_t)c->columns * (size_t)c->rows;
  c->pixels = cs_mem_array(context->memory, panels, panel_size(c));
  celspan_status status = c->pixels ? make_pages(c) : cs_fail_memory(context);
  cs_mem_free(context->memory, c->pixels, panels * panel_size(c));
  return cs_report_failure(context, status, NULL);
}

/* ---------------------------------------------------------------- what is asked for */

/* A panel has the film's shape; it is no larger than the film, and no larger than fits. */
static cs_exit choose_panel(contact *c) {
  const cs_film_info *film = &c->script->film;
  double most = (double)SHEET_MOST / c->columns;
  most = most < PANEL_MOST ? most : PANEL_MOST;
  double side = film->width > film->height ? film->width : film->height;
  double scale = side > most ? most / side : 1;
  cs_request sized = {.scale = scale, .workers = c->request->workers};
  cs_exit outcome = cs_view_frame(&sized, film->width, film->height, &c->panel);
  c->panel.width = c->panel.width < PANEL_LEAST ? PANEL_LEAST : c->panel.width;
  c->panel.height = c->panel.height < PANEL_LEAST ? PANEL_LEAST : c->panel.height;
  return outcome;
}

static void choose_every(contact *c) {
  size_t panels = (size_t)c->columns * (size_t)c->rows;
  size_t most = (c->frames.count + panels - 1) / panels;
  c->every = c->request->every.is_given ? (size_t)c->request->every.value : most;
}

/* Several pages need a number in their name. */
static cs_exit refuse_pages(const contact *c) {
  size_t shown = (c->frames.count + c->every - 1) / c->every;
  size_t panels = (size_t)c->columns * (size_t)c->rows;
  if (shown <= panels || cs_sequence_has_number(c->request->output))
    return CS_EXIT_OK;
  return cs_report_usage(
      "%s: %zu frames do not fit into a grid of %d x %d: give a larger --grid or "
      "--every, or a name with a number, such as sheet.####.png",
      c->request->output, shown, c->columns, c->rows);
}

static cs_exit run(cs_script *script, const cs_request *request) {
  contact c = {.script = script,
               .request = request,
               .columns = request->grid[0] ? request->grid[0] : COLUMNS,
               .rows = request->grid[0] ? request->grid[1] : ROWS};
  cs_request listed = *request;
  listed.output = NULL; /* the name is that of pages, not of frames */
  cs_exit outcome = cs_target_frames(script, &listed, &c.frames);
  if (outcome != CS_EXIT_OK)
    return outcome;
  choose_every(&c);
  outcome = refuse_pages(&c);
  if (outcome == CS_EXIT_OK)
    outcome = choose_panel(&c);
  if (outcome == CS_EXIT_OK)
    outcome = make(&c);
  cs_sequence_finish(&c.frames);
  return outcome;
}

cs_exit cs_verb_contact(celspan_context *context, const cs_request *request) {
  if (!request->output)
    return cs_report_usage("where to? give -o sheet.png");
  cs_exit outcome = cs_target_refuse(context, request->output, request);
  if (outcome != CS_EXIT_OK)
    return outcome;
  cs_script script;
  outcome = cs_script_open(context, request, &script);
  if (outcome == CS_EXIT_OK)
    outcome = run(&script, request);
  cs_script_close(&script);
  return outcome;
}
