/* Plain pieces have a separate path into boundaries and bounds, which must give the same bits as
 * the general one. The two are compared on random paths: a matrix multiplied by 2 is the same map,
 * but the weights are then 2, so that no piece is plain; and a factor of 2 changes no rounding.
 */
#include "model/geometry/boundary_build.h"
#include "model/geometry/matrix.h"
#include "model/geometry/plain.h"
#include "tests/support/check.h"
#include "tests/support/random.h"

#define CASES 20000
#define PIECES 12

static celspan_context *context;

/* Points on the grid may lie on its sides. */
static const cs_boundary_frame frame = {0, 300, 0, 200};

/* ---------------------------------------------------------------- random paths */

/* Points on a grid give level lines, vertical lines and curves whose points coincide; those far
 * away give pieces that are cut at the sides of the frame, at its top and at its bottom. */
static cs_hpoint next_point(test_random *random, double size, bool has_grid) {
  celspan_point at = random_point(random, 150 - size, 150 + size, 100 - size, 100 + size);
  if (has_grid)
    at = (celspan_point){20 * floor(at.x / 20), 20 * floor(at.y / 20)};
  return (cs_hpoint){at.x, at.y, 1};
}

static void make_path(test_random *random, cs_outline *outline) {
  static const double sizes[4] = {60, 95, 400, 9000};
  double size = sizes[random_below(random, 4)];
  bool has_grid = random_below(random, 3) == 0;
  int count = 1 + random_below(random, PIECES);
  cs_outline_init(outline);
  CHECK(cs_outline_move(context, outline, next_point(random, size, has_grid)) == CELSPAN_OK);
  for (int i = 0; i < count; i++) {
    cs_hpoint points[CS_PLAIN_DEGREE];
    int degree = 1 + random_below(random, CS_PLAIN_DEGREE);
    for (int k = 0; k < degree; k++)
      points[k] = next_point(random, size, has_grid);
    CHECK(cs_outline_piece(context, outline, degree, points) == CELSPAN_OK);
  }
  CHECK(cs_outline_close(context, outline) == CELSPAN_OK);
}

static celspan_matrix make_matrix(test_random *random) {
  if (random_below(random, 3) == 0)
    return celspan_matrix_identity();
  double angle = random_between(random, -3, 3), skew = random_between(random, -1, 1);
  celspan_point scale = random_point(random, -1.5, 1.5, 0.2, 1.5), middle = {150, 100};
  celspan_matrix turn = celspan_matrix_rotation(angle, middle);
  celspan_matrix stretch = celspan_matrix_scaling_about(scale.x, scale.y, middle);
  return celspan_matrix_then(
      celspan_matrix_then(turn, celspan_matrix_skewing_about(skew, 0, middle)), stretch);
}

static celspan_matrix twice(celspan_matrix matrix) {
  for (int i = 0; i < 9; i++)
    matrix.m[i] *= 2;
  return matrix;
}

/* ---------------------------------------------------------------- boundaries */

static cs_boundary_set build(const cs_outline *outline, const celspan_matrix *matrix) {
  cs_boundary_set set;
  cs_boundary_builder builder;
  cs_boundary_init(&set);
  cs_boundary_builder_init(&builder, context, &set, &frame);
  CHECK(cs_boundary_add(&builder, outline, matrix, 7) == CELSPAN_OK);
  cs_boundary_builder_finish(&builder);
  return set;
}

static bool same_chain(const cs_boundary_chain *a, const cs_boundary_chain *b) {
  return a->y0 == b->y0 && a->y1 == b->y1 && a->x0 == b->x0 && a->piece == b->piece &&
         a->piece_count == b->piece_count && a->layer == b->layer && a->direction == b->direction;
}

static bool same_piece(const cs_boundary_piece *a, const cs_boundary_piece *b) {
  bool same_place = a->x0 == b->x0 && a->y0 == b->y0 && a->x1 == b->x1 && a->y1 == b->y1 &&
                    a->left == b->left && a->right == b->right;
  bool same_chords = a->chords == b->chords && a->group == b->group && a->half == b->half &&
                     a->leap == b->leap && a->degree == b->degree;
  return same_place && same_chords &&
         (a->degree == 1 || (a->sag == b->sag && a->step == b->step && a->point == b->point &&
                             a->is_power == b->is_power));
}

