#include "compose/composer.h"

#define MEMO_SIZE 4096               /* cells remembered, two of one place; a power of two */
#define ITEM_LIMIT ((size_t)1 << 15) /* program items kept from row to row */

/* ---------------------------------------------------------------- life */

static celspan_status take(cs_composer *composer, void *field, size_t count, size_t size) {
  void *items = cs_mem_array(composer->context->memory, count, size);
  if (!items && count > 0)
    return cs_fail_memory(composer->context);
  memcpy(field, &items, sizeof items);
  return CELSPAN_OK;
}

static size_t filled_count(const cs_stack *stack) { return (cs_stack_words(stack) + 7) / 8 * 8; }

celspan_status cs_composer_init(cs_composer *composer, celspan_context *context,
                                const cs_stack *stack, cs_image_opacity opacity) {
  *composer = (cs_composer){.context = context, .stack = stack, .opacity = opacity};
  size_t words = cs_stack_words(stack);
  CS_TRY(take(composer, &composer->set, words, sizeof(uint64_t)));
  CS_TRY(take(composer, &composer->contributing, words, sizeof(uint64_t)));
  CS_TRY(take(composer, &composer->filled, filled_count(stack), sizeof(uint8_t)));
  CS_TRY(take(composer, &composer->presences, stack->layer_count, sizeof(cs_presence)));
  for (size_t layer = 0; layer < stack->layer_count; layer++)
    composer->presences[layer].rule = stack->rules[layer];
  if (stack->procedure_count > 0)
    CS_TRY(take(composer, &composer->procedure_span_of, stack->layer_count, sizeof(uint32_t)));
  CS_TRY(take(composer, &composer->results, stack->step_depth, sizeof(cs_tree_result)));
  CS_TRY(take(composer, &composer->folds, cs_over_table_suits(stack), sizeof(cs_over_table)));
  if (composer->folds)
    CS_TRY(cs_over_table_init(composer->folds, context, stack));
  return take(composer, &composer->memo, MEMO_SIZE, sizeof(cs_memo));
}

void cs_composer_finish(cs_composer *composer) {
  if (!composer->stack)
    return;
  cs_memory *memory = composer->context->memory;
  const cs_stack *stack = composer->stack;
  size_t words = cs_stack_words(stack);
  cs_mem_free(memory, composer->set, words * sizeof(uint64_t));
  cs_mem_free(memory, composer->contributing, words * sizeof(uint64_t));
  cs_mem_free(memory, composer->filled, filled_count(stack) * sizeof(uint8_t));
  cs_mem_free(memory, composer->presences, stack->layer_count * sizeof(cs_presence));
  cs_mem_free(memory, composer->procedure_span_of, stack->layer_count * sizeof(uint32_t));
  cs_mem_free(memory, composer->results, stack->step_depth * sizeof(cs_tree_result));
  if (composer->folds)
    cs_over_table_finish(composer->folds);
  cs_mem_free(memory, composer->folds, sizeof(cs_over_table));
  cs_mem_free(memory, composer->memo, MEMO_SIZE * sizeof(cs_memo));
  cs_mem_free(memory, composer->items, composer->item_capacity * sizeof(cs_item));
  cs_mem_free(memory, composer->gathered, composer->gathered_capacity * sizeof(cs_item));
  cs_mem_free(memory, composer->procedure_spans,
              composer->procedure_span_capacity * sizeof(cs_procedure_span));
  *composer = (cs_composer){0};
}

bool cs_composer_begin_row(cs_composer *composer) {
  composer->failure = CELSPAN_OK;
  composer->procedure_span_count = 0;
  if (composer->item_count <= ITEM_LIMIT)
    return false;
  composer->item_count = 0;
  memset(composer->memo, 0, MEMO_SIZE * sizeof(cs_memo));
  return true;
}

void cs_composer_restart(cs_composer *composer) {
  const cs_stack *stack = composer->stack;
  for (size_t layer = 0; layer < stack->layer_count; layer++)
    composer->presences[layer].winding = 0;
  if (stack->layer_count > 0) {
    memset(composer->set, 0, cs_stack_words(stack) * sizeof *composer->set);
    memset(composer->filled, 0, filled_count(stack) * sizeof *composer->filled);
  }
  composer->hash = (cs_set_hash){0};
}

/* ---------------------------------------------------------------- the fold */

/* Light gathered so far (e) and what still shines through (t), inside one faded group. */
typedef struct level {
  cs_v4 e, t;
} level;

typedef struct fold {
  const cs_stack *stack;
  cs_v4 e, t;
  float keep;     /* what the mattes of back lights leave of transparency */
  uint32_t group; /* where the fold stands */
  size_t light;   /* the next back light to be met */
  uint32_t depth;
  level outer[CS_SCENE_DEPTH + 2];
} fold;

static void fold_begin(fold *f, const cs_stack *stack) {
  f->stack = stack;
  f->e = cs_v4_all(0);
  f->t = cs_v4_all(1);
  f->keep = 1;
  f->group = CS_STACK_NONE;
  f->light = 0;
  f->depth = 0;
}

