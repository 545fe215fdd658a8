#include "trace/branches.h"

/* Set in the plane for pixels that are in a branch. */
#define TAKEN 128
/* A spur is shorter than this many times the depth of the line that it leaves, and a pixel more. */
#define SPUR 1.2
/* How often spurs are looked for: one may hide another. */
enum { ROUNDS = 2, THIRDS = 3 };

typedef struct finder {
  celspan_context *context;
  cs_thin *thin;
  ptrdiff_t around[8];
  uint32_t *pixels; /* all that are left of lines, from the top left */
  size_t pixel_count, pixel_capacity;
  cs_branches *out;
} finder;

static bool are_alike(const finder *f, size_t a, size_t b) {
  return ((f->thin->plane[a] ^ f->thin->plane[b]) & ~TAKEN) == 0;
}

static int degree(const finder *f, size_t place) {
  int count = 0;
  for (int i = 0; i < 8; i++)
    count += are_alike(f, place, place + (size_t)f->around[i]);
  return count;
}

static celspan_status list_pixels(finder *f) {
  const cs_thin *thin = f->thin;
  f->pixel_count = 0;
  for (size_t i = thin->stride; i < thin->stride * ((size_t)thin->height + 1); i++) {
    if (!thin->plane[i])
      continue;
    CS_TRY(cs_mem_reserve(f->context, (void **)&f->pixels, &f->pixel_capacity, f->pixel_count + 1,
                          sizeof *f->pixels));
    f->pixels[f->pixel_count++] = (uint32_t)i;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- walking */

static celspan_status add_place(finder *f, size_t place) {
  cs_branches *out = f->out;
  CS_TRY(cs_mem_reserve(f->context, (void **)&out->places, &out->place_capacity,
                        out->place_count + 1, sizeof *out->places));
  out->places[out->place_count++] = (uint32_t)place;
  return CELSPAN_OK;
}

/* The neighbour of a pixel on a line that is not the one that was before; by its side rather than by
 * a corner. 0: there is none. */
static size_t next_of(const finder *f, size_t place, size_t before) {
  static const int order[8] = {0, 2, 4, 6, 1, 3, 5, 7};
  for (int i = 0; i < 8; i++) {
    size_t next = place + (size_t)f->around[order[i]];
    if (next != before && are_alike(f, place, next))
      return next;
  }
  return 0;
}

/* From an end or fork over a neighbour to the next, or around to where it began. */
static celspan_status walk(finder *f, size_t from, size_t over) {
  cs_branches *out = f->out;
  cs_branch branch = {.first = out->place_count};
  size_t before = from, place = over;
  CS_TRY(add_place(f, from));
  while (place && place != from && degree(f, place) == 2) {
    f->thin->plane[place] |= TAKEN;
    CS_TRY(add_place(f, place));
    size_t next = next_of(f, place, before);
    before = place;
    place = next;
  }
  branch.is_closed = place == from && degree(f, from) == 2;
  if (place && !branch.is_closed)
    CS_TRY(add_place(f, place));
  branch.count = out->place_count - branch.first;
  CS_TRY(cs_mem_reserve(f->context, (void **)&out->list, &out->capacity, out->count + 1,
                        sizeof *out->list));
  out->list[out->count++] = branch;
  return CELSPAN_OK;
}

/* A way of one step, between two ends or forks, is walked from the first of them; between forks it is
 * none. */
static bool is_way(const finder *f, size_t from, size_t over) {
  int there = degree(f, over);
  if (there == 2)
    return (f->thin->plane[over] & TAKEN) == 0;
  return from < over && (there == 1 || degree(f, from) == 1);
}

static celspan_status walk_from(finder *f, size_t place) {
  int count = degree(f, place);
  if (count == 2)
    return CELSPAN_OK;
  if (count == 0)
    return walk(f, place, 0);
  for (int i = 0; i < 8; i++) {
    size_t over = place + (size_t)f->around[i];
    if (are_alike(f, place, over) && is_way(f, place, over))
      CS_TRY(walk(f, place, over));
  }
  return CELSPAN_OK;
}

static celspan_status walk_closed(finder *f, size_t place) {
  if (f->thin->plane[place] & TAKEN || degree(f, place) != 2)
    return CELSPAN_OK;
  f->thin->plane[place] |= TAKEN;
  return walk(f, place, next_of(f, place, 0));
}

static celspan_status walk_all(finder *f) {
  f->out->count = f->out->place_count = 0;
  for (size_t i = 0; i < f->pixel_count; i++)
    CS_TRY(walk_from(f, f->pixels[i]));
  for (size_t i = 0; i < f->pixel_count; i++)
    CS_TRY(walk_closed(f, f->pixels[i]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- spurs */

static bool is_spur(const finder *f, const cs_branch *branch) {
  const uint32_t *places = f->out->places + branch->first;
  int first = degree(f, places[0]), last = degree(f, places[branch->count - 1]);
  if (branch->is_closed || !((first == 1 && last > 2) || (last == 1 && first > 2)))
    return false;
  size_t fork = first == 1 ? places[branch->count - 1] : places[0];
  return (double)branch->count < SPUR * f->thin->depths[fork] / THIRDS + 1;
}

static void drop(finder *f, const cs_branch *branch) {
  const uint32_t *places = f->out->places + branch->first;
  bool begins_at_fork = degree(f, places[0]) > 2;
  for (size_t i = begins_at_fork; i + !begins_at_fork < branch->count; i++)
    f->thin->plane[places[i]] = 0;
}

/* All are found before any goes, so that two at one fork are judged alike. */
static bool drop_spurs(finder *f) {
  size_t spurs = 0;
  for (size_t i = 0; i < f->out->count; i++)
    if (is_spur(f, &f->out->list[i]))
      f->out->list[spurs++] = f->out->list[i];
  for (size_t i = 0; i < spurs; i++)
    drop(f, &f->out->list[i]);
  return spurs > 0;
}

static celspan_status find(finder *f) {
  CS_TRY(list_pixels(f));
  cs_thin_tidy(f->thin, f->pixels, f->pixel_count);
  CS_TRY(list_pixels(f));
  CS_TRY(walk_all(f));
  for (int round = 0; round < ROUNDS && drop_spurs(f); round++) {
    for (size_t i = 0; i < f->pixel_count; i++)
      f->thin->plane[f->pixels[i]] &= (unsigned char)~TAKEN;
    CS_TRY(list_pixels(f));
    cs_thin_tidy(f->thin, f->pixels, f->pixel_count);
    CS_TRY(list_pixels(f));
    CS_TRY(walk_all(f));
  }
  return CELSPAN_OK;
}

celspan_status cs_branches_find(celspan_context *context, cs_thin *thin, cs_branches *out) {
  finder f = {.context = context, .thin = thin, .out = out};
  *out = (cs_branches){.list = NULL};
  cs_thin_offsets(thin, f.around);
  celspan_status status = find(&f);
  cs_mem_free(context->memory, f.pixels, f.pixel_capacity * sizeof *f.pixels);
  return status;
}

void cs_branches_finish(cs_branches *branches, celspan_context *context) {
  cs_mem_free(context->memory, branches->list, branches->capacity * sizeof *branches->list);
  cs_mem_free(context->memory, branches->places,
              branches->place_capacity * sizeof *branches->places);
  *branches = (cs_branches){.list = NULL};
}
