#include "writers/apart/apart.h"

#include <stdio.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/scene.h"

/* ---------------------------------------------------------------- layers */

static celspan_status add_layer(cs_apart *apart, size_t place, const celspan_cel *cel, size_t key) {
  if (apart->count == CS_APART_MOST)
    return cs_fail(apart->context, CELSPAN_LIMIT,
                   "the frame has more than %d cels, and as many layers are written at most: put "
                   "cels that belong together into one, as groups",
                   CS_APART_MOST);
  CS_TRY(CS_RESERVE(apart->context, apart->layers, apart->capacity, apart->count + 1));
  cs_apart_layer *layer = apart->layers + place;
  memmove(layer + 1, layer, (apart->count - place) * sizeof *layer);
  *layer = (cs_apart_layer){.cel = cel, .key = key, .opacity = 1};
  apart->count++;
  return CELSPAN_OK;
}

/* Takes the rostrum. */
static celspan_status expose(cs_apart *apart, cs_apart_layer *layer, celspan_rostrum *rostrum,
                             double weight) {
  celspan_status status =
      CS_RESERVE(apart->context, layer->exposures, layer->capacity, layer->count + 1);
  if (status == CELSPAN_OK)
    layer->exposures[layer->count++] = (celspan_exposure){rostrum, weight};
  else
    celspan_rostrum_unref(rostrum);
  return status;
}

static bool has_name(const celspan_cel *cel, const char *name) {
  return cel && strcmp(cs_mark_name(cel->mark), name) == 0;
}

/* How many cels of the same name are behind this one; of cels without a name, all cels. */
static size_t key_of(const celspan_rostrum *rostrum, size_t index) {
  const char *name = cs_mark_name(rostrum->cels[index]->mark);
  size_t key = 0;
  for (size_t i = 0; i < index; i++)
    key += !name[0] || has_name(rostrum->cels[i], name);
  return key;
}

/* The place of the layer of this name and key; the count of layers: there is none. */
static size_t find(const cs_apart *apart, const char *name, size_t key) {
  size_t place = 0;
  while (place < apart->count &&
         !(has_name(apart->layers[place].cel, name) && apart->layers[place].key == key))
    place++;
  return place;
}

/* *place: behind which layers of this exposure are; it grows. */
static celspan_status take_cel(cs_apart *apart, const celspan_exposure *exposure, size_t index,
                               size_t *place) {
  const cs_light none = {0};
  const celspan_rostrum *from = exposure->rostrum;
  size_t key = key_of(from, index);
  size_t found = find(apart, cs_mark_name(from->cels[index]->mark), key);
  bool is_new = found == apart->count;
  found = is_new ? *place : found;
  if (is_new)
    CS_TRY(add_layer(apart, found, from->cels[index], key));
  *place = found + 1;
  celspan_rostrum *alone;
  CS_TRY(cs_rostrum_change(apart->context, from, from->cels + index, 1, none, &alone));
  return expose(apart, &apart->layers[found], alone, exposure->weight);
}

static bool is_backlit(const celspan_rostrum *rostrum) {
  const cs_light *back = &rostrum->back;
  return back->texture || back->flat.r > 0 || back->flat.g > 0 || back->flat.b > 0 ||
         back->flat.a > 0;
}

/* The back light is the layer at place 0, if there is one. */
static celspan_status take_back(cs_apart *apart, const celspan_exposure *exposure) {
  celspan_rostrum *alone;
  if (!is_backlit(exposure->rostrum))
    return CELSPAN_OK;
  if (apart->count == 0 || apart->layers[0].cel)
    CS_TRY(add_layer(apart, 0, NULL, 0));
  CS_TRY(cs_rostrum_with(apart->context, exposure->rostrum, exposure->rostrum->cels, 0, &alone));
  return expose(apart, &apart->layers[0], alone, exposure->weight);
}

