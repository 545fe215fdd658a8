/* Filtered rows of a scan: the traces of the rows under a row's kernel, kept in a ring so that
 * going down each row is swept once, and summed by the kernel. */
#include "base/number.h"
#include "filter/scan.h"

celspan_status cs_traces_init(cs_scan *scan) {
  const cs_kernel *kernel = scan->shot->kernel;
  size_t count = 2 * (size_t)cs_kernel_reach(kernel) + 1;
  scan->traces = cs_mem_array(scan->context->memory, count, sizeof *scan->traces);
  scan->under = cs_mem_array(scan->context->memory, count, sizeof *scan->under);
  scan->trace_count = count;
  if (!scan->traces || !scan->under)
    return cs_fail_memory(scan->context);
  return cs_convolve_init(&scan->convolve, scan->context, kernel, scan->shot->width);
}

void cs_traces_finish(cs_scan *scan) {
  cs_memory *memory = scan->context->memory;
  for (size_t i = 0; scan->traces && i < scan->trace_count; i++)
    cs_trace_finish(&scan->traces[i], memory);
  cs_mem_free(memory, scan->traces, scan->trace_count * sizeof *scan->traces);
  cs_mem_free(memory, scan->under, scan->trace_count * sizeof *scan->under);
  if (scan->shot->kernel)
    cs_convolve_finish(&scan->convolve, memory);
}

static cs_trace *find_trace(cs_scan *scan, int32_t row) {
  int32_t count = (int32_t)scan->trace_count, place = row % count;
  return &scan->traces[place < 0 ? place + count : place];
}

celspan_status cs_traces_row(cs_scan *scan, int32_t y, cs_row *out) {
  double radius = scan->shot->kernel->radius_y + 0.5 * scan->shot->kernel->spread;
  int32_t first = cs_number_floor(y + 0.5 - radius), end = cs_number_ceil(y + 0.5 + radius);
  for (int32_t row = first; row < end; row++) {
    cs_trace *trace = find_trace(scan, row);
    if (!trace->is_sealed || trace->row != row)
      CS_TRY(cs_scan_trace(scan, row, trace));
    scan->under[row - first] = trace;
  }
  return cs_convolve_row(&scan->convolve, &scan->composer, scan->under, (size_t)(end - first), y,
                         out);
}
