/* A drawing with parts changed: a copy of its items in which changed parts are leaves. */
#include <stdlib.h>
#include <string.h>

#include "celspan/svg.h"
#include "inside/scene.h"
#include "readers/svg/document/art.h"

typedef struct changing {
  celspan_context *context;
  const celspan_svg_changed *changes;
  bool *are_labels;  /* whether the name of each change is a label; otherwise it is an id */
  uint32_t *numbers; /* the number of the element for each change; 0: the change has a name */
  size_t change_count;
  celspan_svg *art; /* the copy */
} changing;

static bool is_meant(const changing *c, size_t change, const cs_svg_item *item) {
  if (c->numbers[change])
    return item->facts && item->facts->number == c->numbers[change];
  const char *name = c->are_labels[change] ? item->label : item->id;
  return name && strcmp(name, c->changes[change].name) == 0;
}

static celspan_object *kept(celspan_object *object) {
  return object ? celspan_object_ref(object) : NULL;
}

/* The part that the function made, moved to the place where the item is drawn. */
static celspan_status make_other(changing *c, const celspan_svg_changed *change,
                                 const cs_svg_item *item, celspan_object **out) {
  celspan_object *home = kept(item->object), *other = NULL, *placed = NULL;
  celspan_status status = CELSPAN_OK;
  if (item->is_moved) {
    status = celspan_object_transform(c->context, item->object, &item->back, &placed);
    celspan_object_unref(home);
    home = status == CELSPAN_OK ? placed : NULL;
  }
  if (status == CELSPAN_OK)
    status = change->change(change->user, c->context, home, &other);
  celspan_object_unref(home);
  CS_TRY(status);
  if (item->is_moved) {
    status = celspan_object_transform(c->context, other, &item->moved, &placed);
    celspan_object_unref(other);
    other = status == CELSPAN_OK ? placed : NULL;
  }
  *out = other;
  return status;
}

/* Makes the item a leaf whose object is the result of the change: from now on it has no parts. */
static celspan_status change_item(changing *c, const celspan_svg_changed *change,
                                  cs_svg_item *item) {
  celspan_object *other;
  CS_TRY(make_other(c, change, item, &other));
  celspan_object_unref(item->object);
  item->object = other;
  cs_svg_item_drop(item->first);
  item->first = item->last = NULL;
  celspan_object_unref(item->own);
  item->own = kept(other);
  cs_svg_recipe_unref(item->filter);
  item->filter = NULL;
  celspan_object_unref(item->clip);
  item->clip = NULL;
  item->has_clip = false;
  celspan_object_unref(item->mask);
  item->mask = NULL;
  item->has_mask = item->isolates = false;
  item->opacity = 1;
  item->blend = CELSPAN_BLEND_NORMAL;
  return CELSPAN_OK;
}

/* Both the id and the label of an item may be named by changes: then one change acts on the result
 * of the other. */
static celspan_status change_as_meant(changing *c, cs_svg_item *item, bool *is_changed) {
  for (size_t i = 0; i < c->change_count && item->object; i++)
    if (is_meant(c, i, item)) {
      CS_TRY(change_item(c, &c->changes[i], item));
      *is_changed = true;
    }
  return CELSPAN_OK;
}

/* Copies the items inside `from` into `to`. *is_changed: whether one of them, or of their contents,
 * has changed. Recursion: the depth of items. */
static celspan_status copy_items(changing *c, const cs_svg_item *from, cs_svg_item *to,
                                 bool *is_changed);

static celspan_status copy_item(changing *c, const cs_svg_item *from, cs_svg_item *item,
                                bool *is_changed) {
  bool is_inside_changed = false;
  item->id = from->id;
  item->label = from->label;
  item->facts = from->facts;
  item->own = kept(from->own);
  item->filter = cs_svg_recipe_ref(from->filter);
  item->has_clip = from->has_clip;
  item->clip = kept(from->clip);
  item->has_mask = from->has_mask;
  item->mask = kept(from->mask);
  item->masks_by = from->masks_by;
  item->opacity = from->opacity;
  item->blend = from->blend;
  item->isolates = from->isolates;
  item->is_moved = from->is_moved;
  item->moved = from->moved;
  item->back = from->back;
  item->object = kept(from->object);
  CS_TRY(copy_items(c, from, item, &is_inside_changed));
  if (is_inside_changed)
    CS_TRY(cs_svg_item_compose(c->context, item));
  *is_changed = *is_changed || is_inside_changed;
  return change_as_meant(c, item, is_changed);
}

