#include "kernel/filter.h"

#include "base/number.h"

celspan_status cs_filter_init(cs_filter *filter, const cs_kernel *kernel, cs_painter *painter,
                              int32_t width, cs_filter_retain *retain, void *user) {
  celspan_context *context = painter->context;
  size_t count = 2 * (size_t)cs_kernel_extent(kernel) + 1;
  *filter = (cs_filter){
      .kernel = kernel, .painter = painter, .retain = retain, .user = user, .row_count = count};
  filter->rows = cs_mem_array(context->memory, count, sizeof *filter->rows);
  filter->under = cs_mem_array(context->memory, count, sizeof *filter->under);
  if (!filter->rows || !filter->under)
    return cs_fail_memory(context);
  return cs_convolve_init(&filter->convolve, context, kernel, width);
}

void cs_filter_finish(cs_filter *filter, cs_memory *memory) {
  for (size_t i = 0; filter->rows && i < filter->row_count; i++)
    cs_retained_finish(&filter->rows[i], memory);
  cs_mem_free(memory, filter->rows, filter->row_count * sizeof *filter->rows);
  cs_mem_free(memory, filter->under, filter->row_count * sizeof *filter->under);
  cs_convolve_finish(&filter->convolve, memory);
  *filter = (cs_filter){0};
}

static cs_retained_row *place_of(cs_filter *filter, int32_t y) {
  int32_t count = (int32_t)filter->row_count, place = y % count;
  return &filter->rows[place < 0 ? place + count : place];
}

celspan_status cs_filter_row(cs_filter *filter, int32_t y, cs_row *out) {
  double radius = filter->kernel->radius_y + 0.5 * filter->kernel->spread;
  int32_t first = cs_number_floor(y + 0.5 - radius), end = cs_number_ceil(y + 0.5 + radius);
  for (int32_t row = first; row < end; row++) {
    cs_retained_row *retained = place_of(filter, row);
    if (!retained->is_sealed || retained->row != row)
      CS_TRY(filter->retain(filter->user, row, retained));
    filter->under[row - first] = retained;
  }
  return cs_convolve_row(&filter->convolve, filter->painter, filter->under, (size_t)(end - first),
                         y, out);
}
