/* Layered documents. */
#include "celspan/layers.h"
#include "lua/bind/host.h"
#include "lua/bind/put.h"
#include "lua/bind/userdata.h"
#include "lua/module/native.h"
#include "lua/nouns/pixel_string.h"
#include "readers/layered/contents.h"

CS_HOLDER_RELEASE(release, celspan_painting, celspan_painting_unref)

/* Puts a surface into the table on top of the stack; NULL: nothing. */
static void put_surface(lua_State *L, const char *name, celspan_surface *surface) {
  if (!surface)
    return;
  cs_pixel_string_push_surface(L, surface);
  lua_setfield(L, -2, name);
}

static void push_layer(lua_State *L, const celspan_painting_layer *layer, size_t count) {
  lua_createtable(L, 0, 16);
  cs_put_text(L, "name", layer->name);
  cs_put_text(L, "blend", layer->blend);
  cs_put_text(L, "colour", layer->colour);
  cs_put_flag(L, "group", layer->is_group);
  cs_put_flag(L, "visible", layer->is_visible);
  cs_put_number(L, "opacity", layer->opacity);
  cs_put_integer(L, "x", layer->x);
  cs_put_integer(L, "y", layer->y);
  cs_put_integer(L, "width", layer->width);
  cs_put_integer(L, "height", layer->height);
  if (layer->parent < count)
    cs_put_integer(L, "parent", (lua_Integer)layer->parent + 1);
  put_surface(L, "pixels", layer->surface);
}

/* Pushes "group/layer", at most CS_CONTENTS_DEPTH groups deep. */
static void push_path(lua_State *L, const cs_contents_layer *layers, size_t index) {
  size_t parent = layers[index].parent;
  luaL_checkstack(L, 4, "a path of a layer");
  if (parent == CS_CONTENTS_NONE) {
    lua_pushstring(L, layers[index].name);
    return;
  }
  push_path(L, layers, parent);
  lua_pushfstring(L, "%s/%s", lua_tostring(L, -1), layers[index].name);
  lua_remove(L, -2);
}

static void push_layers(lua_State *L, const celspan_painting *painting) {
  size_t count = celspan_painting_layer_count(painting);
  celspan_painting_layer layer = CELSPAN_PAINTING_LAYER;
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; celspan_painting_layer_at(painting, i, &layer); i++) {
    push_layer(L, &layer, count);
    const cs_contents_layer *contents = &painting->layers[i];
    cs_put_flag(L, "clipped", contents->is_clipped);
    cs_put_flag(L, "within", contents->is_within);
    push_path(L, painting->layers, i);
    lua_setfield(L, -2, "path");
    put_surface(L, "mask", layer.is_group ? contents->surface : NULL);
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

static void push_notes(lua_State *L, const celspan_painting *painting) {
  size_t layer, count = celspan_painting_layer_count(painting);
  const char *text;
  lua_newtable(L);
  for (size_t i = 0; (text = celspan_painting_note_at(painting, i, &layer)); i++) {
    if (painting->notes[i].is_own)
      continue; /* the code that composes the layers will draw it */
    lua_createtable(L, 0, 2);
    cs_put_text(L, "what", text);
    if (layer < count)
      cs_put_integer(L, "layer", (lua_Integer)layer + 1);
    lua_rawseti(L, -2, (lua_Integer)lua_rawlen(L, -2) + 1);
  }
}

static void push_keys(lua_State *L, const celspan_painting *painting) {
  size_t count = celspan_painting_key_count(painting);
  celspan_painting_key key = CELSPAN_PAINTING_KEY;
  lua_createtable(L, (int)count, 0);
  for (size_t i = 0; celspan_painting_key_at(painting, i, &key); i++) {
    lua_createtable(L, 0, 6);
    cs_put_integer(L, "layer", (lua_Integer)key.layer + 1);
    cs_put_integer(L, "frame", key.frame);
    if (key.is_opacity) {
      cs_put_number(L, "opacity", key.opacity);
      cs_put_text(L, "between", key.between);
      cs_put_numbers(L, "in", key.in, 2);
      cs_put_numbers(L, "out", key.out, 2);
    } else {
      cs_put_integer(L, "drawing", (lua_Integer)key.drawing + 1);
      cs_put_integer(L, "colour", key.colour);
    }
    lua_rawseti(L, -2, (lua_Integer)i + 1);
  }
}

static void put_clip(lua_State *L, const celspan_painting *painting) {
  double rate;
  int32_t from, to;
  if (!celspan_painting_clip(painting, &rate, &from, &to))
    return;
  cs_put_number(L, "fps", rate);
  cs_put_integer(L, "from", from);
  cs_put_integer(L, "to", to);
}

int cs_painting_read(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  cs_host_admit(L, path);
  celspan_context *context = cs_host_context(L);
  celspan_painting **painting =
      cs_userdata_push_holder(L, "celspan.painting", sizeof *painting, release);
  int32_t width, height;
  CS_HOST_TRY(L, celspan_painting_read(context, path, painting));
  celspan_painting_size(*painting, &width, &height);
  lua_createtable(L, 0, 4);
  cs_put_integer(L, "width", width);
  cs_put_integer(L, "height", height);
  push_layers(L, *painting);
  lua_setfield(L, -2, "layers");
  push_notes(L, *painting);
  lua_setfield(L, -2, "notes");
  push_keys(L, *painting);
  lua_setfield(L, -2, "keys");
  put_clip(L, *painting);
  return 1;
}