static bool same_point(const cs_hpoint *a, const cs_hpoint *b) {
  return a->x == b->x && a->y == b->y && a->w == b->w;
}

static bool same_set(const cs_boundary_set *a, const cs_boundary_set *b) {
  bool same = a->chain_count == b->chain_count && a->piece_count == b->piece_count &&
              a->point_count == b->point_count;
  for (size_t i = 0; same && i < a->chain_count; i++)
    same = same_chain(&a->chains[i], &b->chains[i]);
  for (size_t i = 0; same && i < a->piece_count; i++)
    same = same_piece(&a->pieces[i], &b->pieces[i]);
  for (size_t i = 0; same && i < a->point_count; i++)
    same = same_point(&a->points[i], &b->points[i]);
  return same;
}

static void both_ways_give_the_same_chains(void) {
  size_t chains = 0, curves = 0;
  for (int seed = 1; seed <= CASES; seed++) {
    test_random random = {(uint64_t)seed};
    cs_outline outline;
    make_path(&random, &outline);
    celspan_matrix matrix = make_matrix(&random), doubled = twice(matrix);
    CHECK(cs_plain_applies(&outline, &matrix) && !cs_plain_applies(&outline, &doubled));
    cs_boundary_set plain = build(&outline, &matrix), general = build(&outline, &doubled);
    if (!CHECK(same_set(&plain, &general)))
      fprintf(stderr, "  case %d\n", seed);
    chains += plain.chain_count;
    curves += plain.point_count;
    cs_boundary_finish(&plain, context->memory);
    cs_boundary_finish(&general, context->memory);
    cs_outline_finish(&outline, context->memory);
  }
  CHECK(chains > CASES && curves > CASES);
}

/* ---------------------------------------------------------------- bounds */

static bool same_box(const celspan_box *a, const celspan_box *b) {
  return a->x == b->x && a->y == b->y && a->width == b->width && a->height == b->height;
}

static void both_ways_give_the_same_bounds(void) {
  for (int seed = 1; seed <= CASES; seed++) {
    test_random random = {(uint64_t)seed};
    cs_outline outline;
    make_path(&random, &outline);
    celspan_matrix matrix = make_matrix(&random), doubled = twice(matrix);
    celspan_box plain, general;
    bool is_found = cs_outline_bounds(&outline, &matrix, &plain);
    if (!CHECK(is_found && cs_outline_bounds(&outline, &doubled, &general) &&
               same_box(&plain, &general)))
      fprintf(stderr, "  case %d\n", seed);
    cs_outline_finish(&outline, context->memory);
  }
}

/* ---------------------------------------------------------------- which outlines are plain */

static bool is_plain_path(const char *data) {
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_path(context, &outline, data) == CELSPAN_OK);
  bool is_plain = outline.is_plain;
  cs_outline_finish(&outline, context->memory);
  return is_plain;
}

static bool is_plain_piece(int degree, cs_hpoint point) {
  cs_hpoint points[4] = {point, point, point, point};
  cs_outline outline;
  cs_outline_init(&outline);
  CHECK(cs_outline_move(context, &outline, (cs_hpoint){0, 0, 1}) == CELSPAN_OK);
  CHECK(cs_outline_piece(context, &outline, degree, points) == CELSPAN_OK);
  bool is_plain = outline.is_plain;
  cs_outline_finish(&outline, context->memory);
  return is_plain;
}

static void plain_is_what_has_no_weights(void) {
  CHECK(is_plain_path("M0 0L9 0Q9 9 4 9C2 9 0 7 0 4z"));
  CHECK(!is_plain_path("M0 0L9 0A9 9 0 0 1 0 0z")); /* an arc is a rational piece */
  CHECK(is_plain_piece(3, (cs_hpoint){5, 6, 1}) && !is_plain_piece(4, (cs_hpoint){5, 6, 1}));
  CHECK(!is_plain_piece(1, (cs_hpoint){5, 6, 2}) && !is_plain_piece(1, (cs_hpoint){5, 1e13, 1}));
}

int main(void) {
  CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK);
  both_ways_give_the_same_chains();
  both_ways_give_the_same_bounds();
  plain_is_what_has_no_weights();
  celspan_context_destroy(context);
  return check_done();
}
