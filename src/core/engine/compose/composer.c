#include "engine/compose/composer.h"

/* Number of cells that are remembered: a power of two, because two share a place. At least one for
 * each layer, up to MEMO_FEW. A row of more layers may have more cells than that, and most of its
 * cells are known from the row above, so there is one for each layer, up to MEMO_MOST. */
#define MEMO_EACH 64
#define MEMO_FEW 4096
#define MEMO_MOST 16384
#define ITEM_LIMIT ((size_t)1 << 15) /* program items kept from row to row */

/* ---------------------------------------------------------------- life */

bool cs_composer_is_flat(const cs_stack *stack) {
  for (size_t i = 0; i < stack->layer_count; i++)
    if (stack->layers[i].kind != CS_LAYER_FLAT)
      return false;
  for (size_t i = 0; i < stack->light_count; i++)
    if (stack->lights[i].below > 0)
      return false;
  return stack->group_count == 0;
}

/* Makes a fast fold for very many flat layers, if it suits them. */
static celspan_status make_table(cs_composer *composer) {
  composer->is_flat = cs_composer_is_flat(composer->stack);
  if (!composer->is_flat || !cs_over_table_suits(composer->stack))
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_MAKE(composer->context, composer->table, 1));
  return cs_over_table_init(composer->table, composer->context, composer->stack);
}

/* Few layers have few sets, and to clear the memory for many sets would take longer than a band of
 * rows. */
static size_t memo_size(const cs_stack *stack) {
  size_t size = MEMO_EACH;
  while (size < MEMO_FEW && size / MEMO_EACH < stack->layer_count)
    size *= 2;
  while (size >= MEMO_FEW && size < MEMO_MOST && size < stack->layer_count)
    size *= 2;
  return size;
}

celspan_status cs_composer_init(cs_composer *composer, celspan_context *context,
                                const cs_stack *stack, cs_image_opacity opacity) {
  *composer = (cs_composer){.context = context, .stack = stack, .opacity = opacity};
  size_t words = cs_stack_words(stack), filled = cs_set_filled_count(words);
  CS_TRY(CS_ARRAY_MAKE(context, composer->set, words));
  CS_TRY(CS_ARRAY_MAKE(context, composer->contributing, words));
  CS_TRY(CS_ARRAY_MAKE(context, composer->filled, filled));
  CS_TRY(CS_ARRAY_MAKE(context, composer->presences, stack->layer_count));
  for (size_t layer = 0; layer < stack->layer_count; layer++)
    composer->presences[layer].rule = stack->rules[layer];
  if (stack->procedure_count > 0)
    CS_TRY(CS_ARRAY_MAKE(context, composer->procedure_span_of, stack->layer_count));
  CS_TRY(CS_ARRAY_MAKE(context, composer->results, stack->step_depth));
  CS_TRY(CS_ARRAY_MAKE(context, composer->outers, cs_stack_depth(stack)));
  CS_TRY(make_table(composer));
  return CS_ARRAY_MAKE(context, composer->memo, memo_size(stack));
}

void cs_composer_finish(cs_composer *composer) {
  if (!composer->stack)
    return;
  cs_memory *memory = composer->context->memory;
  if (composer->table)
    cs_over_table_finish(composer->table);
  CS_ARRAYS_FREE(memory, composer, set, procedure_spans);
  *composer = (cs_composer){0};
}

bool cs_composer_begin_row(cs_composer *composer) {
  composer->failure = CELSPAN_OK;
  composer->procedure_span_count = 0;
  if (composer->item_count <= ITEM_LIMIT)
    return false;
  composer->item_count = 0;
  memset(composer->memo, 0, composer->memo_room.capacity * sizeof(cs_memo));
  return true;
}

void cs_composer_restart(cs_composer *composer) {
  size_t count = composer->stack->layer_count, words = cs_stack_words(composer->stack);
  for (size_t layer = 0; layer < count; layer++)
    composer->presences[layer].winding = 0;
  if (count > 0) {
    memset(composer->set, 0, words * sizeof *composer->set);
    memset(composer->filled, 0, cs_set_filled_count(words) * sizeof *composer->filled);
  }
  composer->hash = (cs_set_hash){0};
}

/* ---------------------------------------------------------------- gathering */

