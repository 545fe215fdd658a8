#include "engine/row/plan.h"

void cs_plan_finish(cs_plan *plan, cs_memory *memory) {
  cs_stack_finish(&plan->stack, memory);
  cs_boundary_finish(&plan->boundaries, memory);
  cs_cull_free(&plan->cull, memory);
  cs_kernel_free(plan->kernel, memory);
  CS_ARRAYS_FREE(memory, plan, defocus, shown);
}