static void fold_leave_group(fold *f) {
  const cs_group *group = &f->stack->groups[f->group];
  const level *outer = &f->outer[--f->depth];
  f->e = outer->e + outer->t * (group->fade * f->e);
  f->t = outer->t * ((1 - group->fade) + group->fade * f->t);
  f->group = group->parent;
}

static void fold_enter_group(fold *f, uint32_t group) {
  const cs_group *inner = &f->stack->groups[group];
  if (inner->parent != f->group)
    fold_enter_group(f, inner->parent); /* at most CS_SCENE_DEPTH + 1 levels */
  f->outer[f->depth++] = (level){f->e, f->t};
  f->e = cs_v4_all(0);
  f->t = cs_v4_all(1);
  f->group = group;
}

static void fold_light(fold *f) {
  const cs_back_light *light = &f->stack->lights[f->light++];
  f->e += f->t * light->light;
  f->keep *= light->keep;
}

/* Moves the fold back to just before `leaf`: leaves groups, meets back lights, enters groups. */
static inline void fold_reach(fold *f, uint32_t layer, uint32_t group) {
  while (f->group != CS_STACK_NONE && layer < f->stack->groups[f->group].first)
    fold_leave_group(f);
  while (f->light < f->stack->light_count && layer < f->stack->lights[f->light].below)
    fold_light(f);
  if (group != f->group)
    fold_enter_group(f, group);
}

static inline void fold_paint(fold *f, cs_v4 s, cs_v4 t) {
  f->e += f->t * s;
  f->t *= t;
}

/* Lane 3 of t is 0 once something has been painted. */
static inline bool fold_is_opaque(const fold *f) {
  return !cs_v4_any_above(f->t, cs_v4_all(CS_PAINT_OPAQUE));
}

/* Premultiplied RGBA; alpha is the mean of the three mattes. */
static cs_v4 fold_end(fold *f) {
  while (f->group != CS_STACK_NONE)
    fold_leave_group(f);
  while (f->light < f->stack->light_count)
    fold_light(f);
  cs_v4 rgba = f->e;
  rgba[3] = 1 - f->keep * cs_stack_mean(f->t);
  return rgba;
}

/* ---------------------------------------------------------------- gathering */

static celspan_status gather_item(cs_composer *composer, uint32_t layer) {
  CS_TRY(cs_mem_reserve(composer->context, (void **)&composer->gathered,
                        &composer->gathered_capacity, composer->gathered_count + 1,
                        sizeof(cs_item)));
  uint32_t procedure_span = composer->stack->layers[layer].kind == CS_LAYER_SCANLINE
                                ? composer->procedure_span_of[layer]
                                : 0;
  composer->gathered[composer->gathered_count++] = (cs_item){layer, procedure_span};
  return CELSPAN_OK;
}

/* A picture whose header cannot be read counts as clear until it is really seen: only then is it an
 * error. */
static bool layer_is_opaque(cs_composer *composer, const cs_layer *layer) {
  const cs_image_opacity *opacity = &composer->opacity;
  if (layer->kind != CS_LAYER_PICTURE)
    return layer->is_opaque;
  return opacity->is_opaque(opacity->painter, layer->detail) && layer->fade == 1;
}

/* Takes one leaf into a cell that varies: folds it when it is flat, notes it in any case. A leaf
 * that varies and is not opaque counts as clear, so the stop comes late, never early. */
static celspan_status gather_layer(cs_composer *composer, fold *f, uint32_t index) {
  const cs_layer *layer = &composer->stack->layers[index];
  fold_reach(f, index, layer->group);
  CS_TRY(gather_item(composer, index));
  if (layer->kind == CS_LAYER_FLAT) {
    fold_paint(f, layer->s, layer->t);
    return CELSPAN_OK;
  }
  if (layer_is_opaque(composer, layer))
    f->t = cs_v4_all(0);
  return CELSPAN_OK;
}

/* The highest leaf of the set below `end`, or CS_STACK_NONE. */
static inline uint32_t layer_below(const cs_composer *composer, const uint64_t *set, uint32_t end) {
  if (end == 0)
    return CS_STACK_NONE;
  uint32_t word = (end - 1) / 64;
  uint64_t bits = set[word] & (~(uint64_t)0 >> (63 - (end - 1) % 64));
  while (bits == 0) {
    if (word == 0)
      return CS_STACK_NONE;
    word = word % 8 == 0 ? cs_over_table_skip(composer->filled, word) : word;
    bits = word > 0 ? set[--word] : 0;
  }
  return word * 64 + 63 - (uint32_t)__builtin_clzll(bits);
}

/* Where the walk goes on when nothing shines through any more: behind the group, which hides the
 * rest of itself, or nowhere. */
static inline uint32_t end_behind(const fold *f) {
  return f->group == CS_STACK_NONE ? 0 : f->stack->groups[f->group].first;
}

