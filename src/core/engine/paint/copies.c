/* Runs of pictures that are all copied, at whole pixels and scale 1, to codes.
 *
 *     blocks of A   |  clear  |  mixed  | opaque  |  mixed  |
 *     blocks of B   |       opaque      |(not read)|  clear |      B is behind A
 *     pieces        |    B    | A over B|    A    |  folded |
 *
 * Where one picture alone shows and is opaque, its codes go straight through. Where one lies over
 * an opaque one, they do for all groups of pixels that are clear or opaque in front, and only the
 * others are decoded, folded and coded. All other pieces are painted as everywhere (run.h).
 *
 * The pieces of a run are the same as long as its rows lie on the same blocks: they are kept, with
 * the addresses of the codes, until another block is fetched.
 *
 * Invariant: the codes are the run's colours coded, to the bit.
 */
#include "engine/paint/run.h"

#include "base/number.h"
#include "engine/paint/colours.h"
#include "engine/paint/over_bare.h"
#include "model/colour/srgb8_decode.h"

static const cs_sampler *sampler_of(const cs_painter *painter, cs_item item) {
  return &painter->images[painter->stack->layers[item.layer].index].sampler;
}

celspan_status cs_copies_fit(cs_painter *painter, const cs_program *program, bool *fit) {
  *fit = painter->stack->space != CELSPAN_SPACE_SRGB && cs_painter_are_bare(painter, program);
  for (uint32_t i = 0; i < program->length && *fit; i++) {
    const cs_image_view *view;
    uint32_t image = painter->stack->layers[program->items[i].layer].index;
    CS_TRY(cs_painter_image(painter, image, &view));
    *fit = view->sampler.placement == CS_SAMPLER_COPY;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pieces */

static cs_copies_kind kind_of(const cs_painter *painter, const cs_sampler_texels *visible,
                              uint32_t count) {
  bool ends_opaque = count > 0 && count <= 2 && visible[count - 1].opacity == CS_PICTURE_OPAQUE;
  if (ends_opaque && count == 1)
    return CS_COPIES_ONE;
  return ends_opaque && visible[0].are_coded && visible[1].are_coded &&
                 cs_srgb8_decodes(painter->isa)
             ? CS_COPIES_OVER
             : CS_COPIES_OTHER;
}

/* The piece that a run begins with. *rows: for how many rows the piece is valid, at most the given
 * number. */
static celspan_status find_piece(cs_painter *painter, const cs_program *program, cs_run run,
                                 cs_copies_piece *out, int32_t *rows) {
  cs_sampler_texels texels, visible[2] = {{0}};
  uint32_t count = 0;
  bool is_hidden = false; /* the contents of the items behind */
  for (uint32_t i = 0; i < program->length && !is_hidden; i++) {
    CS_TRY(cs_sampler_texels_at(painter->blocks, sampler_of(painter, program->items[i]), run,
                                &texels));
    run.x1 = run.x0 + texels.count;
    *rows = *rows < texels.rows ? *rows : texels.rows;
    if (texels.opacity == CS_PICTURE_CLEAR)
      continue;
    if (count < 2)
      visible[count] = texels;
    count++;
    is_hidden = texels.opacity == CS_PICTURE_OPAQUE;
  }
  *out = (cs_copies_piece){run.x1, kind_of(painter, visible, count), visible[0].codes,
                           visible[1].codes};
  return CELSPAN_OK;
}

/* Neighbours that are painted as everywhere are one piece. */
static celspan_status add_piece(celspan_context *context, cs_copies_plan *plan,
                                const cs_copies_piece *piece) {
  cs_copies_piece *last = plan->count > 0 ? &plan->pieces[plan->count - 1] : NULL;
  if (last && last->kind == CS_COPIES_OTHER && piece->kind == CS_COPIES_OTHER) {
    last->x1 = piece->x1;
    return CELSPAN_OK;
  }
  CS_TRY(CS_ARRAY_RESERVE(context, plan->pieces, plan->count + 1));
  plan->pieces[plan->count++] = *piece;
  return CELSPAN_OK;
}

static celspan_status find_pieces(cs_painter *painter, const cs_program *program, cs_run run,
                                  cs_copies_plan *plan) {
  int32_t rows = CS_PICTURE_BLOCK;
  plan->count = 0;
  plan->fetches = painter->blocks->fetches;
  for (cs_copies_piece piece; run.x0 < run.x1; run.x0 = piece.x1) {
    CS_TRY(find_piece(painter, program, run, &piece, &rows));
    CS_TRY(add_piece(painter->context, plan, &piece));
  }
  plan->end_row = plan->row + rows;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- plans */

static bool has_items(const cs_copies_plan *plan, const cs_program *program) {
  return plan->length == program->length &&
         memcmp(plan->items, program->items, plan->length * sizeof *plan->items) == 0;
}

static celspan_status set_key(celspan_context *context, const cs_program *program, cs_run run,
                              cs_copies_plan *plan) {
  plan->end_row = 0; /* invalid if a later step fails */
  CS_TRY(CS_ARRAY_RESERVE(context, plan->items, program->length));
  memcpy(plan->items, program->items, program->length * sizeof *plan->items);
  plan->length = program->length;
  plan->x0 = run.x0;
  plan->x1 = run.x1;
  plan->row = cs_number_floor(run.y);
  return CELSPAN_OK;
}

celspan_status cs_copies_find(cs_painter *painter, const cs_program *program, cs_run run,
                              const cs_copies_plan **out) {
  uint32_t place = (uint32_t)run.x0 * 0x9e3779b1u >> 16;
  cs_copies_plan *plan = &painter->copies[place % CS_PAINTER_COPIES];
  int32_t row = cs_number_floor(run.y);
  *out = plan;
  if (plan->x0 == run.x0 && plan->x1 == run.x1 && row >= plan->row && row < plan->end_row &&
      plan->fetches == painter->blocks->fetches && has_items(plan, program))
    return CELSPAN_OK;
  CS_TRY(set_key(painter->context, program, run, plan));
  CS_TRY(find_pieces(painter, program, run, plan));
  if (plan->fetches == painter->blocks->fetches)
    return CELSPAN_OK;
  /* A block may have made room for another. The second search fetches nothing, unless the cache
   * cannot keep all these blocks at once. */
  CS_TRY(find_pieces(painter, program, run, plan));
  if (plan->fetches == painter->blocks->fetches)
    return CELSPAN_OK;
  plan->count = 1;
  plan->pieces[0] = (cs_copies_piece){.x1 = run.x1, .kind = CS_COPIES_OTHER};
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- codes */

/* The row below is fetched into the cache now, so that it is there in time. */
static void copy_codes(const unsigned char *from, size_t count, unsigned char *out) {
  memcpy(out, from, 4 * count);
  for (size_t ahead = 0; ahead < 4 * count; ahead += 64)
    __builtin_prefetch(from + 4 * CS_PICTURE_CODES_ROW + ahead);
}

celspan_status cs_copies_put(cs_painter *painter, const cs_copies_plan *plan, size_t count,
                             cs_run run, cs_row *row) {
  const size_t down = 4 * CS_PICTURE_CODES_ROW * (size_t)(cs_number_floor(run.y) - plan->row);
  unsigned char *codes;
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(cs_row_codes(painter->context, row, run.x0, plan->pieces[count - 1].x1, &codes));
  for (const cs_copies_piece *p = plan->pieces; p < plan->pieces + count; p++) {
    int32_t pixels = p->x1 - run.x0;
    if (p->kind == CS_COPIES_ONE)
      copy_codes(p->front + down, (size_t)pixels, codes);
    else {
      painter->evaluations += (uint64_t)pixels;
      CS_WIDE_CHOOSE(painter->isa, cs_over_bare_mix_copies)
      (painter->blocks->curve, p->front + down, p->rear + down, pixels, codes);
    }
    codes += 4 * (size_t)pixels;
    run.x0 = p->x1;
  }
  return CELSPAN_OK;
}
