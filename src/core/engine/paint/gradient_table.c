#include "engine/paint/gradient_table.h"

#define SLOTS 1024          /* tables remembered; a power of two */
#define SECTION_LIMIT 16384 /* sections of all tables together */
#define FEW 4               /* pixels that are found one by one: vectors do not pay */

struct cs_gradient_tables {
  celspan_context *context;
  const cs_stack *stack;
  cs_isa isa;
  cs_arena *scratch;              /* borrowed */
  cs_gradient_table slots[SLOTS]; /* a slot without a shade and a name is empty */
  cs_arena sections;              /* the sections of all tables */
  size_t section_count;
};

celspan_status cs_gradient_tables_create(celspan_context *context, const cs_stack *stack,
                                         cs_isa isa, cs_arena *scratch, cs_gradient_tables **out) {
  cs_gradient_tables *tables;
  CS_TRY(CS_MAKE(context, tables, 1));
  tables->context = context;
  tables->stack = stack;
  tables->isa = isa;
  tables->scratch = scratch;
  cs_arena_init(&tables->sections);
  *out = tables;
  return CELSPAN_OK;
}

void cs_gradient_tables_destroy(cs_gradient_tables *tables, cs_memory *memory) {
  if (!tables)
    return;
  cs_arena_finish(&tables->sections, memory);
  cs_mem_free(memory, tables, sizeof *tables);
}

/* ---------------------------------------------------------------- colours */

static inline void put_colour(const cs_gradient_table *table, double at, float *rgba) {
  size_t section = cs_gradient_table_section_at(table->shade, at);
  cs_v4_store(rgba, cs_gradient_table_mix(&table->sections[section], at));
}

/* Neighbours lie mostly in the same section. */
static void put_colours(const cs_gradient_table *table, const double *at, int32_t count,
                        float (*rgba)[4]) {
  const celspan_texture *texture = table->shade->texture;
  const size_t stops = texture->variation->stop_count;
  const cs_gradient_table_section *section = table->sections;
  double from = INFINITY, to = INFINITY;
  for (int32_t k = 0; k < count; k++) {
    if (!(at[k] >= from && at[k] < to)) {
      const size_t i = cs_gradient_table_section_at(table->shade, at[k]);
      section = &table->sections[i];
      from = i == 0 ? -INFINITY : i <= stops ? texture->variation->stops[i - 1].at : INFINITY;
      to = i < stops ? texture->variation->stops[i].at : INFINITY;
    }
    cs_v4_store(rgba[k], cs_gradient_table_mix(section, at[k]));
  }
}

void cs_gradient_table_colours(const cs_gradient_table *table, const cs_batch *batch,
                               float (*rgba)[4]) {
  const int32_t count = table->shade->is_steady ? 1 : batch->count;
  for (int32_t k = 0; k < count && count <= FEW; k++)
    put_colour(table, cs_shade_at(table->shade, cs_batch_centre(batch, k), batch->y), rgba[k]);
  for (int32_t first = 0, k = 0; k < count && count > FEW; first = k) {
    double x[CS_SHADE_PLACES], at[CS_SHADE_PLACES];
    for (; k < count && k - first < CS_SHADE_PLACES; k++)
      x[k - first] = cs_batch_centre(batch, k);
    cs_shade_find(table->shade, x, k - first, batch->y, at);
    put_colours(table, at, k - first, rgba + first);
  }
  for (int32_t k = count; k < batch->count; k++)
    memcpy(rgba[k], rgba[0], sizeof rgba[k]);
}

/* ---------------------------------------------------------------- which programs */

/* The layer of the only gradient of a program, with stops; CS_STACK_NONE where other layers vary,
 * or there are too many stops. */
static uint32_t find_varying(const cs_stack *stack, const cs_program *program) {
  uint32_t found = CS_STACK_NONE;
  if (cs_program_curves(stack, program))
    return CS_STACK_NONE;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    if (layer->kind == CS_LAYER_FLAT)
      continue;
    const celspan_texture *texture =
        layer->kind == CS_LAYER_SHADED ? stack->shades[layer->index].texture : NULL;
    if (found != CS_STACK_NONE || !texture || texture->kind == CS_TEXTURE_TRIANGLE ||
        texture->variation->stop_count >= CS_OVER_ROW_BATCH)
      return CS_STACK_NONE;
    found = program->items[i].layer;
  }
  return found;
}

/* ---------------------------------------------------------------- making a table */

/* A paint for each stop and a clear one, and the colours that a program shows with them. */
typedef struct samples {
  float s[CS_OVER_ROW_BATCH][4], t[CS_OVER_ROW_BATCH][4], rgba[CS_OVER_ROW_BATCH][4];
} samples;

