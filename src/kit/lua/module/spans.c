/* celspan.spans: rows of spans as tables; celspan.probe: one point by direct evaluation. */
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/module/subject.h"

#define ROWS "celspan.rows"

CS_HOLDER_RELEASE(release, celspan_rows, celspan_rows_destroy)

/* The colours of a span as numbers 1, 2, ...: one RGBA for a single span, the RGBA of the first and
 * of the last pixel for a gradient, and the RGBA of every pixel for an array. */
static void set_colours(lua_State *L, const celspan_span *span) {
  int32_t count = span->kind == CELSPAN_SPAN_SINGLE     ? 1
                  : span->kind == CELSPAN_SPAN_GRADIENT ? 2
                                                        : span->x1 - span->x0;
  for (int32_t i = 0; i < count; i++) {
    bool is_end = span->kind == CELSPAN_SPAN_GRADIENT && i == 1;
    float colour[4];
    celspan_span_colour(span, is_end ? span->x1 - 1 : span->x0 + i, colour);
    for (int c = 0; c < 4; c++) {
      lua_pushnumber(L, colour[c]);
      lua_rawseti(L, -2, 4 * (lua_Integer)i + c + 1);
    }
  }
}

static void push_span(lua_State *L, const celspan_span *span) {
  static const char *const kinds[] = {"single", "gradient", "array"};
  lua_createtable(L, span->kind == CELSPAN_SPAN_SINGLE ? 4 : 8, 3);
  cs_put_integer(L, "x0", span->x0);
  cs_put_integer(L, "x1", span->x1);
  cs_put_text(L, "kind", kinds[span->kind]);
  set_colours(L, span);
}

/* The first and last row that are wanted: both included, and cut to the frame. */
static void find_rows(const cs_options *options, int32_t range[2]) {
  const cs_form *form = &options->form;
  const celspan_frame_desc *desc = &options->desc;
  int32_t height = desc->crop_height ? desc->crop_height : desc->height;
  double first = options->rows[0], last = options->has_rows ? options->rows[1] : height - 1;
  if (!(first >= 0 && first < height && last >= first))
    cs_form_fail(form,
                 "field 'rows' must be {first, last} with 0 <= first <= last, first below "
                 "%d, got {%s, %s}",
                 height, cs_form_digits(form->L, first), cs_form_digits(form->L, last));
  range[0] = (int32_t)first;
  range[1] = last < height - 1 ? (int32_t)last : height - 1;
}

/* Fills the table on top of the stack. */
static celspan_status fill_rows(lua_State *L, celspan_rows *rows, const int32_t range[2]) {
  celspan_status status = CELSPAN_OK;
  for (int32_t y = range[0]; y <= range[1] && status == CELSPAN_OK; y++) {
    const celspan_span *spans;
    size_t count;
    status = celspan_rows_get(rows, y, &spans, &count);
    if (status != CELSPAN_OK)
      break;
    lua_createtable(L, (int)count, 0);
    for (size_t i = 0; i < count; i++) {
      push_span(L, &spans[i]);
      lua_rawseti(L, -2, (lua_Integer)i + 1);
    }
    lua_rawseti(L, -2, y);
  }
  return status;
}

/* Arguments: rows, range (light userdata), table. Runs protected, so that cs_host_leave is always
 * called afterwards. */
static int fill_protected(lua_State *L) {
  celspan_rows *rows = lua_touserdata(L, 1);
  const int32_t *range = lua_touserdata(L, 2);
  lua_pushinteger(L, fill_rows(L, rows, range));
  return 1;
}

int cs_spans_make(lua_State *L) {
  lua_settop(L, 2);
  cs_options options;
  CS_HOST_TRY(L, cs_subject_read(L, &cs_noun_spans, &options));
  int32_t range[2];
  celspan_rows **rows = cs_userdata_push_holder(L, ROWS, sizeof *rows, release);
  CS_HOST_TRY(L, celspan_rows_create(cs_host_context(L), &options.desc, rows));
  find_rows(&options, range);
  lua_newtable(L);
  int result = lua_gettop(L);
  lua_pushcfunction(L, fill_protected);
  lua_pushlightuserdata(L, *rows);
  lua_pushlightuserdata(L, range);
  lua_pushvalue(L, result);
  lua_State *before = cs_host_enter(L);
  int outcome = lua_pcall(L, 3, 1, 0);
  cs_host_leave(L, before);
  celspan_rows_destroy(*rows);
  *rows = NULL;
  if (outcome != LUA_OK)
    return lua_error(L);
  celspan_status status = (celspan_status)lua_tointeger(L, -1);
  lua_settop(L, result);
  return status == CELSPAN_OK ? 1 : cs_host_fail(L, status);
}

/* celspan.probe(what, x, y [, options]) */
int cs_spans_probe(lua_State *L) {
  lua_settop(L, 4);
  celspan_point point = {cs_form_argument(L, 2, "probe", "x"),
                         cs_form_argument(L, 3, "probe", "y")};
  lua_replace(L, 2); /* in other functions the options are argument 2 */
  double rgba[4];
  cs_options options;
  CS_HOST_TRY(L, cs_subject_read(L, &cs_noun_probe, &options));
  lua_State *before = cs_host_enter(L);
  celspan_status status = celspan_probe(cs_host_context(L), &options.desc, point, rgba);
  cs_host_leave(L, before);
  CS_HOST_TRY(L, status);
  for (int c = 0; c < 4; c++)
    lua_pushnumber(L, rgba[c]);
  return 4;
}
