#include "readers/svg/document/art.h"

#include <stdio.h>
#include <string.h>

#include "inside/context.h"
#include "inside/hash.h"
#include "inside/scene.h"
#include "readers/svg/document/objects.h"

/* ---------------------------------------------------------------- life */

celspan_status cs_svg_art_create(celspan_context *context, celspan_svg **out) {
  celspan_svg *art;
  CS_TRY(CS_COUNTED_MAKE(context, art));
  cs_arena_init(&art->arena);
  *out = art;
  return CELSPAN_OK;
}

/* Releases the contents of items, not the items. Recursion: the depth of items, which is limited by
 * the depth of the document. */
void cs_svg_item_drop(cs_svg_item *item) {
  for (; item; item = item->next) {
    cs_svg_item_drop(item->first);
    celspan_object_unref(item->own);
    celspan_object_unref(item->clip);
    celspan_object_unref(item->object);
    celspan_object_unref(item->mask);
    cs_svg_recipe_unref(item->filter);
  }
}

static void destroy(celspan_svg *svg) {
  cs_svg_item_drop(svg->root);
  for (size_t i = 0; i < svg->part_count; i++)
    celspan_object_unref(svg->parts[i].object);
  celspan_object_unref(svg->object);
  celspan_svg_unref(svg->origin);
  cs_memory *memory = svg->memory;
  cs_arena_finish(&svg->arena, memory);
  cs_counted_free(memory, svg, sizeof *svg);
}

CS_COUNTED(celspan_svg)

/* ---------------------------------------------------------------- items */

static void append(cs_svg_item *parent, cs_svg_item *item) {
  if (parent->last)
    parent->last = parent->last->next = item;
  else
    parent->first = parent->last = item;
}

celspan_status cs_svg_item_append(celspan_context *context, celspan_svg *art, cs_svg_item *parent,
                                  cs_svg_item **out) {
  cs_svg_item *item = cs_arena_take(context, &art->arena, sizeof *item);
  if (!item)
    return CELSPAN_NO_MEMORY;
  *item = (cs_svg_item){.opacity = 1};
  if (parent)
    append(parent, item);
  *out = item;
  return CELSPAN_OK;
}

celspan_status cs_svg_text_copy(celspan_context *context, celspan_svg *art, const char *text,
                                const char **out) {
  size_t size = strlen(text) + 1;
  char *copy = cs_arena_take(context, &art->arena, size);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  *out = memcpy(copy, text, size);
  return CELSPAN_OK;
}

/* Many images in a row show one file. */
celspan_status cs_svg_name_file(celspan_context *context, celspan_svg *art, const char *path) {
  if (art->named && strcmp(art->named->path, path) == 0)
    return CELSPAN_OK;
  cs_svg_named *named = cs_arena_take(context, &art->arena, sizeof *named);
  if (!named)
    return CELSPAN_NO_MEMORY;
  named->next = art->named;
  CS_TRY(cs_svg_text_copy(context, art, path, &named->path));
  art->named = named;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- composing */

/* The union of the objects of the items inside; NULL for none. If there is only one object and it
 * has a mode, a union is needed, because the effects of the item would otherwise act on the object
 * itself. */
static celspan_status unite(celspan_context *context, const cs_svg_item *item,
                            celspan_object **out) {
  size_t count = 0, most = 0;
  for (const cs_svg_item *inner = item->first; inner; inner = inner->next)
    most += inner->object != NULL;
  *out = NULL;
  if (most == 0)
    return CELSPAN_OK;
  celspan_object **objects;
  CS_TRY(CS_MAKE(context, objects, most));
  for (const cs_svg_item *inner = item->first; inner; inner = inner->next)
    if (inner->object)
      objects[count++] = inner->object;
  celspan_status status = CELSPAN_OK;
  if (count == 1 && cs_object_mode(objects[0]) == CELSPAN_BLEND_NORMAL)
    *out = celspan_object_ref(objects[0]);
  else
    status = celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, objects, count, out);
  cs_mem_free(context->memory, objects, most * sizeof(celspan_object *));
  return status;
}

static celspan_status clip(celspan_context *context, celspan_object *shape,
                           celspan_object **object) {
  celspan_object *both[2] = {*object, shape}, *made = NULL;
  celspan_status status = CELSPAN_OK;
  if (shape)
    status = celspan_object_create_boolean(context, CELSPAN_OPERATOR_CLIP, both, 2, &made);
  return cs_svg_object_replace(status, made, object);
}

static celspan_status fade(celspan_context *context, double share, celspan_object **object) {
  celspan_object *made = NULL;
  if (share == 1)
    return CELSPAN_OK;
  celspan_status status = celspan_object_fade(context, *object, share, &made);
  return cs_svg_object_replace(status, made, object);
}

static celspan_status mask(celspan_context *context, const cs_svg_item *item,
                           celspan_object **object) {
  celspan_object *made = NULL;
  celspan_status status = CELSPAN_OK;
  if (item->mask)
    status =
        celspan_object_create_matte(context, *object, item->mask, item->masks_by, false, &made);
  return cs_svg_object_replace(status, made, object);
}

