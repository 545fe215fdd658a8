/* A row, a composer and the edges of a row with values that gdb prints (spec/gdb_spec.lua). It is
 * never run. */
#include "engine/area/area.h"
#include "engine/compose/composer.h"
#include "engine/span/row.h"

static const float pixels[8] = {0.25f, 0.5f, 0.75f, 1};
static celspan_span spans[] = {
    {0, 3, CELSPAN_SPAN_SINGLE, 0, {0.5f, 0, 0, 1}, {0}, NULL, NULL},
    {3, 7, CELSPAN_SPAN_GRADIENT, 3, {0, 0.5f, 0, 1}, {0, 0.125f, 0, 0}, NULL, NULL},
    {7, 9, CELSPAN_SPAN_ARRAY, 7, {0}, {0}, pixels, NULL},
};
cs_row row = {.spans = spans, .count = 3, .varied = {1, 1}};

static uint64_t set[2] = {(uint64_t)1 << 63 | 0x12, 1};
static const cs_stack stack = {.layer_count = 70};
cs_composer composer = {.stack = &stack, .set = set};

static double x[] = {2.75, 9}, x_next[] = {2.5, 9.5};
static float shares[] = {0.375f, 0.75f};
static int32_t first[] = {2, 9}, end[] = {3, 10};
static cs_crossing crossings[] = {{.layer = 0}, {.layer = 4}};
static cs_cell cells[] = {{.length = 0}, {.colour = {0.5f, 0, 0, 1}}, {.length = 2}};
static cs_active active = {.x = x, .x_next = x_next, .crossing = crossings, .count = 2};
static cs_cells known = {.cells = cells, .known = 3};
cs_area area = {.tools = {.active = &active, .cells = &known},
                .edges = {.one = shares, .first = first, .end = end}};

int main(void) { return 0; }