static celspan_status gather_item(cs_composer *composer, uint32_t layer) {
  CS_TRY(CS_ARRAY_RESERVE(composer->context, composer->gathered, composer->gathered_count + 1));
  uint32_t procedure_span = composer->stack->layers[layer].kind == CS_LAYER_SCANLINE
                                ? composer->procedure_span_of[layer]
                                : 0;
  composer->gathered[composer->gathered_count++] = (cs_item){layer, procedure_span};
  return CELSPAN_OK;
}

/* The most that a varying layer transmits. A picture whose header cannot be read counts as clear
 * until it is really seen, because only then is it an error. */
static cs_v4 most_through(cs_composer *composer, const cs_layer *layer) {
  const cs_image_opacity *opacity = &composer->opacity;
  if (layer->kind != CS_LAYER_PICTURE || layer->role != CS_LAYER_PAINT ||
      !opacity->is_opaque(opacity->painter, layer->index))
    return layer->t;
  return cs_v4_all(1 - layer->fade);
}

/* Adds the front lights of a group, and of the groups around it that are not entered yet, outermost
 * first. The fold has left all groups that do not contain this group. The recursion is at most
 * CS_STACK_GROUPS deep. */
static celspan_status gather_front(cs_composer *composer, cs_over *over, uint32_t group) {
  if (group == over->group)
    return CELSPAN_OK;
  const cs_group *entered = &composer->stack->groups[group];
  CS_TRY(gather_front(composer, over, cs_stack_around(composer->stack, group, over->group)));
  if (!entered->has_light)
    return CELSPAN_OK;
  cs_over_move(over, entered->light, group);
  return gather_item(composer, entered->light);
}

/* Adds one layer to a program, and to the fold. A layer that varies is folded with its greatest
 * transmission, so that the program ends too late rather than too early. The light of the fold then
 * has no meaning. */
static celspan_status gather_layer(cs_composer *composer, cs_over *over, uint32_t index) {
  const cs_layer *layer = &composer->stack->layers[index];
  if (composer->stack->has_group_light)
    CS_TRY(
        gather_front(composer, over, cs_stack_entered(composer->stack, layer->group, over->group)));
  cs_over_move(over, index, layer->group);
  CS_TRY(gather_item(composer, index));
  over->t *= layer->kind == CS_LAYER_FLAT ? layer->t : most_through(composer, layer);
  return CELSPAN_OK;
}

/* Gathers the contributing layers from the front until nothing shines through. The member `filled`
 * belongs to the set of present layers. It can also be used for `set`, because trees only remove
 * layers. */
static celspan_status gather(cs_composer *composer, const uint64_t *set) {
  cs_over over;
  cs_over_begin(&over, composer->stack, composer->outers);
  over.is_bound = true;
  composer->gathered_count = 0;
  for (uint32_t layer, end = (uint32_t)composer->stack->layer_count;
       (layer = cs_set_below(set, composer->filled, end)) != CS_STACK_NONE;) {
    if (cs_over_reaches(&over, layer))
      CS_TRY(gather_layer(composer, &over, layer));
    end = cs_over_is_opaque(over.t) ? cs_over_hidden_end(&over) : layer;
  }
  return CELSPAN_OK;
}

static inline bool group_varies(const cs_stack *stack, uint32_t group) {
  return group != CS_STACK_NONE && stack->groups[group].varies;
}

/* Folds the contributing layers in the same way, if all of them are flat. Returns false if one
 * layer is not flat. */
static bool fold_flats(const cs_composer *composer, const uint64_t *set, cs_over *over) {
  const cs_layer *layers = composer->stack->layers;
  cs_over_begin(over, composer->stack, composer->outers);
  for (uint32_t layer, end = (uint32_t)composer->stack->layer_count;
       (layer = cs_set_below(set, composer->filled, end)) != CS_STACK_NONE;) {
    if (cs_over_reaches(over, layer)) {
      if (layers[layer].kind != CS_LAYER_FLAT || group_varies(composer->stack, layers[layer].group))
        return false;
      cs_over_move(over, layer, layers[layer].group);
      cs_over_add(over, layers[layer].s, layers[layer].t);
    }
    end = cs_over_is_opaque(over->t) ? cs_over_hidden_end(over) : layer;
  }
  return true;
}