/* Needed only if a mode is inside: any other object does not change. */
static celspan_status isolate(celspan_context *context, celspan_object **object) {
  const celspan_group_desc desc = {.struct_size = sizeof desc,
                                   .objects = object,
                                   .object_count = 1,
                                   .opacity = 1,
                                   .isolate = CELSPAN_ISOLATION_ON};
  celspan_object *made = NULL;
  if (!cs_object_blends(*object, CELSPAN_SPACE_LINEAR) &&
      !cs_object_blends(*object, CELSPAN_SPACE_SRGB))
    return CELSPAN_OK;
  celspan_status status = celspan_object_create_group(context, &desc, &made);
  return cs_svg_object_replace(status, made, object);
}

/* Modes inside do not act on the backdrop of the item. A filter may draw something where the item
 * is empty. */
static celspan_status filter(celspan_context *context, const cs_svg_recipe *recipe,
                             celspan_object **object) {
  if (*object)
    CS_TRY(isolate(context, object));
  return cs_svg_recipe_apply(context, recipe, object);
}

static celspan_status blend(celspan_context *context, celspan_blend mode, celspan_object **object) {
  celspan_object *made = NULL;
  if (mode == CELSPAN_BLEND_NORMAL)
    return CELSPAN_OK;
  celspan_status status = celspan_object_blend(context, *object, mode, &made);
  return cs_svg_object_replace(status, made, object);
}

/* Names are for messages; an id that is not allowed as the name of an object is ignored. */
static celspan_status name(celspan_context *context, const char *id, celspan_object **object) {
  celspan_object *made;
  celspan_status status = celspan_object_named(context, *object, id, &made);
  if (status == CELSPAN_BAD_ARGUMENT)
    return CELSPAN_OK;
  return cs_svg_object_replace(status, made, object);
}

static celspan_status compose(celspan_context *context, cs_svg_item *item) {
  celspan_object_unref(item->object);
  item->object = NULL;
  if (item->own)
    item->object = celspan_object_ref(item->own);
  else
    CS_TRY(unite(context, item, &item->object));
  if (item->filter)
    CS_TRY(filter(context, item->filter, &item->object));
  if (item->object && item->has_clip)
    CS_TRY(clip(context, item->clip, &item->object));
  if (item->object && item->has_mask)
    CS_TRY(mask(context, item, &item->object));
  if (item->object && item->isolates)
    CS_TRY(isolate(context, &item->object));
  if (item->object)
    CS_TRY(fade(context, item->opacity, &item->object));
  if (item->object)
    CS_TRY(blend(context, item->blend, &item->object));
  if (item->object && item->id)
    CS_TRY(name(context, item->id, &item->object));
  return CELSPAN_OK;
}

celspan_status cs_svg_item_compose(celspan_context *context, cs_svg_item *item) {
  const cs_mark before = context->origin;
  if (item->facts)
    context->origin = item->facts->place;
  celspan_status status = compose(context, item);
  context->origin = before;
  return status;
}

/* ---------------------------------------------------------------- parts */

typedef struct listing {
  celspan_context *context;
  cs_hash_table names; /* to places in the list */
  CS_ARRAY(cs_svg_part, parts);
  CS_ARRAY(bool, is_shared); /* more than one item has this label */
  size_t count;
  celspan_space space;
} listing;

static cs_hash hash_name(const char *text) {
  cs_hash hash = cs_hash_begin(0x70617274u);
  cs_hash_text(&hash, text);
  return cs_hash_end(hash);
}

/* An item's object at its place in the file, in the space of the drawing. */
static celspan_status at_home(celspan_context *context, celspan_space space,
                              const cs_svg_item *item, celspan_object **out) {
  celspan_object *group;
  CS_TRY(cs_object_in_space(context, item->object, space, &group));
  *out = group;
  if (!item->is_moved)
    return CELSPAN_OK;
  celspan_status status = celspan_object_transform(context, group, &item->back, out);
  celspan_object_unref(group);
  return status;
}

static celspan_status list_part(listing *list, const char *text, const cs_svg_item *item,
                                bool is_label) {
  size_t place;
  if (cs_hash_table_find(&list->names, hash_name(text), &place)) {
    list->is_shared[place] = list->is_shared[place] || is_label;
    return CELSPAN_OK;
  }
  CS_TRY(CS_ARRAY_RESERVE(list->context, list->parts, list->count + 1));
  CS_TRY(CS_ARRAY_RESERVE(list->context, list->is_shared, list->count + 1));
  CS_TRY(cs_hash_table_add(&list->names, list->context, hash_name(text), list->count));
  list->is_shared[list->count] = false;
  list->parts[list->count] = (cs_svg_part){text, is_label, NULL};
  CS_TRY(at_home(list->context, list->space, item, &list->parts[list->count].object));
  list->count++;
  return CELSPAN_OK;
}

/* First the items that are drawn at their own place, then those that are shown only by `use`.
 * Recursion: the depth of items. */
