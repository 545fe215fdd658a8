#include "busy/kind.h"

#include "base/number.h"

/* Following a chain through a row costs the sweep little, beginning and ending it much; without an
 * order it is the other way round. Rows are busy where chains are followed through fewer rows than
 * this on the average. */
#define ROWS_A_CHAIN 100

static size_t word_count(const cs_kind *kind) { return (kind->count + 63) / 64; }

void cs_kind_free(cs_kind *kind, cs_memory *memory) {
  cs_mem_free(memory, kind->busy, kind->busy ? word_count(kind) * sizeof *kind->busy : 0);
  *kind = (cs_kind){0};
}

/* What the chains of a part of the rows do there. */
typedef struct census {
  double crossed; /* rows, by all chains together */
  double begun;   /* chains */
} census;

static size_t part_of(double y, size_t count) {
  double part = y / CS_KIND_ROWS;
  return part <= 0 ? 0 : part >= (double)count ? count - 1 : (size_t)part;
}

static void count_chain(census *parts, size_t count, const cs_boundary_chain *chain) {
  size_t first = part_of(chain->y0, count), last = part_of(chain->y1, count);
  parts[first].begun++;
  for (size_t part = first; part <= last; part++) {
    double top = (double)part * CS_KIND_ROWS, foot = top + CS_KIND_ROWS;
    double above = chain->y0 > top ? chain->y0 : top, below = chain->y1 < foot ? chain->y1 : foot;
    if (below > above)
      parts[part].crossed += below - above;
  }
}

celspan_status cs_kind_find(celspan_context *context, const cs_boundary_set *set, int32_t height,
                            cs_kind *out) {
  cs_kind kind = {.count = ((size_t)height + CS_KIND_ROWS - 1) / CS_KIND_ROWS};
  census *parts = cs_mem_array(context->memory, kind.count, sizeof *parts);
  kind.busy = cs_mem_array(context->memory, word_count(&kind), sizeof *kind.busy);
  if (!parts || !kind.busy) {
    cs_mem_free(context->memory, parts, kind.count * sizeof *parts);
    cs_kind_free(&kind, context->memory);
    return cs_fail_memory(context);
  }
  for (size_t i = 0; i < set->chain_count; i++)
    count_chain(parts, kind.count, &set->chains[i]);
  for (size_t part = 0; part < kind.count; part++)
    if (parts[part].crossed <= ROWS_A_CHAIN * parts[part].begun)
      kind.busy[part / 64] |= (uint64_t)1 << (part % 64);
  cs_mem_free(context->memory, parts, kind.count * sizeof *parts);
  *out = kind;
  return CELSPAN_OK;
}

bool cs_kind_are_busy(const cs_kind *kind) {
  for (size_t part = 0; part < kind->count; part++)
    if (!(kind->busy[part / 64] >> (part % 64) & 1))
      return false;
  return kind->count > 0;
}