/* Walks the contributing leaves from the front until nothing shines through. */
static celspan_status gather(cs_composer *composer, const uint64_t *set) {
  fold f;
  fold_begin(&f, composer->stack);
  composer->gathered_count = 0;
  for (uint32_t layer, end = (uint32_t)composer->stack->layer_count;
       (layer = layer_below(composer, set, end)) != CS_STACK_NONE;) {
    CS_TRY(gather_layer(composer, &f, layer));
    end = fold_is_opaque(&f) ? end_behind(&f) : layer;
  }
  return CELSPAN_OK;
}

/* The same while all leaves are flat; false where one is not. */
static bool fold_flats(const cs_composer *composer, const uint64_t *set, fold *f) {
  const cs_layer *layers = composer->stack->layers;
  fold_begin(f, composer->stack);
  for (uint32_t layer, end = (uint32_t)composer->stack->layer_count;
       (layer = layer_below(composer, set, end)) != CS_STACK_NONE;) {
    if (layers[layer].kind != CS_LAYER_FLAT)
      return false;
    fold_reach(f, layer, layers[layer].group);
    fold_paint(f, layers[layer].s, layers[layer].t);
    end = fold_is_opaque(f) ? end_behind(f) : layer;
  }
  return true;
}

static celspan_status keep_program(cs_composer *composer, cs_cell *cell) {
  size_t count = composer->gathered_count, needed = composer->item_count + count;
  if (needed < ITEM_LIMIT) /* all that is kept from row to row, at once */
    needed = ITEM_LIMIT;
  CS_TRY(cs_mem_reserve(composer->context, (void **)&composer->items, &composer->item_capacity,
                        needed, sizeof(cs_item)));
  memcpy(composer->items + composer->item_count, composer->gathered, count * sizeof(cs_item));
  cell->program = (uint32_t)composer->item_count;
  cell->length = (uint32_t)count;
  composer->item_count += count;
  return CELSPAN_OK;
}

/* What contributes of the leaves present. */
static const uint64_t *resolve(cs_composer *composer) {
  if (composer->stack->tree_count == 0)
    return composer->set;
  memcpy(composer->contributing, composer->set,
         cs_stack_words(composer->stack) * sizeof *composer->set);
  cs_tree_resolve(composer->stack, composer->contributing, composer->results);
  return composer->contributing;
}

static celspan_status compose(cs_composer *composer, cs_cell *cell) {
  fold f;
  composer->evaluations++;
  const uint64_t *set = resolve(composer);
  if (composer->folds) {
    cs_over_pair light;
    CS_TRY(cs_over_table_light(composer->folds, set, composer->filled, &light));
    fold_begin(&f, composer->stack);
    f.e = light.e;
    f.t = light.t;
  }
  if (composer->folds || fold_flats(composer, set, &f)) {
    cell->colour = fold_end(&f);
    return CELSPAN_OK;
  }
  CS_TRY(gather(composer, set));
  return keep_program(composer, cell);
}

/* ---------------------------------------------------------------- cells */

void cs_composer_cross_span(cs_composer *composer, uint32_t layer, uint32_t procedure_span,
                            int32_t direction) {
  /* Rows number their strips alike, and a program names a strip by its number: what the memo holds
   * of an earlier row is the same program, read with this row's strips. */
  const cs_layer_rule *rule = &composer->stack->rules[layer];
  uint64_t name = (procedure_span + 1) * (uint64_t)0x9e3779b97f4a7c15u;
  composer->set[layer / 64] ^= (uint64_t)1 << (layer % 64);
  composer->filled[layer / 64] = composer->set[layer / 64] != 0;
  composer->hash.a ^= rule->key[0] * (name | 1);
  composer->hash.b ^= rule->key[1] ^ name;
  if (direction > 0)
    composer->procedure_span_of[layer] = procedure_span;
}

void cs_composer_cell(cs_composer *composer, cs_cell *out) {
  cs_memo *pair = &composer->memo[composer->hash.a & (MEMO_SIZE - 2)];
  for (int i = 0; i < 2; i++)
    if (pair[i].is_used && cs_set_hash_same(pair[i].cell.hash, composer->hash)) {
      *out = pair[i].cell;
      return;
    }
  cs_cell cell = {.colour = cs_v4_all(0), .hash = composer->hash};
  celspan_status status = compose(composer, &cell);
  if (status != CELSPAN_OK && composer->failure == CELSPAN_OK)
    composer->failure = status;
  pair[1] = pair[0];
  pair[0] = (cs_memo){cell, status == CELSPAN_OK};
  *out = cell;
}

bool cs_composer_same(const cs_composer *composer, const cs_cell *a, const cs_cell *b) {
  if (a->length != b->length)
    return false;
  if (a->length == 0)
    return cs_v4_same(a->colour, b->colour);
  return memcmp(&composer->items[a->program], &composer->items[b->program],
                a->length * sizeof(cs_item)) == 0;
}

cs_program cs_composer_program(const cs_composer *composer, const cs_cell *cell) {
  return (cs_program){&composer->items[cell->program], composer->procedure_spans, cell->length};
}
