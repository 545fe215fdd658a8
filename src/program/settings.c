#include "program/settings.h"

#include <errno.h>
#include <lauxlib.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "lua/bind/put.h"
#include "lua/module/core.h"

#define BYTES_MOST ((size_t)64 << 20)
#define PIECE ((size_t)1 << 16)

/* ---------------------------------------------------------------- the file */

static cs_exit fail_reading(const cs_settings *s, const char *why) {
  cs_report_error("--set-from %s: %s", s->path, why);
  return CS_EXIT_INPUT;
}

static cs_exit read_pieces(celspan_context *context, FILE *file, cs_settings *out) {
  for (size_t got = 1; got > 0; out->size += got) {
    if (out->size > BYTES_MOST)
      return fail_reading(out, "it has more than 64 MiB");
    celspan_status status = cs_mem_reserve(context, (void **)&out->json, &out->capacity,
                                           out->size + PIECE, sizeof *out->json);
    if (status != CELSPAN_OK)
      return cs_report_failure(context, status, NULL);
    got = fread(out->json + out->size, 1, PIECE, file);
  }
  return ferror(file) ? fail_reading(out, strerror(errno)) : CS_EXIT_OK;
}

cs_exit cs_settings_open(celspan_context *context, const cs_request *request, cs_settings *out) {
  *out = (cs_settings){.request = request, .path = cs_request_text(request, "--set-from")};
  if (!out->path)
    return CS_EXIT_OK;
  FILE *file = fopen(out->path, "rbe");
  if (!file)
    return fail_reading(out, strerror(errno));
  cs_exit outcome = read_pieces(context, file, out);
  fclose(file);
  return outcome;
}

void cs_settings_close(celspan_context *context, cs_settings *settings) {
  cs_mem_free(context->memory, settings->json, settings->capacity * sizeof *settings->json);
  settings->json = NULL;
}

static void hash_one(void *user, const char *name, const char *value) {
  if (strcmp(name, "--set") == 0)
    cs_hash_text(user, value);
}

cs_hash cs_settings_hash(const cs_settings *settings) {
  const cs_request *request = settings->request;
  cs_hash hash = cs_hash_begin(request->script_argument_count);
  for (size_t i = 0; i < request->script_argument_count; i++)
    cs_hash_text(&hash, request->script_arguments[i]);
  cs_hash_bytes(&hash, settings->json, settings->size);
  cs_request_each(request, hash_one, &hash);
  return cs_hash_end(hash);
}

/* ---------------------------------------------------------------- the registry */

/* Appends the table on top of the stack to the table below it. */
static void append(lua_State *L) { lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1); }

static void give_one(void *user, const char *name, const char *value) {
  lua_State *L = user;
  if (strcmp(name, "--set") != 0)
    return;
  size_t length = strcspn(value, "=");
  lua_newtable(L);
  lua_pushlstring(L, value, length);
  lua_setfield(L, -2, "name");
  cs_put_text(L, "text", value + length + 1);
  append(L);
}

void cs_settings_give(lua_State *L, const cs_settings *settings) {
  cs_core_settings(L);
  if (settings->path) {
    lua_newtable(L);
    cs_put_text(L, "path", settings->path);
    lua_pushlstring(L, settings->json, settings->size);
    lua_setfield(L, -2, "json");
    append(L);
  }
  cs_request_each(settings->request, give_one, L);
  lua_pop(L, 1);
}

/* Whether the script came to its end, a boolean -> the sentence that refuses the settings, or
 * nothing. Runs protected. */
static int find_refusal(lua_State *L) {
  bool has_ended = lua_toboolean(L, 1);
  cs_core_settings(L);
  lua_getfield(L, -1, "refused");
  if (!lua_isnil(L, -1))
    return 1;
  bool is_declared = lua_getfield(L, -2, "declared") != LUA_TNIL;
  if (is_declared || !has_ended || lua_rawlen(L, -3) == 0)
    return 0;
  lua_pushliteral(L, "--set and --set-from give values to parameters, and the script declares none "
                     "(celspan.parameters)");
  return 1;
}

cs_exit cs_settings_outcome(lua_State *L, bool has_ended) {
  lua_pushcfunction(L, find_refusal);
  lua_pushboolean(L, has_ended);
  cs_exit outcome = CS_EXIT_OK;
  if (lua_pcall(L, 1, 1, 0) == LUA_OK && lua_isstring(L, -1))
    outcome = cs_report_usage("%s", lua_tostring(L, -1));
  lua_pop(L, 1);
  return outcome;
}
