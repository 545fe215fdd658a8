#include "engine/paint/gradient_table.h"

#define SLOTS 1024          /* tables remembered; a power of two */
#define SECTION_LIMIT 16384 /* sections and layers of all tables together */
#define SECTION_LEAST 3     /* pixels for which it pays to look whether they lie in one section */

struct cs_gradient_tables {
  celspan_context *context;
  const cs_stack *stack;
  cs_isa isa;
  cs_arena *scratch;              /* borrowed */
  cs_gradient_table slots[SLOTS]; /* a slot without a shade and a name is empty */
  cs_arena sections;              /* and layers: of all tables */
  size_t section_count;
  cs_arena lasting;                     /* of the tints */
  const cs_gradient_table_tint **tints; /* by shade; NULL: not yet */
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
  cs_arena_init(&tables->lasting);
  *out = tables;
  return CS_MAKE(context, tables->tints, stack->shade_count);
}

void cs_gradient_tables_destroy(cs_gradient_tables *tables, cs_memory *memory) {
  if (!tables)
    return;
  cs_arena_finish(&tables->sections, memory);
  cs_arena_finish(&tables->lasting, memory);
  cs_mem_free(memory, tables->tints, tables->stack->shade_count * sizeof *tables->tints);
  cs_mem_free(memory, tables, sizeof *tables);
}

/* ---------------------------------------------------------------- colours */

/* Puts a gradient, and the flat layers in front of it, over the layers behind them. */
static inline cs_over_pair fold_point(const cs_gradient_table_layer *layer,
                                      const cs_gradient_table_tint *tint, double at,
                                      cs_over_pair behind) {
  float share = cs_gradient_table_share(tint->at, tint->scale, at);
  cs_v4 through = tint->t + tint->step_t * share;
  return (cs_over_pair){layer->e +
                            layer->t * ((tint->s + tint->step_s * share) + through * behind.e),
                        layer->t * (through * behind.t)};
}

/* The same for pixels that lie in one section of a linear gradient, as most pixels do. */
static void fold_section(const cs_gradient_table_layer *layer, const cs_batch *batch,
                         size_t section, cs_over_pair *restrict pixels) {
  const cs_gradient_table_tint *tint = &layer->tints[section];
  const double *p = layer->shade->plane[0], base = p[1] * batch->y + p[2];
  cs_v4 e = layer->e, t = layer->t, s0 = tint->s, s1 = tint->step_s, t0 = tint->t,
        t1 = tint->step_t;
  double step = p[0], begin = tint->at, scale = tint->scale;
  for (int32_t k = 0; k < batch->count; k++) {
    double at = step * cs_batch_centre(batch, k) + base;
    float share = cs_gradient_table_share(begin, scale, at);
    cs_v4 through = t0 + t1 * share;
    pixels[k].e = e + t * ((s0 + s1 * share) + through * pixels[k].e);
    pixels[k].t = t * (through * pixels[k].t);
  }
}

static void fold_layer(const cs_gradient_table_layer *layer, const cs_batch *batch,
                       cs_over_pair *pixels) {
  const cs_shade *shade = layer->shade;
  if (batch->count >= SECTION_LEAST) {
    double first = cs_batch_centre(batch, 0), last = cs_batch_centre(batch, batch->count - 1);
    if (cs_gradient_table_is_one_section(shade, first, last, batch->y)) {
      double at = cs_shade_at(shade, first, batch->y);
      fold_section(layer, batch, cs_gradient_table_section_at(shade, at), pixels);
      return;
    }
  }
  for (int32_t k = 0; k < batch->count; k++) {
    double at = cs_shade_at(shade, cs_batch_centre(batch, k), batch->y);
    const cs_gradient_table_tint *tint = &layer->tints[cs_gradient_table_section_at(shade, at)];
    pixels[k] = fold_point(layer, tint, at, pixels[k]);
  }
}

