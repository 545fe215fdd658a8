/* Primitives given by a Lua function that returns its spans on a row.
 *
 * The function is kept in the registry, so that it lives as long as the core's object. It is called
 * by the calling thread only (any_thread = false), and always protected, so that no error can jump
 * over C frames of the core.
 */
#include "lua/bind/caller.h"
#include "lua/bind/fields.h"
#include "lua/bind/host.h"
#include "lua/bind/list.h"
#include "lua/bind/lua_error.h"
#include "lua/bind/put.h"
#include "lua/nouns/nouns.h"

typedef struct procedure {
  cs_host *host; /* counted */
  int function;  /* in the registry */
} procedure;

static const cs_field fields[] = {
    {"bounds", CS_BOX(celspan_scanline_desc, bounds), .is_required = true},
    {"spans", CS_OWN("fun(y: number, row: celspan.scanline.row): table[]"), .is_required = true,
     .about = "{x0, x1, paint [, paint]} or {x0, x1, array = {paint, ...}}"},
    {0}};
static void create(const cs_form *form, cs_userdata *value);
const cs_noun cs_noun_scanline = {
    .name = "scanline",
    .about = "A primitive defined by a function that returns its spans on a row.",
    .kind = &cs_kind_object,
    .fields = fields,
    .create = create};

/* One call, as light userdata to the protected function. */
typedef struct request {
  const procedure *procedure;
  double y;
  const celspan_scanline_row *row;
  celspan_scanline_output *output;
  celspan_status status; /* the status of the core, if it refused a span */
} request;

static void push_row(lua_State *L, const celspan_scanline_row *row) {
  lua_createtable(L, 0, 3);
  cs_put_number(L, "x0", row->x0);
  cs_put_number(L, "x1", row->x1);
  cs_put_number(L, "pixel", row->pixel);
}

/* The paints of the span on top of the stack: values 3 and 4, or `array`. Scratch memory. */
static celspan_paint *read_paints(const cs_form *form, int i, size_t *count) {
  lua_State *L = form->L;
  int span = lua_gettop(L), from = span, first = 3;
  lua_pushliteral(L, "array");
  if (lua_rawget(L, span) == LUA_TTABLE) {
    from = lua_gettop(L);
    first = 1;
    *count = (size_t)cs_list_length(L, from);
  } else
    *count = cs_list_length(L, span) >= 4 ? 2 : 1;
  celspan_paint *paints = cs_form_scratch(L, *count, sizeof *paints);
  for (size_t p = 0; p < *count; p++)
    paints[p] = cs_form_tuple_paint(form, from, first + (int)p, "span", i);
  return paints;
}

/* The argument is a request, as light userdata. Runs protected; raises an error where the function
 * or its result is wrong. */
static int call(lua_State *L) {
  request *r = lua_touserdata(L, 1);
  luaL_checkstack(L, 20, "scanline");
  lua_rawgeti(L, LUA_REGISTRYINDEX, r->procedure->function);
  lua_pushnumber(L, r->y);
  push_row(L, r->row);
  lua_call(L, 2, 1);
  cs_form form = {.L = L, .noun = &cs_noun_scanline, .table = lua_gettop(L)};
  if (lua_isnil(L, -1))
    return 0;
  if (!lua_istable(L, -1))
    cs_form_fail(&form, "spans must return a list of {x0, x1, paint}, got %s",
                 cs_userdata_type(L, -1));
  int count = cs_form_length(&form);
  for (int i = 1; i <= count && r->status == CELSPAN_OK; i++) {
    cs_form_item(&form, i, LUA_TTABLE, "span", "{x0, x1, paint}");
    double x0 = cs_form_tuple_number(&form, -1, 1, "span", i);
    double x1 = cs_form_tuple_number(&form, -1, 2, "span", i);
    size_t paint_count;
    const celspan_paint *paints = read_paints(&form, i, &paint_count);
    r->status = celspan_scanline_emit(r->output, x0, x1, paints, paint_count);
    lua_settop(L, form.table);
  }
  return 0;
}

