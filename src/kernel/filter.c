/* Filtered rows of a scan: the traces of the rows under a row's kernel, kept in a ring so that
 * going down each row is swept once, and summed by the kernel. */
#include "base/number.h"
#include "row/row.h"

celspan_status cs_filter_init(cs_row_maker *maker) {
  const cs_kernel *kernel = maker->plan->kernel;
  size_t count = 2 * (size_t)cs_kernel_reach(kernel) + 1;
  maker->retained_rows = cs_mem_array(maker->context->memory, count, sizeof *maker->retained_rows);
  maker->under = cs_mem_array(maker->context->memory, count, sizeof *maker->under);
  maker->retained_count = count;
  if (!maker->retained_rows || !maker->under)
    return cs_fail_memory(maker->context);
  return cs_convolve_init(&maker->convolve, maker->context, kernel, maker->plan->width);
}

void cs_filter_finish(cs_row_maker *maker) {
  cs_memory *memory = maker->context->memory;
  for (size_t i = 0; maker->retained_rows && i < maker->retained_count; i++)
    cs_retained_finish(&maker->retained_rows[i], memory);
  cs_mem_free(memory, maker->retained_rows, maker->retained_count * sizeof *maker->retained_rows);
  cs_mem_free(memory, maker->under, maker->retained_count * sizeof *maker->under);
  if (maker->plan->kernel)
    cs_convolve_finish(&maker->convolve, memory);
}

static cs_retained_row *find_trace(cs_row_maker *maker, int32_t row) {
  int32_t count = (int32_t)maker->retained_count, place = row % count;
  return &maker->retained_rows[place < 0 ? place + count : place];
}

celspan_status cs_filter_row(cs_row_maker *maker, int32_t y, cs_row *out) {
  double radius = maker->plan->kernel->radius_y + 0.5 * maker->plan->kernel->spread;
  int32_t first = cs_number_floor(y + 0.5 - radius), end = cs_number_ceil(y + 0.5 + radius);
  for (int32_t row = first; row < end; row++) {
    cs_retained_row *retained = find_trace(maker, row);
    if (!retained->is_sealed || retained->row != row)
      CS_TRY(cs_row_retain(maker, row, retained));
    maker->under[row - first] = retained;
  }
  return cs_convolve_row(&maker->convolve, &maker->painter, maker->under, (size_t)(end - first), y,
                         out);
}