static celspan_status list_parts(listing *list, const cs_svg_item *item, bool is_label,
                                 bool is_moved) {
  for (; item; item = item->next) {
    const char *text = is_label ? item->label : item->id;
    if (text && *text && item->object && item->is_moved == is_moved)
      CS_TRY(list_part(list, text, item, is_label));
    CS_TRY(list_parts(list, item->first, is_label, is_moved));
  }
  return CELSPAN_OK;
}

static celspan_status copy_parts(listing *list, celspan_svg *art) {
  art->parts = cs_arena_take(list->context, &art->arena, list->count * sizeof *art->parts);
  if (!art->parts)
    return CELSPAN_NO_MEMORY;
  for (size_t i = 0; i < list->count; i++)
    if (!list->is_shared[i]) {
      art->parts[art->part_count++] = list->parts[i];
      list->parts[i].object = NULL;
    }
  return CELSPAN_OK;
}

static celspan_status make_parts(celspan_context *context, celspan_svg *art) {
  listing list = {.context = context, .space = art->space};
  celspan_status status = CELSPAN_OK;
  for (int pass = 0; pass < 4 && status == CELSPAN_OK; pass++)
    status = list_parts(&list, art->root, pass >= 2, pass % 2 == 1);
  if (status == CELSPAN_OK)
    status = copy_parts(&list, art);
  for (size_t i = 0; i < list.count; i++)
    celspan_object_unref(list.parts[i].object);
  cs_hash_table_finish(&list.names, context);
  CS_ARRAYS_FREE(context->memory, &list, parts, is_shared);
  return status;
}

/* ---------------------------------------------------------------- elements */

typedef struct visiting {
  celspan_context *context;
  celspan_space space;
  celspan_svg_visit visit;
  void *user;
  cs_hash_table visited; /* the numbers of the visited items */
} visiting;

static celspan_status visit_element(visiting *v, const cs_svg_item *item, int32_t depth) {
  const cs_svg_facts *facts = item->facts;
  celspan_object *object;
  cs_hash hash = cs_hash_begin(0x656c656du);
  size_t place;
  char name[16];
  cs_hash_word(&hash, facts->number);
  hash = cs_hash_end(hash);
  if (cs_hash_table_find(&v->visited, hash, &place))
    return CELSPAN_OK;
  CS_TRY(cs_hash_table_add(&v->visited, v->context, hash, facts->number));
  CS_TRY(at_home(v->context, v->space, item, &object));
  snprintf(name, sizeof name, "#%u", facts->number);
  celspan_svg_element element = {.name = name,
                                 .tag = facts->tag,
                                 .id = item->id,
                                 .label = item->label,
                                 .classes = facts->classes,
                                 .fill = facts->fill[0] ? facts->fill : NULL,
                                 .line = (int32_t)facts->line,
                                 .depth = depth,
                                 .object = object};
  celspan_status status = v->visit(v->user, &element);
  celspan_object_unref(object);
  return status;
}

/* depth: how many visited elements contain the items. Recursion: the depth of items. */
static celspan_status visit_items(visiting *v, const cs_svg_item *item, bool is_moved,
                                  int32_t depth) {
  for (; item; item = item->next) {
    bool is_visited = item->facts && item->object && item->is_moved == is_moved;
    if (is_visited)
      CS_TRY(visit_element(v, item, depth));
    CS_TRY(visit_items(v, item->first, is_moved, depth + is_visited));
  }
  return CELSPAN_OK;
}

celspan_status celspan_svg_elements(celspan_context *context, const celspan_svg *svg,
                                    celspan_svg_visit visit, void *user) {
  visiting v = {.context = context, .space = svg->space, .visit = visit, .user = user};
  celspan_status status = visit_items(&v, svg->root, false, 0);
  if (status == CELSPAN_OK)
    status = visit_items(&v, svg->root, true, 0);
  cs_hash_table_finish(&v.visited, context);
  return status;
}

/* ---------------------------------------------------------------- the whole */

celspan_status cs_svg_art_complete(celspan_context *context, celspan_svg *art) {
  if (art->root->object)
    CS_TRY(cs_object_in_space(context, art->root->object, art->space, &art->object));
  else
    CS_TRY(celspan_object_create_boolean(context, CELSPAN_OPERATOR_UNION, NULL, 0, &art->object));
  return make_parts(context, art);
}

/* ---------------------------------------------------------------- questions */

celspan_object *celspan_svg_object(const celspan_svg *svg) { return svg->object; }

celspan_point celspan_svg_size(const celspan_svg *svg) {
  return (celspan_point){svg->width, svg->height};
}

size_t celspan_svg_part_count(const celspan_svg *svg) { return svg->part_count; }

celspan_object *celspan_svg_part(const celspan_svg *svg, size_t index, const char **part_name) {
  *part_name = svg->parts[index].name;
  return svg->parts[index].object;
}

size_t celspan_svg_skipped_count(const celspan_svg *svg) { return svg->skipped_count; }

const char *celspan_svg_skipped(const celspan_svg *svg, size_t index, int32_t *line) {
  *line = svg->skipped[index].line;
  return svg->skipped[index].what;
}