static celspan_status take_exposure(cs_apart *apart, const celspan_exposure *exposure) {
  CS_TRY(take_back(apart, exposure));
  size_t place = apart->count > 0 && !apart->layers[0].cel;
  for (size_t i = 0; i < exposure->rostrum->cel_count; i++)
    CS_TRY(take_cel(apart, exposure, i, &place));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- names */

/* Readers would take such a layer for mattes: CryptoCel00, CryptoName02. */
static bool is_reserved(const char *name) {
  size_t letters = strncmp(name, "CryptoCel", 9) == 0 ? 9 : 10;
  return (letters == 9 || strncmp(name, "CryptoName", 10) == 0) &&
         strspn(name + letters, "0123456789") == 2 && name[letters + 2] == '\0';
}

static bool is_taken(const cs_apart *apart, const cs_apart_layer *layer) {
  if (is_reserved(layer->name))
    return true;
  for (const cs_apart_layer *other = apart->layers; other < apart->layers + apart->count; other++)
    if (other != layer && strcmp(other->name, layer->name) == 0)
      return true;
  return false;
}

/* number: 0 for the name alone. */
static void try_name(cs_apart_layer *layer, const char *name, size_t most, size_t number) {
  char ending[24] = "";
  int size = number ? snprintf(ending, sizeof ending, "_%zu", number) : 0;
  cs_safe_name(name, most > (size_t)size ? most - (size_t)size : 0, layer->name);
  strcat(layer->name, ending);
}

/* Where layers of the same cel name are behind this one, they have the numbers below. */
static void name_layer(const cs_apart *apart, cs_apart_layer *layer, size_t most) {
  char plain[32];
  const char *name = layer->cel ? cs_mark_name(layer->cel->mark) : "backlight";
  bool is_first = !name[0] || layer->key == 0;
  snprintf(plain, sizeof plain, "cel_%zu", layer->key + 1);
  name = name[0] ? name : plain;
  size_t number = is_first ? 0 : layer->key + 1;
  for (try_name(layer, name, most, number); is_taken(apart, layer);
       try_name(layer, name, most, number))
    number = number ? number + 1 : 2;
}

/* ---------------------------------------------------------------- all */

celspan_status cs_apart_make(celspan_context *context, const celspan_exposure *exposures,
                             size_t count, size_t suffix, cs_apart *out) {
  cs_apart apart = {.context = context};
  celspan_status status = CELSPAN_OK;
  for (size_t i = 0; i < count && status == CELSPAN_OK; i++)
    if (cs_apart_shows(&exposures[i]))
      status = take_exposure(&apart, &exposures[i]);
  for (size_t i = 0; i < apart.count && status == CELSPAN_OK; i++)
    name_layer(&apart, &apart.layers[i], CS_APART_NAME - 1 - suffix);
  if (status == CELSPAN_OK)
    *out = apart;
  else
    cs_apart_finish(&apart);
  return status;
}

void cs_apart_finish(cs_apart *apart) {
  if (!apart->context)
    return;
  cs_memory *memory = apart->context->memory;
  for (cs_apart_layer *layer = apart->layers; layer < apart->layers + apart->count; layer++) {
    for (size_t i = 0; i < layer->count; i++)
      celspan_rostrum_unref(layer->exposures[i].rostrum);
    cs_mem_free(memory, layer->exposures, layer->capacity * sizeof *layer->exposures);
  }
  cs_mem_free(memory, apart->layers, apart->capacity * sizeof *apart->layers);
  *apart = (cs_apart){0};
}

/* ---------------------------------------------------------------- mixings */

/* *out: the cel without its mode, with `opacity` of its own. */
static celspan_status change_mixing(celspan_context *context, const celspan_cel *cel,
                                    double opacity, celspan_cel **out) {
  celspan_cel *bare;
  CS_TRY(cs_cel_bare(context, cel, (cs_cel_without){.mixing = true}, &bare));
  celspan_status status = celspan_cel_fade(context, bare, opacity, out);
  celspan_cel_unref(bare);
  return status;
}

/* The least whole number of steps that is not less than the opacity, except for rounding. */
static double round_up(double opacity, int steps) {
  double whole = (double)(int)(opacity * steps);
  return steps == 0 ? opacity : (whole < opacity * steps - 1e-9 ? whole + 1 : whole) / steps;
}

/* A layer of several exposures is mixed as a whole. */
static celspan_status take_mixing(celspan_context *context, cs_apart_layer *layer, int steps) {
  celspan_cel *changed;
  celspan_rostrum *rostrum, *from = layer->exposures[0].rostrum;
  if (!layer->cel || layer->count != 1)
    return CELSPAN_OK;
  const celspan_cel *cel = from->cels[0];
  layer->opacity = round_up(cel->opacity, steps);
  layer->blend = CS_BLEND_MODE(cel->blend);
  double rest = layer->opacity > 0 ? cel->opacity / layer->opacity : 1;
  CS_TRY(change_mixing(context, cel, rest < 1 ? rest : 1, &changed));
  celspan_status status = cs_rostrum_with(context, from, &changed, 1, &rostrum);
  celspan_cel_unref(changed);
  CS_TRY(status);
  celspan_rostrum_unref(from);
  layer->exposures[0].rostrum = rostrum;
  return CELSPAN_OK;
}

celspan_status cs_apart_take_mixings(cs_apart *apart, int steps) {
  for (size_t i = 0; i < apart->count; i++)
    CS_TRY(take_mixing(apart->context, &apart->layers[i], steps));
  return CELSPAN_OK;
}

const char *cs_apart_title(const cs_apart_layer *layer) {
  const char *name = layer->cel ? cs_mark_name(layer->cel->mark) : "";
  return name[0] ? name : layer->name;
}

/* ---------------------------------------------------------------- the hash */

static void hash_object_names(cs_hash *hash, const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  cs_hash_text(hash, cs_mark_name(object->mark));
  size_t count = data->kind == CS_PRIMITIVE_DATA_BOOLEAN ? data->boolean->operand_count : 0;
  for (size_t i = 0; i < count; i++)
    hash_object_names(hash, data->boolean->operands[i]);
}

static void hash_names(cs_hash *hash, const celspan_rostrum *rostrum) {
  for (size_t i = 0; i < rostrum->cel_count; i++) {
    const celspan_cel *cel = rostrum->cels[i];
    cs_hash_text(hash, cs_mark_name(cel->mark));
    for (size_t k = 0; k < cel->object_count; k++)
      hash_object_names(hash, cel->objects[k]);
  }
}

cs_hash cs_apart_hash(const celspan_exposure *exposures, size_t count) {
  cs_hash hash = cs_scene_hash(exposures, count);
  for (size_t i = 0; i < count; i++)
    hash_names(&hash, exposures[i].rostrum);
  return cs_hash_end(hash);
}
