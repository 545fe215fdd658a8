#include "sweep/cull.h"

void cs_cull_free(cs_cull *cull, cs_memory *memory) {
  size_t rows = (size_t)cull->tile_rows + 1;
  cs_mem_free(memory, cull->deferred_list, cull->deferred_count * sizeof *cull->deferred_list);
  cs_mem_free(memory, cull->deferred_starts, rows * sizeof *cull->deferred_starts);
  cs_mem_free(memory, cull->enters, cull->enter_count * sizeof *cull->enters);
  cs_mem_free(memory, cull->enter_starts, rows * sizeof *cull->enter_starts);
  cs_mem_free(memory, cull->kept, cull->kept_count * sizeof *cull->kept);
  cs_mem_free(memory, cull->places, cull->chain_count * sizeof *cull->places);
  cs_mem_free(memory, cull->first_rows, cull->chain_count * sizeof *cull->first_rows);
  *cull = (cs_cull){0};
}
