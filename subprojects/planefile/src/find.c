#include "pack.h"

/* ---------------------------------------------------------------- order */

static int compare_chains(const void *first, const void *second) {
  const pf_shown *a = first, *b = second;
  int by_place = pf_order(a->place, b->place);
  return by_place ? by_place : pf_order(a->borders->chain, b->borders->chain);
}

static int compare_changes(const void *first, const void *second) {
  const pf_change *a = first, *b = second;
  int by_height = pf_order(a->height, b->height);
  return by_height ? by_height : pf_order(a->chain, b->chain);
}

/* ---------------------------------------------------------------- chains */

static const planefile_point *last_of(const pf_packer *p, uint32_t piece) {
  const planefile_piece *of = &p->plane->pieces[piece];
  return &p->plane->points[of->point + of->degree];
}

/* Whether a piece has a part of the heights of one of a chain's borders; *from: that border, or one
 * before it. */
static bool is_needed(const pf_packer *p, const pf_shown *c, uint32_t piece, uint32_t *from) {
  int32_t top = pf_pack_first(p, piece)->y, foot = last_of(p, piece)->y;
  while (*from < c->count && c->borders[*from].foot <= top)
    ++*from;
  return *from < c->count && c->borders[*from].top < foot && top < foot;
}

/* Whether a piece has a part of the heights of the band, or of those outside the frame. */
static bool is_near(const pf_packer *p, uint32_t piece) {
  return (p->foot == PLANEFILE_SIDE || pf_pack_first(p, piece)->y < p->foot) &&
         (p->top == 0 || last_of(p, piece)->y >= p->top);
}

/* Finds which pieces of a chain are kept. */
static void trim(const pf_packer *p, pf_shown *c) {
  const planefile_chain *chain = &p->plane->chains[c->borders->chain];
  uint32_t end = chain->piece + chain->piece_count, border = 0;
  c->piece = c->end = end;
  for (uint32_t i = chain->piece; i < end; i++)
    if (c->is_whole ? is_near(p, i) : is_needed(p, c, i, &border)) {
      c->piece = c->piece < i ? c->piece : i;
      c->end = i + 1;
    }
  const planefile_point *first = pf_pack_first(p, c->piece), *last = last_of(p, c->end - 1);
  c->top = first->y > p->top ? first->y : p->top;
  c->foot = last->y < p->foot ? last->y : p->foot;
  c->place = (int64_t)first->x + last->x;
  c->start = *first;
  c->end_at = *last;
}

const planefile_point *pf_pack_pass(const pf_packer *p, const pf_shown *c, uint32_t *piece,
                                    uint32_t *border) {
  const planefile_point *end = NULL;
  for (; !c->is_whole && !is_needed(p, c, *piece, border); ++*piece)
    end = last_of(p, *piece);
  return end;
}

uint32_t pf_pack_count(const pf_packer *p, const pf_shown *c) {
  uint32_t count = 0, border = 0;
  for (uint32_t i = c->piece; i < c->end; count++)
    i += pf_pack_pass(p, c, &i, &border) == NULL;
  return count;
}

/* Finds what a chain has in common with one of the base, to which all of its pieces count. */
static bool link_chain(pf_packer *p, pf_shown *c) {
  c->is_whole = true;
  trim(p, c);
  if (p->part->is_whole)
    return true;
  if (!pf_match_chain(&p->match, c->piece, c->end, &p->latest, &c->link))
    return false;
  if (c->link.origin != PF_NEW) {
    p->latest = c->link;
    return true;
  }
  c->is_whole = false;
  trim(p, c);
  return pf_pack_count(p, c) < c->end - c->piece ||
         pf_match_bent(&p->match, c->piece, c->end, &p->latest, &c->link);
}

/* Clips the borders to the band and finds its chains. */
static bool find_chains(pf_packer *p, const planefile_border *borders, size_t count) {
  p->borders = pf_make(p->memory, sizeof *p->borders, count);
  p->chains = pf_make(p->memory, sizeof *p->chains, count);
  p->border_count = count;
  if (!p->borders || !p->chains)
    return false;
  for (size_t i = 0; i < count; i++) {
    planefile_border *b = &p->borders[i];
    *b = borders[i];
    b->top = b->top > p->top ? b->top : p->top;
    b->foot = b->foot < p->foot ? b->foot : p->foot;
  }
  qsort(p->borders, count, sizeof *p->borders, pf_border_compare);
  for (size_t i = 0; i < count; i++) {
    if (i == 0 || p->borders[i].chain != p->borders[i - 1].chain)
      p->chains[p->chain_count++] = (pf_shown){.borders = &p->borders[i]};
    p->chains[p->chain_count - 1].count++;
  }
  for (size_t i = 0; i < p->chain_count; i++)
    if (!p->part->is_whole && !p->part->base)
      trim(p, &p->chains[i]);
    else if (!link_chain(p, &p->chains[i]))
      return false;
  qsort(p->chains, p->chain_count, sizeof *p->chains, compare_chains);
  return true;
}