static void fold_several(const cs_gradient_table *table, const cs_batch *batch, float (*rgba)[4]) {
  cs_over_pair pixels[CS_OVER_ROW_BATCH];
  for (int32_t k = 0; k < batch->count; k++)
    pixels[k] = (cs_over_pair){table->e, table->t};
  for (size_t i = table->layer_count; i-- > 0;)
    fold_layer(&table->layers[i], batch, pixels);
  for (int32_t k = 0; k < batch->count; k++) {
    pixels[k].e[3] = 1 - table->keep * cs_over_mean(pixels[k].t);
    cs_v4_store(rgba[k], pixels[k].e);
  }
}

void cs_gradient_table_colours(const cs_gradient_table *table, const cs_batch *batch,
                               float (*rgba)[4]) {
  if (table->layer_count > 0) {
    fold_several(table, batch, rgba);
    return;
  }
  for (int32_t first = 0, k = 0; k < batch->count; first = k) {
    double x[CS_SHADE_PLACES], at[CS_SHADE_PLACES];
    for (; k < batch->count && k - first < CS_SHADE_PLACES; k++)
      x[k - first] = cs_batch_centre(batch, k);
    cs_shade_find(table->shade, x, k - first, batch->y, at);
    for (int32_t i = 0; i < k - first; i++) {
      size_t section = cs_gradient_table_section_at(table->shade, at[i]);
      cs_v4_store(rgba[first + i], cs_gradient_table_mix(&table->sections[section], at[i]));
    }
  }
}

/* ---------------------------------------------------------------- which programs */

/* How many gradients with stops a program has; 0 where it has other layers that vary, or too many
 * stops. *first: the layer of the first gradient. */
static size_t count_varying(const cs_stack *stack, const cs_program *program, uint32_t *first) {
  size_t count = 0;
  bool has_group = false, has_noise = false;
  if (cs_program_curves(stack, program))
    return 0;
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    has_group |= layer->group != CS_STACK_NONE;
    if (layer->kind == CS_LAYER_FLAT)
      continue;
    const celspan_texture *texture =
        layer->kind == CS_LAYER_SHADED ? stack->shades[layer->index].texture : NULL;
    if (!texture || texture->kind == CS_TEXTURE_TRIANGLE ||
        texture->variation->stop_count >= CS_OVER_ROW_BATCH)
      return 0;
    has_noise |= texture->kind == CS_TEXTURE_NOISE;
    if (count++ == 0)
      *first = program->items[i].layer;
  }
  return count > 1 && (has_group || has_noise) ? 0 : count;
}

/* ---------------------------------------------------------------- one gradient */

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

/* Memory for sections or layers of one program. */
static void *allocate(cs_gradient_tables *tables, size_t count, size_t size) {
  return cs_arena_take(tables->context, &tables->sections, count * size);
}

