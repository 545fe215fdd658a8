#include "trace/thinning.h"

typedef struct places {
  uint32_t *items;
  size_t count, capacity;
} places;

typedef struct thinner {
  celspan_context *context;
  cs_thin *thin;
  ptrdiff_t around[8];
  places now, next, marked;
} thinner;

static size_t plane_size(const cs_thin *thin) { return thin->stride * ((size_t)thin->height + 2); }

void cs_thin_offsets(const cs_thin *thin, ptrdiff_t offsets[8]) {
  ptrdiff_t s = (ptrdiff_t)thin->stride;
  const ptrdiff_t list[8] = {-s, 1 - s, 1, 1 + s, s, s - 1, -1, -s - 1};
  for (int i = 0; i < 8; i++)
    offsets[i] = list[i];
}

static celspan_status add(celspan_context *context, places *list, size_t place) {
  CS_TRY(cs_mem_reserve(context, (void **)&list->items, &list->capacity, list->count + 1,
                        sizeof *list->items));
  list->items[list->count++] = (uint32_t)place;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- one pixel */

/* Which neighbours are of the same colour: bit i for the neighbour at offset i. */
static unsigned about(const thinner *t, size_t place) {
  const unsigned char *at = t->thin->plane + place;
  unsigned bits = 0;
  for (int i = 0; i < 8; i++)
    bits |= (unsigned)(at[t->around[i]] == *at) << i;
  return bits;
}

static int count_bits(unsigned bits) { return __builtin_popcount(bits); }

/* How often, going around, one that is not drawn is followed by one that is. */
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

/* Marks those that may go, all seen at once; then takes away those that still may. */
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
  /* What was kept may go another time, when what is about it has gone. */
  places now = t->now;
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
  places *const lists[] = {&t.now, &t.next, &t.marked};
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
    /* Two sides that meet at a right angle hang together by their corner. */
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

/* 3 thirds for a side, 4 for a corner: within 8 % of the distance. From the top, then back. */
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
  out->plane = cs_mem_array(context->memory, plane_size(out), 1);
  out->depths = cs_mem_array(context->memory, plane_size(out), sizeof *out->depths);
  celspan_status status = CELSPAN_OK;
  if (out->plane && out->depths) {
    copy_labels(material, ground, out);
    measure_depths(out);
    status = thin_all(context, out);
  } else {
    status = cs_fail_memory(context);
  }
  if (status != CELSPAN_OK)
    cs_thin_finish(out, context);
  return status;
}

void cs_thin_finish(cs_thin *thin, celspan_context *context) {
  size_t size = plane_size(thin);
  cs_mem_free(context->memory, thin->plane, size);
  cs_mem_free(context->memory, thin->depths, size * sizeof *thin->depths);
  *thin = (cs_thin){.plane = NULL};
}
