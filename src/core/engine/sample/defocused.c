#include "engine/sample/defocused.h"

#include <math.h>

#include "base/number.h"
#include "base/wide.h"

/* Nodes behind all others: loops over samples may read a register beyond them. */
#define BEYOND (CS_WIDE_LINE / sizeof(cs_v4))

static const cs_v4 colours = {1, 1, 1, 0};

/* ---------------------------------------------------------------- bands */

void cs_defocus_band_free(cs_defocus_band *band, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, band, nodes, rows);
  cs_node_row_free(&band->polyline, memory);
  *band = (cs_defocus_band){0};
}

size_t cs_defocus_band_bytes(const cs_defocus_band *band) {
  return CS_ARRAYS_BYTES(band, nodes, rows) + CS_ARRAYS_BYTES(&band->polyline, at, constant);
}

static const float (*band_row(const cs_defocused *defocused, const cs_defocus_band *band, int plane,
                              int32_t row))[4] {
  size_t at = (size_t)plane * (size_t)defocused->band_rows + (size_t)(row % defocused->band_rows);
  return (const float(*)[4])band->nodes + at * (size_t)defocused->columns;
}

static cs_node_row band_nodes(const cs_defocused *defocused, const cs_defocus_band *band,
                              int32_t row) {
  cs_node_row out = {.plane_count = defocused->planes,
                     .last = defocused->columns - 1,
                     .is_split = defocused->pitch_x == 1};
  for (int plane = 0; plane < defocused->planes; plane++)
    out.planes[plane] = band_row(defocused, band, plane, row);
  return out;
}

celspan_status cs_defocus_band_room(const cs_defocused *defocused, celspan_context *context,
                                    cs_defocus_band *band) {
  size_t count =
      (size_t)defocused->planes * (size_t)defocused->band_rows * (size_t)defocused->columns +
      BEYOND;
  return CS_ARRAY_FIT(context, band->nodes, count);
}

celspan_status cs_defocus_band_begin(celspan_context *context, int32_t rows,
                                     cs_defocus_band *band) {
  CS_TRY(CS_ARRAY_RESERVE(context, band->rows, (size_t)rows + 1));
  band->rows[0] = 0;
  band->row_count = 0;
  return CELSPAN_OK;
}

celspan_status cs_defocus_band_add(const cs_defocused *defocused, celspan_context *context,
                                   const cs_defocused_nodes *nodes, cs_defocus_band *band) {
  cs_node_row row = {.planes = {nodes->planes[0], nodes->planes[1]},
                     .even = nodes->even,
                     .plane_count = defocused->planes,
                     .last = defocused->columns - 1,
                     .is_split = defocused->pitch_x == 1};
  CS_TRY(cs_node_row_append(context, &row, &band->polyline));
  band->rows[++band->row_count] = band->polyline.count;
  return CELSPAN_OK;
}

celspan_status cs_defocus_band_end(const cs_defocused *defocused, celspan_context *context,
                                   cs_defocus_band *band) {
  cs_node_polyline *polyline = &band->polyline;
  CS_TRY(CS_ARRAY_FIT(context, polyline->at, polyline->count));
  return CS_ARRAY_FIT(context, polyline->values, polyline->count * (size_t)defocused->planes);
}

/* ---------------------------------------------------------------- rows */

static void drop_band(const cs_defocused *defocused, celspan_context *context,
                      cs_defocused_view *view, int i) {
  if (view->bands[i])
    defocused->release(defocused, context, view->bands[i]);
  view->bands[i] = NULL;
}

void cs_defocused_release(const cs_defocused *defocused, celspan_context *context,
                          cs_defocused_view *view) {
  drop_band(defocused, context, view, 0);
  drop_band(defocused, context, view, 1);
  cs_node_row_free(&view->own, context->memory);
  if (defocused->mix)
    defocused->forget(context, view);
  CS_ARRAYS_FREE(context->memory, view, mixed, mixed);
  *view = (cs_defocused_view){0};
}

/* Acquires a band for a view, which has room for two: one with an even and one with an odd
 * number. */
static celspan_status pin_band(const cs_defocused *defocused, celspan_context *context,
                               cs_defocused_view *view, int32_t number,
                               const cs_defocus_band **out) {
  int i = number % 2;
  if (!view->bands[i] || view->numbers[i] != number) {
    drop_band(defocused, context, view, i);
    CS_TRY(defocused->acquire(defocused, context, number, &view->bands[i]));
    view->numbers[i] = number;
  }
  *out = view->bands[i];
  return CELSPAN_OK;
}

