#include "engine/row/plan.h"

void cs_plan_finish(cs_plan *plan, cs_memory *memory) {
  cs_stack_finish(&plan->stack, memory);
  cs_boundary_finish(&plan->boundaries, memory);
  cs_cull_free(&plan->cull, memory);
  cs_kernel_free(plan->kernel, memory);
  cs_mem_free(memory, plan->shown, plan->shown_capacity * sizeof *plan->shown);
  cs_mem_free(memory, plan->defocus, plan->defocus_capacity * sizeof(struct cs_defocus *));
}