static void put_paint(samples *out, size_t i, const cs_paint *paint) {
  cs_v4_store(out->s[i], (cs_v4){paint->s[0], paint->s[1], paint->s[2], 0});
  cs_v4_store(out->t[i], (cs_v4){paint->t[0], paint->t[1], paint->t[2], 0});
}

/* The colours that a program shows at every stop, and where its gradient is clear. */
static celspan_status fold_stops(cs_gradient_tables *tables, const cs_program *program,
                                 const celspan_texture *texture, samples *room) {
  const cs_stack *stack = tables->stack;
  const cs_paint clear = CS_PAINT_CLEAR;
  cs_arena *scratch = tables->scratch;
  cs_over_row over;
  for (size_t i = 0; i < texture->variation->stop_count; i++)
    put_paint(room, i, &texture->variation->stops[i].paint);
  put_paint(room, texture->variation->stop_count, &clear);
  CS_TRY(cs_over_row_begin(tables->context, scratch, stack, tables->isa,
                           (int32_t)texture->variation->stop_count + 1, &over));
  for (uint32_t i = 0; i < program->length; i++)
    CS_TRY(cs_over_row_layer(&over, program->items[i].layer, (const float(*)[4])room->s,
                             (const float(*)[4])room->t));
  cs_over_row_end(&over, room->rgba);
  return CELSPAN_OK;
}

/* 1 / the length from a stop to the next; 0 where both are at the same place. */
static double scale_from(const cs_stop *stop) {
  double length = stop[1].at - stop[0].at;
  return length > 0 ? 1 / length : 0;
}

static void fill_sections(const celspan_texture *texture, const samples *folded,
                          cs_gradient_table_section *sections) {
  size_t count = texture->variation->stop_count;
  const cs_stop *stops = texture->variation->stops;
  sections[0] = (cs_gradient_table_section){.colour = cs_v4_load(folded->rgba[0])};
  for (size_t i = 1; i < count; i++) {
    cs_v4 from = cs_v4_load(folded->rgba[i - 1]), to = cs_v4_load(folded->rgba[i]);
    sections[i] =
        (cs_gradient_table_section){from, to - from, stops[i - 1].at, scale_from(&stops[i - 1])};
  }
  sections[count] = (cs_gradient_table_section){.colour = cs_v4_load(folded->rgba[count - 1])};
  sections[count + 1] = (cs_gradient_table_section){.colour = cs_v4_load(folded->rgba[count])};
}

/* Counts `count` more sections. Forgets all tables if they become too many. */
static void make_way(cs_gradient_tables *tables, size_t count) {
  tables->section_count += count;
  if (tables->section_count <= SECTION_LIMIT)
    return;
  memset(tables->slots, 0, sizeof tables->slots);
  cs_arena_reset(&tables->sections);
  tables->section_count = count;
}

/* Makes the table of a program whose gradient is a layer. */
static celspan_status make(cs_gradient_tables *tables, const cs_program *program, uint32_t layer,
                           cs_set_hash name, cs_gradient_table *out) {
  const cs_shade *shade = &tables->stack->shades[tables->stack->layers[layer].index];
  size_t count = shade->texture->variation->stop_count + 2;
  make_way(tables, count);
  cs_arena_reset(tables->scratch);
  samples *room = cs_arena_take(tables->context, tables->scratch, sizeof *room);
  cs_gradient_table_section *sections =
      cs_arena_take(tables->context, &tables->sections, count * sizeof *sections);
  if (!room || !sections)
    return CELSPAN_NO_MEMORY;
  CS_TRY(fold_stops(tables, program, shade->texture, room));
  fill_sections(shade->texture, room, sections);
  *out = (cs_gradient_table){.shade = shade, .sections = sections, .name = name};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- finding it again */

static cs_set_hash name_of(const cs_stack *stack, const cs_program *program) {
  cs_set_hash name = {0};
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer_rule *rule = &stack->rules[program->items[i].layer];
    name.a ^= rule->key[0];
    name.b ^= rule->key[1];
  }
  return name;
}

celspan_status cs_gradient_table_find(cs_gradient_tables *tables, const cs_program *program,
                                      const cs_gradient_table **out) {
  *out = NULL;
  if (!tables)
    return CELSPAN_OK;
  const cs_stack *stack = tables->stack;
  cs_set_hash name = name_of(stack, program);
  cs_gradient_table *slot = &tables->slots[name.a & (SLOTS - 1)];
  if (!cs_set_hash_same(slot->name, name)) {
    uint32_t varying = find_varying(stack, program);
    if (varying != CS_STACK_NONE)
      CS_TRY(make(tables, program, varying, name, slot));
    else if (!slot->shade)
      slot->name = name; /* remembered, too; but a table is worth more */
    else
      return CELSPAN_OK;
  }
  *out = slot->shade ? slot : NULL;
  return CELSPAN_OK;
}
