#include "engine/events/visit.h"

#include "engine/row/row.h"

#define NONE UINT32_MAX

/* The first child of some windings, and the next one of the same parent. NONE: there is none. */
typedef struct family {
  uint32_t child, sibling;
} family;

typedef struct walk {
  const cs_plan *plan;
  const cs_events *events;
  cs_composer *composer;
  cs_events_visitor visitor;
  void *user;
  uint32_t *shown; /* by windings: the number of their cell; NONE: beside no part */
} walk;

static void find_families(const cs_windings *windings, family *out) {
  for (size_t i = 0; i < windings->count; i++)
    out[i] = (family){NONE, NONE};
  for (size_t i = windings->count; i-- > 1;) {
    family *parent = &out[windings->entries[i].parent];
    out[i].sibling = parent->child;
    parent->child = (uint32_t)i;
  }
}

/* Crosses a boundary from left to right (sign 1) or back (sign -1). */
static void cross(const walk *w, uint32_t boundary, int32_t sign) {
  const cs_boundary_set *set = &w->plan->boundaries;
  const cs_deferred *deferred = w->plan->cull.deferred_list;
  if (boundary < set->chain_count) {
    const cs_boundary_chain *chain = &set->chains[boundary];
    cs_composer_cross(w->composer, chain->layer, sign * chain->direction);
    return;
  }
  const cs_bundle *bundle = &w->events->bundles.bundles[boundary - set->chain_count];
  for (uint32_t k = bundle->first; k < bundle->first + bundle->count; k++)
    cs_composer_cross(w->composer, deferred[k].layer, sign * deferred[k].direction);
}

static celspan_status visit(const walk *w, uint32_t windings) {
  cs_cell cell;
  if (w->shown[windings] == NONE)
    return CELSPAN_OK;
  (void)cs_composer_begin_row(w->composer); /* programs composed before are not needed any more */
  cs_composer_cell(w->composer, &cell);
  CS_TRY(w->composer->failure);
  return w->visitor(w->user, w->composer, &cell, &w->shown[windings]);
}

static celspan_status visit_all(const walk *w, const family *families) {
  const cs_windings_entry *entries = w->events->windings.entries;
  CS_TRY(visit(w, 0));
  for (uint32_t at = 0, next = families[0].child; next != NONE || at != 0;) {
    if (next != NONE) {
      at = next;
      cross(w, entries[at].boundary, 1);
      CS_TRY(visit(w, at));
      next = families[at].child;
    } else {
      cross(w, entries[at].boundary, -1);
      next = families[at].sibling;
      at = entries[at].parent;
    }
  }
  return CELSPAN_OK;
}

static celspan_status find_shown(celspan_context *context, const cs_plan *plan,
                                 const cs_events *events, walk *w) {
  cs_row_maker rows; /* whose composer knows which pictures are opaque */
  size_t count = events->windings.count;
  family *families;
  CS_TRY(CS_MAKE(context, families, count));
  find_families(&events->windings, families);
  celspan_status status = cs_row_maker_init(&rows, context, plan);
  w->composer = &rows.composer;
  if (status == CELSPAN_OK)
    status = visit_all(w, families);
  cs_row_maker_finish(&rows);
  cs_mem_free(context->memory, families, count * sizeof *families);
  return status;
}

/* ---------------------------------------------------------------- parts */

static void find_used(const cs_events *events, uint32_t *shown) {
  for (size_t i = 1; i < events->windings.count; i++)
    shown[i] = NONE;
  for (size_t i = 0; i < events->part_count; i++)
    shown[events->parts[i].left] = shown[events->parts[i].right] = 0;
}

static bool is_continued(const cs_events_part *part, const cs_events_part *next) {
  return part->foot == next->top && part->left == next->left && part->right == next->right;
}

/* latest: by course, 1 more than the place of its last part that can be seen; all 0. */
static void reduce(cs_events *events, const uint32_t *shown, uint32_t *latest) {
  size_t count = 0;
  for (size_t i = 0; i < events->part_count; i++) {
    cs_events_part part = events->parts[i];
    uint32_t *last = &latest[part.course];
    part.left = shown[part.left];
    part.right = shown[part.right];
    if (part.left == part.right)
      continue;
    if (*last > 0 && is_continued(&events->parts[*last - 1], &part)) {
      events->parts[*last - 1].foot = part.foot;
      continue;
    }
    events->parts[count++] = part;
    *last = (uint32_t)count;
  }
  events->part_count = count;
}

celspan_status cs_events_show(celspan_context *context, const cs_plan *plan, cs_events *events,
                              cs_events_visitor visitor, void *user) {
  size_t count = events->windings.count, courses = events->courses.course_count + 1;
  walk w = {.plan = plan, .events = events, .visitor = visitor, .user = user};
  uint32_t *latest = NULL;
  CS_TRY(CS_MAKE(context, w.shown, count));
  find_used(events, w.shown);
  celspan_status status = find_shown(context, plan, events, &w);
  if (status == CELSPAN_OK)
    status = CS_MAKE(context, latest, courses);
  if (status == CELSPAN_OK) {
    reduce(events, w.shown, latest);
    cs_mem_free(context->memory, latest, courses * sizeof *latest);
  }
  cs_mem_free(context->memory, w.shown, count * sizeof *w.shown);
  return status;
}
