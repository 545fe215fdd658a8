#include "compose/palette.h"

#include "compose/blend.h"

#define SLOTS 256       /* palettes remembered; a power of two */
#define PART_LIMIT 4096 /* of all of them together */

struct cs_palettes {
  cs_palette slots[SLOTS]; /* without a shade: empty */
  cs_arena parts;
  size_t part_count;
};

celspan_status cs_palettes_create(celspan_context *context, cs_palettes **out) {
  cs_palettes *palettes = cs_mem_array(context->memory, 1, sizeof *palettes);
  if (!palettes)
    return cs_fail_memory(context);
  cs_arena_init(&palettes->parts);
  *out = palettes;
  return CELSPAN_OK;
}

void cs_palettes_destroy(cs_palettes *palettes, cs_memory *memory) {
  if (!palettes)
    return;
  cs_arena_finish(&palettes->parts, memory);
  cs_mem_free(memory, palettes, sizeof *palettes);
}

/* ---------------------------------------------------------------- making one */

/* The one leaf of a program that varies, if it has stops; else CS_STACK_NONE. */
static uint32_t find_varying(const cs_stack *stack, const cs_program *program) {
  uint32_t found = CS_STACK_NONE;
  for (uint32_t i = 0; i < program->length; i++) {
    uint32_t index = program->items[i].leaf;
    const cs_leaf *leaf = &stack->leaves[index];
    if (leaf->kind == CS_LEAF_FLAT)
      continue;
    if (leaf->kind != CS_LEAF_SHADED || found != CS_STACK_NONE)
      return CS_STACK_NONE;
    const celspan_texture *texture = stack->shades[leaf->detail].texture;
    if (texture->kind == CS_TEXTURE_TRIANGLE || texture->stop_count >= CS_BLEND_BATCH)
      return CS_STACK_NONE;
    found = index;
  }
  return found;
}

/* Paints of the stops, and clear. */
typedef struct samples {
  float s[CS_BLEND_BATCH][4], t[CS_BLEND_BATCH][4], rgba[CS_BLEND_BATCH][4];
} samples;

static void put_paint(samples *out, size_t i, const cs_paint *paint) {
  cs_v4_store(out->s[i], (cs_v4){paint->s[0], paint->s[1], paint->s[2], 0});
  cs_v4_store(out->t[i], (cs_v4){paint->t[0], paint->t[1], paint->t[2], 0});
}

/* What a program shows at every stop, and where the leaf that varies is clear. */
static celspan_status fold_stops(cs_composer *composer, const cs_program *program,
                                 const celspan_texture *texture, samples *room) {
  const cs_stack *stack = composer->stack;
  const cs_paint clear = CS_PAINT_CLEAR;
  cs_arena *scratch = &composer->scratch;
  cs_blend blend;
  for (size_t i = 0; i < texture->stop_count; i++)
    put_paint(room, i, &texture->stops[i].paint);
  put_paint(room, texture->stop_count, &clear);
  CS_TRY(cs_blend_begin(composer->context, scratch, stack, composer->isa,
                        (int32_t)texture->stop_count + 1, &blend));
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_leaf *leaf = &stack->leaves[program->items[i].leaf];
    CS_TRY(cs_blend_reach(composer->context, scratch, &blend, program->items[i].leaf));
    if (leaf->kind == CS_LEAF_FLAT)
      cs_blend_flat(&blend, leaf);
    else
      cs_blend_paints(&blend, leaf, (const float(*)[4])room->s, (const float(*)[4])room->t);
  }
  cs_blend_end(&blend, room->rgba);
  return CELSPAN_OK;
}

static void fill_parts(const celspan_texture *texture, const samples *folded,
                       cs_palette_part *parts) {
  size_t count = texture->stop_count;
  const cs_stop *stops = texture->stops;
  parts[0] = (cs_palette_part){.colour = cs_v4_load(folded->rgba[0])};
  for (size_t i = 1; i < count; i++) {
    cs_v4 from = cs_v4_load(folded->rgba[i - 1]), to = cs_v4_load(folded->rgba[i]);
    double length = stops[i].at - stops[i - 1].at;
    parts[i] = (cs_palette_part){from, to - from, stops[i - 1].at, length > 0 ? 1 / length : 0};
  }
  parts[count] = (cs_palette_part){.colour = cs_v4_load(folded->rgba[count - 1])};
  parts[count + 1] = (cs_palette_part){.colour = cs_v4_load(folded->rgba[count])};
}

static celspan_status make(cs_composer *composer, const cs_program *program, const cs_shade *shade,
                           cs_set_hash name, cs_palette *out) {
  cs_palettes *palettes = composer->palettes;
  size_t count = shade->texture->stop_count + 2;
  if (palettes->part_count + count > PART_LIMIT) {
    memset(palettes->slots, 0, sizeof palettes->slots);
    cs_arena_reset(&palettes->parts);
    palettes->part_count = 0;
  }
  cs_arena_reset(&composer->scratch);
  samples *room = cs_arena_take(composer->context, &composer->scratch, sizeof *room);
  cs_palette_part *parts =
      cs_arena_take(composer->context, &palettes->parts, count * sizeof *parts);
  if (!room || !parts)
    return CELSPAN_NO_MEMORY;
  palettes->part_count += count;
  CS_TRY(fold_stops(composer, program, shade->texture, room));
  fill_parts(shade->texture, room, parts);
  *out = (cs_palette){shade, parts, name};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- finding it again */

static cs_set_hash name_of(const cs_stack *stack, const cs_program *program) {
  cs_set_hash name = {0};
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_mark *mark = &stack->marks[program->items[i].leaf];
    name.a ^= mark->key[0];
    name.b ^= mark->key[1];
  }
  return name;
}

celspan_status cs_palette_find(cs_composer *composer, const cs_program *program,
                               const cs_palette **out) {
  const cs_stack *stack = composer->stack;
  *out = NULL;
  uint32_t leaf = composer->palettes ? find_varying(stack, program) : CS_STACK_NONE;
  if (leaf == CS_STACK_NONE)
    return CELSPAN_OK;
  cs_set_hash name = name_of(stack, program);
  cs_palette *slot = &composer->palettes->slots[name.a & (SLOTS - 1)];
  if (!slot->shade || !cs_set_hash_same(slot->name, name))
    CS_TRY(make(composer, program, &stack->shades[stack->leaves[leaf].detail], name, slot));
  *out = slot;
  return CELSPAN_OK;
}
