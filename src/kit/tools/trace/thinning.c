#include "tools/trace/thinning.h"

typedef struct place_list {
  uint32_t *items;
  size_t count, capacity;
} place_list;

typedef struct thinner {
  celspan_context *context;
  cs_thin *thin;
  ptrdiff_t around[8];
  place_list now, next, marked;
} thinner;

static size_t plane_size(const cs_thin *thin) { return thin->stride * ((size_t)thin->height + 2); }

void cs_thin_offsets(const cs_thin *thin, ptrdiff_t offsets[8]) {
  ptrdiff_t s = (ptrdiff_t)thin->stride;
  const ptrdiff_t list[8] = {-s, 1 - s, 1, 1 + s, s, s - 1, -1, -s - 1};
  for (int i = 0; i < 8; i++)
    offsets[i] = list[i];
}

static celspan_status add(celspan_context *context, place_list *list, size_t place) {
  return CS_APPEND(context, list->items, list->count, list->capacity, (uint32_t)place);
}

/* ---------------------------------------------------------------- one pixel */

/* A bit for each neighbour: bit i is set if the neighbour at offset i has the same colour. */
static unsigned about(const thinner *t, size_t place) {
  const unsigned char *at = t->thin->plane + place;
  unsigned bits = 0;
  for (int i = 0; i < 8; i++)
    bits |= (unsigned)(at[t->around[i]] == *at) << i;
  return bits;
}

static int count_bits(unsigned bits) { return __builtin_popcount(bits); }

/* How many times, going once around, a drawn neighbour follows one that is not drawn. */
static int begins(unsigned bits) {
  unsigned before = (bits << 1 | bits >> 7) & 255;
  return count_bits(bits & ~before);
}

static bool may_go(unsigned bits, bool is_second) {
  const unsigned n = 1, e = 4, s = 16, w = 64;
  int count = count_bits(bits);
  if (count < 2 || count > 6 || begins(bits) != 1)
    return false;
  unsigned one = is_second ? n | e | w : n | e | s, other = is_second ? n | s | w : e | s | w;
  return (bits & one) != one && (bits & other) != other;
}

/* ---------------------------------------------------------------- rounds */

/* Marks the pixels that may be removed, all judged in the same state; then removes each marked
 * pixel that may still be removed. */
static celspan_status half_round(thinner *t, bool is_second, bool *has_changed) {
  t->marked.count = 0;
  for (size_t i = 0; i < t->now.count; i++)
    if (t->thin->plane[t->now.items[i]] && may_go(about(t, t->now.items[i]), is_second))
      CS_TRY(add(t->context, &t->marked, t->now.items[i]));
  for (size_t i = 0; i < t->marked.count; i++) {
    size_t place = t->marked.items[i];
    if (!t->thin->plane[place])
      continue;
    unsigned bits = about(t, place);
    if (begins(bits) != 1 || count_bits(bits) < 2)
      continue;
    t->thin->plane[place] = 0;
    *has_changed = true;
    for (int k = 0; k < 8; k++)
      if (bits >> k & 1)
        CS_TRY(add(t->context, &t->next, place + (size_t)t->around[k]));
  }
  return CELSPAN_OK;
}

static celspan_status thin_round(thinner *t, bool *has_changed) {
  *has_changed = false;
  t->next.count = 0;
  CS_TRY(half_round(t, false, has_changed));
  CS_TRY(half_round(t, true, has_changed));
  /* A pixel that was kept may be removed later, after its neighbours have been removed. */
  place_list now = t->now;
  t->now = t->next;
  t->next = now;
  return CELSPAN_OK;
}

static celspan_status find_sides(thinner *t) {
  const cs_thin *thin = t->thin;
  for (int32_t y = 0; y < thin->height; y++)
    for (int32_t x = 0; x < thin->width; x++) {
      size_t place = (size_t)(y + 1) * thin->stride + (size_t)(x + 1);
      if (thin->plane[place] && about(t, place) != 255)
        CS_TRY(add(t->context, &t->now, place));
    }
  return CELSPAN_OK;
}

static celspan_status run(thinner *t) {
  bool has_changed = true;
  CS_TRY(find_sides(t));
  while (has_changed)
    CS_TRY(thin_round(t, &has_changed));
  return CELSPAN_OK;
}

static celspan_status thin_all(celspan_context *context, cs_thin *thin) {
  thinner t = {.context = context, .thin = thin};
  cs_thin_offsets(thin, t.around);
  celspan_status status = run(&t);
  place_list *const lists[] = {&t.now, &t.next, &t.marked};
  for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
    cs_mem_free(context->memory, lists[i]->items, lists[i]->capacity * sizeof(uint32_t));
  return status;
}