static celspan_status make_mixed(const cs_defocused *defocused, celspan_context *context,
                                 cs_defocused_view *view) {
  if (view->mixed)
    return CELSPAN_OK;
  view->visible = (cs_defocused_range){0, defocused->columns};
  return CS_ARRAY_MAKE(context, view->mixed,
                       (size_t)defocused->columns * (size_t)defocused->planes + BEYOND);
}

static celspan_status mix_rows(const cs_defocused *defocused, celspan_context *context,
                               cs_defocused_view *view, cs_node_row *upper,
                               const cs_node_row *lower, float share) {
  size_t columns = (size_t)defocused->columns;
  CS_TRY(make_mixed(defocused, context, view));
  for (int plane = 0; plane < defocused->planes; plane++) {
    const float(*a)[4] = upper->planes[plane], (*b)[4] = lower->planes[plane];
    float(*out)[4] = view->mixed + (size_t)plane * columns;
    for (size_t i = 0; i < columns; i++) {
      cs_v4 above = cs_v4_load(a[i]);
      cs_v4_store(out[i], above + share * (cs_v4_load(b[i]) - above));
    }
    upper->planes[plane] = (const float(*)[4])out;
  }
  return CELSPAN_OK;
}

/* The vertices of a row of nodes. */
static celspan_status make_vertices(celspan_context *context, cs_defocused_view *view,
                                    cs_node_row *nodes) {
  view->own.count = 0;
  CS_TRY(cs_node_row_append(context, nodes, &view->own));
  view->at = view->own.at;
  view->values = (const float(*)[4])view->own.values;
  view->count = view->own.count;
  return CELSPAN_OK;
}

static celspan_status move_between(const cs_defocused *defocused, celspan_context *context,
                                   cs_defocused_view *view, const cs_defocus_band *upper,
                                   int32_t row, float share) {
  cs_node_row nodes = band_nodes(defocused, upper, row);
  if (share > 0) {
    const cs_defocus_band *lower;
    CS_TRY(pin_band(defocused, context, view, (row + 1) / defocused->band_rows, &lower));
    cs_node_row below = band_nodes(defocused, lower, row + 1);
    CS_TRY(mix_rows(defocused, context, view, &nodes, &below, share));
  }
  return make_vertices(context, view, &nodes);
}

static inline bool is_clear(const float node[4]) {
  return cs_v4_same(cs_v4_load(node), cs_v4_all(0));
}

static void show_pixels(cs_defocused_view *view, const cs_node_row *nodes) {
  for (int plane = 0; plane < nodes->plane_count; plane++)
    view->pixels[plane] = nodes->planes[plane];
}

/* Shows a row of pixels that a band has. */
static void show_kept(cs_defocused_view *view, const cs_node_row *nodes) {
  cs_defocused_range *visible = &view->visible;
  *visible = (cs_defocused_range){0, nodes->last + 1};
  show_pixels(view, nodes);
  while (visible->end > 0 && is_clear(nodes->planes[0][visible->end - 1]))
    visible->end--;
  while (visible->first < visible->end && is_clear(nodes->planes[0][visible->first]))
    visible->first++;
}

/* Moves to a row of bands. */
static celspan_status move_to_bands(const cs_defocused *defocused, celspan_context *context,
                                    cs_defocused_view *view, int32_t row, float share) {
  const cs_defocus_band *band;
  CS_TRY(pin_band(defocused, context, view, row / defocused->band_rows, &band));
  if (defocused->are_pixels) {
    cs_node_row nodes = band_nodes(defocused, band, row);
    show_kept(view, &nodes);
    return CELSPAN_OK;
  }
  if (band->nodes)
    return move_between(defocused, context, view, band, row, share);
  size_t first = band->rows[row % defocused->band_rows];
  view->at = band->polyline.at + first;
  view->values = (const float(*)[4])band->polyline.values + first * (size_t)defocused->planes;
  view->count = band->rows[row % defocused->band_rows + 1] - first;
  return CELSPAN_OK;
}