static bool is_moved(const pf_link *link) {
  return link->origin == PF_MOVED || link->origin == PF_KEPT;
}

/* Notes which cells are where those of a chain of the base are. */
static bool note_cells(pf_packer *p, const pf_shown *c) {
  const pf_base *base = p->part->base;
  const planefile_band heights = {.top = p->top, .foot = p->foot};
  planefile_border moved;
  bool is_done = true;
  for (uint32_t i = base->first[c->link.chain], k = 0; i < base->first[c->link.chain + 1]; i++) {
    if (!pf_move_border(&base->band->borders[i], c->link.move.y, p->part->grid.rows, &heights,
                        &moved))
      continue;
    while (k < c->count && c->borders[k].foot <= moved.top)
      k++;
    for (; k < c->count && c->borders[k].top < moved.foot; k++)
      is_done = is_done && pf_match_note(&p->match, moved.left, c->borders[k].left) &&
                pf_match_note(&p->match, moved.right, c->borders[k].right);
    k -= k > 0 && c->borders[k - 1].foot > moved.foot;
  }
  return is_done;
}

static bool match_cells(pf_packer *p) {
  for (size_t i = 0; i < p->chain_count; i++)
    if (is_moved(&p->chains[i].link) && !note_cells(p, &p->chains[i]))
      return false;
  return pf_match_cells(&p->match);
}

/* Whether a chain's borders are those of the base, moved. */
static bool keeps_borders(const pf_packer *p, const pf_shown *c) {
  const pf_base *base = p->part->base;
  const planefile_band heights = {.top = p->top, .foot = p->foot};
  planefile_border moved;
  uint32_t k = 0;
  for (uint32_t i = base->first[c->link.chain]; i < base->first[c->link.chain + 1]; i++) {
    if (!pf_move_border(&base->band->borders[i], c->link.move.y, p->part->grid.rows, &heights,
                        &moved))
      continue;
    const planefile_border *b = &c->borders[k];
    if (k++ == c->count || b->top != moved.top || b->foot != moved.foot ||
        p->match.cells[b->left] != moved.left || p->match.cells[b->right] != moved.right)
      return false;
  }
  return k == c->count;
}

/* ---------------------------------------------------------------- changes */

static bool add_change(pf_packer *p, int32_t height, size_t chain, pf_sides sides) {
  pf_change *changes =
      pf_grow(p->memory, p->changes, sizeof *changes, &p->change_capacity, p->change_count + 1);
  if (!changes)
    return false;
  p->changes = changes;
  p->changes[p->change_count++] = (pf_change){height, (uint32_t)chain, sides};
  return true;
}

/* Finds the slope of a chain, of which the changes from one on are. */
static void find_slope(const pf_packer *p, pf_shown *c, size_t first) {
  enum { MOST = 32 };
  pf_beside list[MOST];
  size_t count = 0;
  pf_sides before = c->sides;
  for (size_t i = first; i < p->change_count && count < MOST; before = p->changes[i++].sides) {
    pf_sides after = p->changes[i].sides;
    list[count++] = (pf_beside){{pf_pack_flat(p, before.left), pf_pack_flat(p, before.right)},
                                {pf_pack_flat(p, after.left), pf_pack_flat(p, after.right)},
                                0};
  }
  c->slope = pf_slope_find(list, count);
}

/* Finds what a chain begins with, and all that happens to it. */
static bool find_changes(pf_packer *p, size_t index) {
  pf_shown *c = &p->chains[index];
  size_t first = p->change_count;
  int32_t height = c->top;
  c->sides = (pf_sides){0, 0};
  if (c->link.origin == PF_MOVED && keeps_borders(p, c))
    c->link.origin = PF_KEPT;
  if (c->link.origin == PF_KEPT)
    return true;
  for (uint32_t i = 0; i < c->count; i++) {
    const planefile_border *b = &c->borders[i];
    pf_sides sides = {b->left, b->right};
    if (b->top > height && i > 0 &&
        !add_change(p, height, index, (pf_sides){c->borders[i - 1].left, c->borders[i - 1].left}))
      return false;
    if (b->top == c->top)
      c->sides = sides;
    else if (!add_change(p, b->top, index, sides))
      return false;
    height = b->foot;
  }
  const planefile_border *last = &c->borders[c->count - 1];
  if (height < c->foot && !add_change(p, height, index, (pf_sides){last->left, last->left}))
    return false;
  find_slope(p, c, first);
  return true;
}

bool pf_pack_find(pf_packer *p) {
  if (!find_chains(p, p->part->borders, p->part->count) || (p->part->base && !match_cells(p)))
    return false;
  for (size_t i = 0; i < p->chain_count; i++)
    if (!find_changes(p, i))
      return false;
  if (p->change_count > 0)
    qsort(p->changes, p->change_count, sizeof *p->changes, compare_changes);
  return true;
}