void cs_thin_tidy(cs_thin *thin, const uint32_t *list, size_t count) {
  thinner t = {.thin = thin};
  cs_thin_offsets(thin, t.around);
  for (size_t i = 0; i < count; i++) {
    if (!thin->plane[list[i]])
      continue;
    unsigned bits = about(&t, list[i]);
    bool turns = false;
    for (int k = 0; k < 8; k += 2)
      turns = turns || ((bits >> k & 1) && (bits >> (k + 2) % 8 & 1));
    /* Two sides at a right angle are connected by their corner. */
    unsigned sides = bits & 0x55, corners = bits & 0xaa;
    unsigned filled = sides | corners;
    for (int k = 0; k < 8; k += 2)
      if ((sides >> k & 1) && (sides >> (k + 2) % 8 & 1))
        filled |= 1u << (k + 1);
    if (turns && begins(filled) == 1 && count_bits(bits) < 6 && count_bits(bits) >= 2)
      thin->plane[list[i]] = 0;
  }
}

/* ---------------------------------------------------------------- depths */

static uint16_t nearer(uint16_t depth, uint16_t other, int step) {
  int through = other + step;
  return through < depth ? (uint16_t)through : depth;
}

/* 3 thirds for a side, 4 for a corner: the error of the distance is at most 8 %. Goes from the top
 * to the bottom, then back. */
static void measure_depths(cs_thin *thin) {
  ptrdiff_t around[8];
  size_t size = plane_size(thin);
  cs_thin_offsets(thin, around);
  for (size_t i = thin->stride; i < size - thin->stride; i++) {
    uint16_t depth = thin->plane[i] ? UINT16_MAX : 0;
    static const int before[] = {7, 0, 1, 6};
    for (int k = 0; k < 4 && depth; k++)
      depth = nearer(depth, thin->depths[i + (size_t)around[before[k]]], before[k] % 2 ? 4 : 3);
    thin->depths[i] = depth;
  }
  for (size_t i = size - thin->stride; i-- > thin->stride;) {
    static const int after[] = {2, 3, 4, 5};
    for (int k = 0; k < 4 && thin->depths[i]; k++)
      thin->depths[i] =
          nearer(thin->depths[i], thin->depths[i + (size_t)around[after[k]]], after[k] % 2 ? 4 : 3);
  }
}

/* ---------------------------------------------------------------- planes */

static void copy_labels(const cs_material *material, unsigned char ground, cs_thin *out) {
  for (int32_t y = 0; y < out->height; y++) {
    const unsigned char *labels = cs_labels_at(material->labels, 0, y);
    unsigned char *row = out->plane + (size_t)(y + 1) * out->stride + 1;
    for (int32_t x = 0; x < out->width; x++) {
      bool is_drawn = labels[x] != ground && labels[x] < material->colours->count;
      row[x] = is_drawn ? (unsigned char)(labels[x] + 1) : 0;
    }
  }
}

celspan_status cs_thin_make(celspan_context *context, const cs_material *material,
                            unsigned char ground, cs_thin *out) {
  const cs_labels *labels = material->labels;
  *out = (cs_thin){.width = labels->width, .height = labels->height, .stride = labels->stride};
  celspan_status status = CS_ARRAY_MAKE(context, out->plane, plane_size(out));
  if (status == CELSPAN_OK)
    status = CS_ARRAY_MAKE(context, out->depths, plane_size(out));
  if (status == CELSPAN_OK) {
    copy_labels(material, ground, out);
    measure_depths(out);
    status = thin_all(context, out);
  }
  if (status != CELSPAN_OK)
    cs_thin_finish(out, context);
  return status;
}

void cs_thin_finish(cs_thin *thin, celspan_context *context) {
  CS_ARRAYS_FREE(context->memory, thin, plane, depths);
  *thin = (cs_thin){.plane = NULL};
}

/* ---------------------------------------------------------------- branches */

/* Marks pixels in the plane that belong to a branch. */
#define TAKEN 128
/* A spur is shorter than this multiple of the depth of the line that it leaves, plus a pixel. */
#define SPUR 1.2
/* How often spurs are searched for: one may hide another. */
enum { ROUNDS = 2, THIRDS = 3 };

typedef struct finder {
  celspan_context *context;
  cs_thin *thin;
  ptrdiff_t around[8];
  uint32_t *pixels; /* all remaining pixels of lines, from the top left */
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
    CS_TRY(CS_APPEND(f->context, f->pixels, f->pixel_count, f->pixel_capacity, (uint32_t)i));
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- walking */

static celspan_status add_place(finder *f, size_t place) {
  cs_branches *out = f->out;
  return CS_ARRAY_APPEND(f->context, out->places, out->place_count, (uint32_t)place);
}

/* The neighbour of a pixel on a line that was not visited before; sides are preferred to corners.
 * 0: there is none. */
static size_t next_of(const finder *f, size_t place, size_t before) {
  static const int order[8] = {0, 2, 4, 6, 1, 3, 5, 7};
  for (int i = 0; i < 8; i++) {
    size_t next = place + (size_t)f->around[order[i]];
    if (next != before && are_alike(f, place, next))
      return next;
  }
  return 0;
}

/* Walks from an end or fork, over a neighbour, to the next end or fork, or around to its
 * beginning. */
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
  return CS_ARRAY_APPEND(f->context, out->list, out->count, branch);
}

/* A branch of one step between two ends or forks is found from the first of them. Between two forks
 * it does not count as a branch. */
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

/* All spurs are found before any is removed, so that two at one fork are treated alike. */
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
  CS_ARRAYS_FREE(context->memory, branches, list, places);
  *branches = (cs_branches){.list = NULL};
}