/* The nodes of a mixed row: all of them where they are not pixels. */
static cs_node_row mixed_nodes(const cs_defocused *defocused, const cs_defocused_view *view) {
  const float(*mixed)[4] = (const float(*)[4])view->mixed;
  return (cs_node_row){.planes = {mixed, mixed + defocused->columns},
                       .plane_count = defocused->planes,
                       .last = defocused->columns - 1};
}

/* Makes the nodes clear that are not visible but were in the row before. */
static void clear_beyond(const cs_defocused *defocused, cs_defocused_view *view,
                         cs_defocused_range before) {
  const cs_defocused_range now = view->visible;
  int32_t left = now.first < before.end ? now.first : before.end;
  int32_t right = now.end > before.first ? now.end : before.first;
  for (int plane = 0; plane < defocused->planes; plane++) {
    float(*nodes)[4] = view->mixed + (size_t)plane * (size_t)defocused->columns;
    const cs_v4 clear = plane == 0 ? cs_v4_all(0) : colours;
    for (int32_t i = before.first; i < left; i++)
      cs_v4_store(nodes[i], clear);
    for (int32_t i = right; i < before.end; i++)
      cs_v4_store(nodes[i], clear);
  }
}

/* Moves to a row that is mixed. */
static celspan_status move_to_mixed(const cs_defocused *defocused, celspan_context *context,
                                    cs_defocused_view *view, double y) {
  CS_TRY(make_mixed(defocused, context, view));
  const cs_defocused_range before = view->visible;
  view->visible = (cs_defocused_range){0, defocused->columns}; /* if mixing fails */
  CS_TRY(defocused->mix(defocused, context, view, y));
  clear_beyond(defocused, view, before);
  cs_node_row nodes = mixed_nodes(defocused, view);
  if (!defocused->are_pixels)
    return make_vertices(context, view, &nodes);
  show_pixels(view, &nodes);
  return CELSPAN_OK;
}

celspan_status cs_defocused_move(const cs_defocused *defocused, celspan_context *context,
                                 cs_defocused_view *view, double y) {
  if (view->is_placed && view->y == y)
    return CELSPAN_OK;
  double at = y / defocused->pitch_y - defocused->top;
  at = cs_number_clamp(at, 0, defocused->rows - 1);
  int32_t row = cs_number_floor(at);
  row = row > defocused->rows - 2 ? defocused->rows - 2 : row;
  view->is_placed = false;
  CS_TRY(defocused->mix ? move_to_mixed(defocused, context, view, y)
                        : move_to_bands(defocused, context, view, row, (float)(at - row)));
  view->is_placed = true;
  view->y = y;
  return CELSPAN_OK;
}

size_t cs_defocused_find(const cs_defocused_view *view, double at, size_t hint) {
  size_t low = 0, high = view->count - 1; /* at[low] <= at, at < at[high] or high is the last */
  if (hint < high && view->at[hint] <= at) {
    low = hint;
    if (hint + 1 == high || at < view->at[hint + 1])
      return hint;
    if (hint + 2 == high || at < view->at[hint + 2])
      return hint + 1;
  }
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    *(view->at[middle] <= at ? &low : &high) = middle;
  }
  return low;
}

/* The transmission of a vertex; lane 3 is 0. */
static cs_v4 vertex_through(const cs_defocused *defocused, const cs_defocused_view *view,
                            size_t vertex) {
  cs_v4 t = defocused->planes == 2
                ? cs_defocused_value(defocused, view, vertex, 1)
                : cs_v4_all(1 - cs_defocused_value(defocused, view, vertex, 0)[3]);
  t[3] = 0;
  return t;
}

/* The node of a pixel where nodes are pixels. */
static inline int32_t node_of(const cs_defocused *defocused, double x) {
  return (int32_t)cs_defocused_at(defocused, x);
}

/* The paint of a node. */
static inline cs_v4 node_through(const cs_defocused *defocused, const cs_defocused_view *view,
                                 int32_t node) {
  if (defocused->planes == 1)
    return cs_v4_all(1 - view->pixels[0][node][3]) * colours;
  return cs_v4_load(view->pixels[1][node]) * colours;
}

/* Mostly much is let through in the first pixel, and then a bound of 1 is as good. */
static cs_v4 pixels_through(const cs_defocused *defocused, const cs_defocused_view *view,
                            cs_run run) {
  int32_t node = node_of(defocused, run.x0 + 0.5), last = node_of(defocused, run.x1 - 0.5);
  cs_v4 most = node_through(defocused, view, node);
  while (node < last && cs_v4_is_between(most, cs_v4_all(-1), cs_v4_all(0.5f)))
    most = cs_v4_max(node_through(defocused, view, ++node), most);
  return node == last ? most : colours;
}