static celspan_status make_one(cs_gradient_tables *tables, const cs_program *program,
                               cs_gradient_table *out) {
  const celspan_texture *texture = out->shade->texture;
  samples *room = cs_arena_take(tables->context, tables->scratch, sizeof *room);
  cs_gradient_table_section *sections =
      allocate(tables, texture->variation->stop_count + 2, sizeof *sections);
  if (!room || !sections)
    return CELSPAN_NO_MEMORY;
  CS_TRY(fold_stops(tables, program, texture, room));
  fill_sections(texture, room, sections);
  out->sections = sections;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- several */

static cs_gradient_table_tint tint_of(const cs_layer *layer, const cs_paint *paint) {
  cs_v4 s = {paint->s[0], paint->s[1], paint->s[2], 0};
  cs_v4 t = {paint->t[0], paint->t[1], paint->t[2], 0};
  if (layer->role == CS_LAYER_BACK)
    t = cs_v4_all(1);
  cs_over_pair lit = cs_over_lit(layer->front, layer->fade, s, t);
  return (cs_gradient_table_tint){.s = lit.e, .t = lit.t};
}

static void fill_tints(const cs_layer *layer, const celspan_texture *texture,
                       cs_gradient_table_tint *tints) {
  size_t count = texture->variation->stop_count;
  const cs_paint clear = CS_PAINT_CLEAR;
  tints[0] = tint_of(layer, &texture->variation->stops[0].paint);
  for (size_t i = 1; i < count; i++) {
    cs_gradient_table_tint to = tint_of(layer, &texture->variation->stops[i].paint);
    tints[i] = tint_of(layer, &texture->variation->stops[i - 1].paint);
    tints[i].step_s = to.s - tints[i].s;
    tints[i].step_t = to.t - tints[i].t;
    tints[i].at = texture->variation->stops[i - 1].at;
    tints[i].scale = scale_from(&texture->variation->stops[i - 1]);
  }
  tints[count] = tint_of(layer, &texture->variation->stops[count - 1].paint);
  tints[count + 1] = tint_of(layer, &clear);
}

/* The tints of a layer, which are the same in every program. Errors: NO_MEMORY. */
static celspan_status find_tints(cs_gradient_tables *tables, const cs_layer *layer,
                                 const cs_gradient_table_tint **out) {
  const celspan_texture *texture = tables->stack->shades[layer->index].texture;
  const cs_gradient_table_tint **kept = &tables->tints[layer->index];
  if (!*kept) {
    cs_gradient_table_tint *tints = cs_arena_take(
        tables->context, &tables->lasting, (texture->variation->stop_count + 2) * sizeof *tints);
    if (!tints)
      return CELSPAN_NO_MEMORY;
    fill_tints(layer, texture, tints);
    *kept = tints;
  }
  *out = *kept;
  return CELSPAN_OK;
}

/* Moves the result of the fold so far into the layer of the next gradient, and begins a new fold
 * behind it. `over` keeps its lights. */
static celspan_status add_layer(cs_gradient_tables *tables, const cs_layer *layer, cs_over *over,
                                cs_gradient_table_layer *out) {
  out->e = over->e;
  out->t = over->t;
  out->shade = &tables->stack->shades[layer->index];
  over->e = cs_v4_all(0);
  over->t = cs_v4_all(1);
  return find_tints(tables, layer, &out->tints);
}

/* No layer is in a group. */
static celspan_status make_several(cs_gradient_tables *tables, const cs_program *program,
                                   size_t layer_count, cs_gradient_table *out) {
  const cs_stack *stack = tables->stack;
  cs_gradient_table_layer *layers = allocate(tables, layer_count, sizeof *layers);
  cs_over over;
  if (!layers)
    return CELSPAN_NO_MEMORY;
  cs_over_begin(&over, stack, NULL);
  for (uint32_t i = 0; i < program->length; i++) {
    const cs_layer *layer = &stack->layers[program->items[i].layer];
    cs_over_move(&over, program->items[i].layer, CS_STACK_NONE);
    if (layer->kind == CS_LAYER_FLAT)
      cs_over_add(&over, layer->s, layer->t);
    else
      CS_TRY(add_layer(tables, layer, &over, &layers[out->layer_count++]));
  }
  cs_over_end(&over);
  out->layers = layers;
  out->keep = over.keep;
  out->e = over.e;
  out->t = over.t;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- making a table */

/* Counts `count` more sections and tints. Forgets all tables if they become too many. */
static void make_way(cs_gradient_tables *tables, size_t count) {
  tables->section_count += count;
  if (tables->section_count <= SECTION_LIMIT)
    return;
  memset(tables->slots, 0, sizeof tables->slots);
  cs_arena_reset(&tables->sections);
  tables->section_count = count;
}

/* Makes the table of a program with `count` gradients, the first of which is layer `first`. */
static celspan_status make(cs_gradient_tables *tables, const cs_program *program, uint32_t first,
                           size_t count, cs_set_hash name, cs_gradient_table *out) {
  const cs_stack *stack = tables->stack;
  cs_gradient_table made = {.shade = &stack->shades[stack->layers[first].index], .name = name};
  make_way(tables, count == 1 ? made.shade->texture->variation->stop_count + 2 : count);
  cs_arena_reset(tables->scratch);
  CS_TRY(count == 1 ? make_one(tables, program, &made)
                    : make_several(tables, program, count, &made));
  *out = made;
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
    uint32_t first = CS_STACK_NONE;
    size_t count = count_varying(stack, program, &first);
    if (count > 0)
      CS_TRY(make(tables, program, first, count, name, slot));
    else if (!slot->shade)
      slot->name = name; /* remembered, too; but a table is worth more */
    else
      return CELSPAN_OK;
  }
  *out = slot->shade ? slot : NULL;
  return CELSPAN_OK;
}