static celspan_status copy_items(changing *c, const cs_svg_item *from, cs_svg_item *to,
                                 bool *is_changed) {
  for (const cs_svg_item *inner = from->first; inner; inner = inner->next) {
    cs_svg_item *item;
    CS_TRY(cs_svg_item_append(c->context, c->art, to, &item));
    CS_TRY(copy_item(c, inner, item, is_changed));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- the whole */

/* Recursion: the depth of items. */
static bool has_number(const cs_svg_item *item, uint32_t number) {
  bool found = false;
  for (; item && !found; item = item->next)
    found = (item->facts && item->facts->number == number && item->object) ||
            has_number(item->first, number);
  return found;
}

/* The number in a name such as "#12", if the drawing has this element; otherwise 0. */
static uint32_t number_of(const celspan_svg *svg, const char *name) {
  char *end = NULL;
  unsigned long number = name[0] == '#' ? strtoul(name + 1, &end, 10) : 0;
  bool is_number = end && !*end && number > 0 && number <= UINT32_MAX;
  return is_number && has_number(svg->root, (uint32_t)number) ? (uint32_t)number : 0;
}

static celspan_status find_names(changing *c, const celspan_svg *svg) {
  for (size_t i = 0; i < c->change_count; i++) {
    const celspan_svg_changed *change = &c->changes[i];
    size_t place = 0;
    if (!change->name || !change->change)
      return cs_fail(c->context, CELSPAN_BAD_ARGUMENT,
                     "svg: changes[%zu] has no name or no function", i + 1);
    while (place < svg->part_count && strcmp(svg->parts[place].name, change->name) != 0)
      place++;
    bool is_part = place < svg->part_count;
    c->are_labels[i] = is_part && svg->parts[place].is_label;
    c->numbers[i] = is_part ? 0 : number_of(svg, change->name);
    if (!is_part && c->numbers[i] == 0)
      return cs_fail(c->context, CELSPAN_BAD_ARGUMENT, "svg: there is no part \"%s\"",
                     change->name);
  }
  return CELSPAN_OK;
}

static celspan_status copy_notes(changing *c, const celspan_svg *svg) {
  celspan_svg *art = c->art;
  art->skipped = cs_arena_take(c->context, &art->arena, svg->skipped_count * sizeof *art->skipped);
  if (!art->skipped)
    return CELSPAN_NO_MEMORY;
  for (; art->skipped_count < svg->skipped_count; art->skipped_count++)
    art->skipped[art->skipped_count] = svg->skipped[art->skipped_count];
  return CELSPAN_OK;
}

/* The copy borrows texts of the original drawing, and therefore keeps a reference to it. */
static celspan_status copy_art(changing *c, const celspan_svg *svg) {
  bool is_changed = false;
  c->art->width = svg->width;
  c->art->height = svg->height;
  c->art->seconds = svg->seconds;
  c->art->space = svg->space;
  c->art->origin = celspan_svg_ref((celspan_svg *)(uintptr_t)svg);
  CS_TRY(copy_notes(c, svg));
  CS_TRY(cs_svg_item_append(c->context, c->art, NULL, &c->art->root));
  CS_TRY(copy_item(c, svg->root, c->art->root, &is_changed));
  return cs_svg_art_complete(c->context, c->art);
}

celspan_status celspan_svg_with(celspan_context *context, const celspan_svg *svg,
                                const celspan_svg_changed *changes, size_t change_count,
                                celspan_svg **out) {
  CS_TRY(cs_check_given(context, "svg", "the drawing", svg));
  CS_TRY(cs_check_list(context, "svg", "changes", changes, change_count, CS_CHECK_ITEMS));
  changing c = {.context = context, .changes = changes, .change_count = change_count};
  CS_TRY(cs_svg_art_create(context, &c.art));
  c.are_labels = cs_arena_take(context, &c.art->arena, change_count * sizeof *c.are_labels);
  c.numbers = cs_arena_take(context, &c.art->arena, change_count * sizeof *c.numbers);
  celspan_status status = c.are_labels && c.numbers ? find_names(&c, svg) : CELSPAN_NO_MEMORY;
  if (status == CELSPAN_OK)
    status = copy_art(&c, svg);
  if (status == CELSPAN_OK)
    *out = c.art;
  else
    celspan_svg_unref(c.art);
  return status;
}