cs_v4 cs_defocused_through(const cs_defocused *defocused, const cs_defocused_view *view,
                           cs_run run) {
  if (defocused->are_pixels)
    return pixels_through(defocused, view, run);
  double last = cs_defocused_at(defocused, run.x1 - 0.5);
  size_t k = cs_defocused_find(view, cs_defocused_at(defocused, run.x0 + 0.5), 0);
  cs_v4 most = vertex_through(defocused, view, k);
  while (view->at[k] < last && k + 1 < view->count)
    most = cs_v4_max(vertex_through(defocused, view, ++k), most);
  return most;
}

/* A line of a row: its ends, and the values from its first vertex to its second. */
typedef struct row_line {
  double from, to;
  cs_v4 left[2], step[2]; /* one for each plane */
} row_line;

static inline row_line line_at(const cs_defocused *defocused, const cs_defocused_view *view,
                               size_t k) {
  row_line out = {.from = view->at[k], .to = view->at[k + 1]};
  for (int plane = 0; plane < defocused->planes; plane++) {
    out.left[plane] = cs_defocused_value(defocused, view, k, plane);
    out.step[plane] = cs_defocused_value(defocused, view, k + 1, plane) - out.left[plane];
  }
  return out;
}

/* The paints where nodes are pixels. */
static void pixel_paints(const cs_defocused *defocused, const cs_defocused_view *view,
                         const cs_defocused_places *places, float (*s)[4], float (*t)[4]) {
  for (int32_t i = 0; i < places->count; i++) {
    double x = (places->columns ? places->columns[i] : places->x0 + i) + 0.5;
    int32_t node = node_of(defocused, x);
    cs_v4_store(s[i], cs_v4_load(view->pixels[0][node]) * colours);
    cs_v4_store(t[i], node_through(defocused, view, node));
  }
}

/* The paints between vertices. */
static void line_paints(const cs_defocused *defocused, const cs_defocused_view *view,
                        const cs_defocused_places *places, float (*s)[4], float (*t)[4]) {
  size_t k = 0;
  row_line line = {.from = INFINITY};
  for (int32_t i = 0; i < places->count; i++) {
    double x = (places->columns ? places->columns[i] : places->x0 + i) + 0.5;
    double at = cs_defocused_at(defocused, x);
    if (!(at >= line.from && at < line.to)) {
      k = cs_defocused_find(view, at, k);
      line = line_at(defocused, view, k);
    }
    float share = (float)((at - line.from) / (line.to - line.from));
    cs_v4 value = line.left[0] + share * line.step[0];
    cs_v4 through =
        defocused->planes == 2 ? line.left[1] + share * line.step[1] : cs_v4_all(1 - value[3]);
    cs_v4_store(s[i], value * colours);
    cs_v4_store(t[i], through * colours);
  }
}

void cs_defocused_paints(const cs_defocused *defocused, const cs_defocused_view *view,
                         const cs_defocused_places *places, float (*s)[4], float (*t)[4]) {
  if (defocused->are_pixels)
    pixel_paints(defocused, view, places, s, t);
  else
    line_paints(defocused, view, places, s, t);
}

const float (*cs_defocused_samples(const cs_defocused *defocused, const cs_defocused_view *view,
                                   int32_t x0, int32_t count))[4] {
  int32_t first = x0 - (defocused->first_x - 1);
  if (!defocused->are_pixels || defocused->planes > 1 || first < 0 ||
      first + count > defocused->columns)
    return NULL;
  return view->pixels[0] + first;
}

size_t cs_defocused_break_limit(const cs_defocused *defocused) {
  return (size_t)defocused->columns;
}

size_t cs_defocused_breaks(const cs_defocused *defocused, const cs_defocused_view *view, cs_run run,
                           double *breaks) {
  size_t count = 0, first = cs_defocused_find(view, cs_defocused_at(defocused, run.x0), 0);
  for (size_t k = first; k < view->count; k++) {
    double x = (view->at[k] + defocused->left) * defocused->pitch_x;
    if (x >= run.x1)
      break;
    if (x > run.x0)
      breaks[count++] = x;
  }
  return count;
}