static celspan_status keep_program(cs_composer *composer, cs_cell *cell) {
  size_t count = composer->gathered_count, needed = composer->item_count + count;
  if (needed < ITEM_LIMIT) /* at once for all items that are kept from row to row */
    needed = ITEM_LIMIT;
  CS_TRY(CS_ARRAY_RESERVE(composer->context, composer->items, needed));
  memcpy(composer->items + composer->item_count, composer->gathered, count * sizeof(cs_item));
  cell->program = (uint32_t)composer->item_count;
  cell->length = (uint32_t)count;
  composer->item_count += count;
  return CELSPAN_OK;
}

/* The layers that are present and contribute. A boolean without operands is a tree without layers:
 * there is nothing to copy then, and nowhere to copy it. */
static const uint64_t *resolve(cs_composer *composer) {
  if (composer->stack->tree_count == 0 || composer->stack->layer_count == 0)
    return composer->set;
  memcpy(composer->contributing, composer->set,
         cs_stack_words(composer->stack) * sizeof *composer->set);
  cs_tree_resolve(composer->stack, composer->contributing, composer->results);
  return composer->contributing;
}

/* The same with partial folds that were made earlier. */
static celspan_status fold_prepared(cs_composer *composer, const uint64_t *set, cs_over *over) {
  cs_over_pair light;
  CS_TRY(cs_over_table_light(composer->table, set, &light));
  cs_over_begin(over, composer->stack, composer->outers);
  over->e = light.e;
  over->t = light.t;
  return CELSPAN_OK;
}

/* Folds the contributing layers as long as they are flat. */
static celspan_status fold(cs_composer *composer, const uint64_t *set, cs_over *over,
                           bool *is_flat) {
  *is_flat = true;
  if (composer->table)
    return fold_prepared(composer, set, over);
  *is_flat = fold_flats(composer, set, over);
  return CELSPAN_OK;
}

static celspan_status compose(cs_composer *composer, cs_cell *cell) {
  cs_over over;
  bool is_flat;
  composer->evaluations++;
  const uint64_t *set = resolve(composer);
  CS_TRY(fold(composer, set, &over, &is_flat));
  if (is_flat) {
    cell->colour = cs_over_end(&over);
    return CELSPAN_OK;
  }
  CS_TRY(gather(composer, set));
  return keep_program(composer, cell);
}

/* ---------------------------------------------------------------- cells */

void cs_composer_cross_span(cs_composer *composer, uint32_t layer, uint32_t procedure_span,
                            int32_t direction) {
  /* Every row numbers its procedure spans from 0, and a program refers to a span by its number. So
   * a remembered cell of an earlier row remains correct: it is read with the spans of this row. */
  const cs_layer_rule *rule = &composer->stack->rules[layer];
  uint64_t name = (procedure_span + 1) * (uint64_t)0x9e3779b97f4a7c15u;
  composer->set[layer / 64] ^= (uint64_t)1 << (layer % 64);
  composer->filled[layer / 64] = composer->set[layer / 64] != 0;
  composer->hash.a ^= rule->key[0] * (name | 1);
  composer->hash.b ^= rule->key[1] ^ name;
  if (direction > 0)
    composer->procedure_span_of[layer] = procedure_span;
}

/* Composes the cell at the place of the walk. */
static celspan_status compose_here(cs_composer *composer, cs_cell *out) {
  *out = (cs_cell){.colour = cs_v4_all(0), .hash = composer->hash};
  celspan_status status = compose(composer, out);
  if (status != CELSPAN_OK && composer->failure == CELSPAN_OK)
    composer->failure = status;
  return status;
}

void cs_composer_cell(cs_composer *composer, cs_cell *out) {
  if (composer->table) {
    /* Nearly every set is new, and its colour is computed as quickly as it would be found among the
     * remembered cells. */
    compose_here(composer, out);
    return;
  }
  cs_memo *pair = &composer->memo[composer->hash.a & (composer->memo_room.capacity - 2)];
  for (int i = 0; i < 2; i++)
    if (pair[i].is_used && cs_set_hash_same(pair[i].cell.hash, composer->hash)) {
      *out = pair[i].cell;
      return;
    }
  celspan_status status = compose_here(composer, out);
  pair[1] = pair[0];
  pair[0] = (cs_memo){*out, status == CELSPAN_OK};
}

celspan_status cs_composer_through(cs_composer *composer, cs_v4 *out) {
  cs_over over;
  bool is_flat;
  CS_TRY(fold(composer, resolve(composer), &over, &is_flat));
  const cs_v4 colour = cs_over_end(&over);
  *out = over.t;
  (*out)[3] = 1 - colour[3];
  return CELSPAN_OK;
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