/* Replaces the message on top of the stack by one that has the line where the function begins,
 * unless it has a line. */
static void push_message(lua_State *L, const procedure *p) {
  const char *message =
      lua_type(L, -1) == LUA_TSTRING ? lua_tostring(L, -1) : "the error is not a string";
  if (!cs_lua_error_position(message)) {
    lua_rawgeti(L, LUA_REGISTRYINDEX, p->function);
    cs_caller_push_function(L, -1);
    lua_remove(L, -2);
    lua_pushstring(L, message);
    lua_concat(L, 2);
  } else {
    lua_pushstring(L, message);
  }
}

/* The same as call, but errors have a position. */
static int call_placed(lua_State *L) {
  const request *r = lua_touserdata(L, 1);
  cs_lua_error_push_handler(L, "", call);
  lua_pushcfunction(L, call);
  lua_pushvalue(L, 1);
  int outcome = lua_pcall(L, 1, 0, 2);
  if (outcome == LUA_OK)
    return 0;
  if (!cs_lua_error_is_memory(L, outcome))
    push_message(L, r->procedure);
  return lua_error(L);
}

static celspan_status spans(void *user, celspan_context *context, double y,
                            const celspan_scanline_row *row, celspan_scanline_output *output) {
  const procedure *p = user;
  lua_State *L = p->host->state;
  if (!L)
    return celspan_context_fail(context, CELSPAN_CALLBACK,
                                "scanline: the Lua state that made it is closed");
  request r = {p, y, row, output, CELSPAN_OK};
  if (!lua_checkstack(L, 8))
    return celspan_context_fail(context, CELSPAN_LIMIT, "scanline: Lua's stack is full");
  lua_pushcfunction(L, call_placed);
  lua_pushlightuserdata(L, &r);
  cs_host_begin(L, CS_HOST_PROCEDURE, 0);
  int outcome = cs_lua_error_settle(L, lua_pcall(L, 1, 0, 0), 0);
  cs_host_end(L);
  if (outcome == LUA_OK)
    return r.status;
  const char *text = lua_tostring(L, -1);
  celspan_status status = cs_lua_error_limit(L, outcome, &text);
  if (status == CELSPAN_OK)
    status = cs_lua_error_is_memory(L, outcome) ? CELSPAN_NO_MEMORY : CELSPAN_CALLBACK;
  status = celspan_context_fail(context, status, "%s", text);
  lua_pop(L, 1);
  return status;
}

static void release(void *user) {
  procedure *p = user;
  cs_host *host = p->host;
  if (host->state)
    luaL_unref(host->state, LUA_REGISTRYINDEX, p->function);
  cs_mem_free(host->memory, p, sizeof *p);
  cs_host_unref(host);
}

static void create(const cs_form *form, cs_userdata *value) {
  lua_State *L = form->L;
  cs_host *host = cs_host_get(L);
  celspan_scanline_desc desc = {.struct_size = sizeof desc, .spans = spans, .release = release};
  cs_fields_read(form, &desc);
  if (cs_form_get(form, "spans") != LUA_TFUNCTION)
    cs_form_fail(form, "field 'spans' must be a function(y, row), got %s", cs_userdata_type(L, -1));
  int function = luaL_ref(L, LUA_REGISTRYINDEX);
  procedure *p = cs_mem_array(host->memory, 1, sizeof *p);
  if (!p) {
    luaL_unref(L, LUA_REGISTRYINDEX, function);
    cs_form_try(form, cs_fail_memory(host->context));
  }
  *p = (procedure){host, function};
  host->references++;
  desc.user = p;
  celspan_object *object = NULL;
  celspan_status status = celspan_object_create_scanline(host->context, &desc, &object);
  if (status != CELSPAN_OK)
    release(p);
  cs_form_try(form, status);
  value->handle = object;
}
