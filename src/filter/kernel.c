#include "filter/kernel.h"

#include "base/number.h"

celspan_status cs_kernel_create(celspan_context *context, const cs_antialias *antialias,
                                cs_kernel **out) {
  cs_kernel *kernel = cs_mem_array(context->memory, 1, sizeof *kernel);
  if (!kernel)
    return cs_fail_memory(context);
  kernel->radius_x = kernel->radius_y = antialias->radius;
  kernel->rows = antialias->rows;
  double sum = 0, running = 0;
  for (int i = 0; i < CS_ANTIALIAS_SAMPLES; i++)
    sum += antialias->samples[i];
  for (int i = 0; i < CS_ANTIALIAS_SAMPLES; i++) {
    kernel->is_signed |= antialias->samples[i] / sum < 0;
    running += antialias->samples[i];
    kernel->first[i + 1] = running / sum; /* ends on 1: the same sum, in the same order */
    kernel->second[i + 1] = kernel->second[i] + (kernel->first[i] + kernel->first[i + 1]) /
                                                    CS_ANTIALIAS_SAMPLES;
  }
  *out = kernel;
  return CELSPAN_OK;
}

void cs_kernel_free(cs_kernel *kernel, cs_memory *memory) {
  cs_mem_free(memory, kernel, sizeof *kernel);
}

int32_t cs_kernel_reach(const cs_kernel *kernel) {
  double radius = kernel->radius_x > kernel->radius_y ? kernel->radius_x : kernel->radius_y;
  return cs_number_ceil(radius + 0.5);
}
