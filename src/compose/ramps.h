/* Programs that are straight between some columns: gradients, procedures, soft layers, and pictures
 * enlarged so far that a texel is some pixels wide.
 */
#ifndef CS_COMPOSE_RAMPS_H
#define CS_COMPOSE_RAMPS_H

#include "compose/composer.h"

/* As cs_composer_run_program, where no picture shows pixel by pixel. */
CELSPAN_CHECKED celspan_status cs_ramps_run(cs_composer *composer, const cs_program *program,
                                            int32_t x0, int32_t x1, double y, cs_row *row);

#endif
