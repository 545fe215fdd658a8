/* Chains of operators: the same values as when all operands are given at once, at a cost that grows
 * with the length of the chain, on any threads, whatever is released first.
 */
#include "model/scene/operands.h"

#include <pthread.h>

#include "model/scene/scene.h"
#include "tests/support/memory.h"
#include "tests/support/scene.h"

#define LONG 8000

static celspan_object *extend(celspan_context *context, celspan_object *chain,
                              celspan_object *operand) {
  celspan_object *longer = NULL;
  CHECK(celspan_object_extend_boolean(context, chain, &operand, 1, &longer) == CELSPAN_OK);
  return longer;
}

/* A chain of `count` operands, made one by one; each shorter one is released at once. */
static celspan_object *chain_of(celspan_context *context, celspan_operator op,
                                celspan_object *operand, size_t count) {
  celspan_object *chain = NULL;
  CHECK(celspan_object_create_boolean(context, op, &operand, 1, &chain) == CELSPAN_OK);
  for (size_t i = 1; i < count; i++) {
    celspan_object *longer = extend(context, chain, operand);
    celspan_object_unref(chain);
    chain = longer;
  }
  return chain;
}

static bool is_same(const celspan_object *a, const celspan_object *b) {
  return a->hash.a == b->hash.a && a->hash.b == b->hash.b;
}

/* ---------------------------------------------------------------- values */

static void test_equals_the_list(studio *s) {
  celspan_object *const operands[] = {studio_rect(s, 0, 0, 5, 5, NULL),
                                      studio_rect(s, 3, 0, 5, 5, NULL),
                                      studio_circle(s, 4, 4, 2, NULL)};
  const celspan_operator ops[] = {CELSPAN_OPERATOR_UNION, CELSPAN_OPERATOR_INTERSECTION,
                                  CELSPAN_OPERATOR_DIFFERENCE, CELSPAN_OPERATOR_XOR};
  for (int i = 0; i < 4; i++) {
    celspan_object *pair = studio_boolean(s, ops[i], operands, 2);
    celspan_object *three = extend(s->context, pair, operands[2]);
    CHECK(is_same(three, studio_boolean(s, ops[i], operands, 3)));
    CHECK(!is_same(three, pair) && is_same(pair, studio_boolean(s, ops[i], operands, 2)));
    CHECK(three->data->depth == 1 && three->data->primitive_count == 3);
    CHECK(celspan_object_contains(three, (celspan_point){1, 1}) ==
          celspan_object_contains(studio_boolean(s, ops[i], operands, 3), (celspan_point){1, 1}));
    celspan_object_unref(three);
  }
}

/* Only added operands are hashed: the existing ones may change unnoticed, which they never do. */
static void test_hash_goes_on(studio *s) {
  celspan_object *a = studio_rect(s, 0, 0, 5, 5, NULL), *b = studio_rect(s, 3, 0, 5, 5, NULL);
  celspan_object *pair = studio_pair(s, CELSPAN_OPERATOR_UNION, a, b);
  celspan_object *expected = extend(s->context, pair, a), *three = extend(s->context, pair, b);
  celspan_object *four = extend(s->context, three, b);
  b->hash.a ^= 1; /* in both lists */
  celspan_object *again = extend(s->context, pair, a);
  CHECK(is_same(again, expected));
  b->hash.a ^= 1;
  a->hash.a ^= 1;
  celspan_object *same = extend(s->context, three, b);
  CHECK(is_same(same, four));
  a->hash.a ^= 1;
  celspan_object *const made[] = {expected, three, four, again, same};
  for (int i = 0; i < 5; i++)
    celspan_object_unref(made[i]);
}

/* The number of operands is part of the hash, even if their own hashes are equal. */
static void test_lengths_differ(studio *s) {
  celspan_object *empty = studio_boolean(s, CELSPAN_OPERATOR_UNION, NULL, 0);
  celspan_object *one = extend(s->context, empty, empty), *two = extend(s->context, one, empty);
  CHECK(!is_same(empty, one) && !is_same(one, two) && !is_same(empty, two));
  celspan_object *same = NULL;
  CHECK(celspan_object_extend_boolean(s->context, two, NULL, 0, &same) == CELSPAN_OK);
  CHECK(is_same(same, two));
  celspan_object_unref(same);
  celspan_object_unref(two);
  celspan_object_unref(one);
}

static void test_refusals(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 5, 5, NULL), *out = NULL;
  celspan_object *pair = studio_pair(s, CELSPAN_OPERATOR_UNION, rect, rect);
  celspan_object *const refused[] = {rect, studio_pair(s, CELSPAN_OPERATOR_CLIP, rect, rect),
                                     studio_fade(s, pair, 0.5),
                                     studio_transform(s, pair, celspan_matrix_translation(1, 0))};
  for (int i = 0; i < 4; i++)
    CHECK(celspan_object_extend_boolean(s->context, refused[i], &rect, 1, &out) ==
          CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(s->context),
             "extend: the object is not a union, intersection, difference or xor as it was made, "
             "without transform and fade");
  celspan_object *nothing = NULL;
  CHECK(celspan_object_extend_boolean(s->context, pair, &nothing, 1, &out) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(s->context), "union: operands[1] is missing");
  celspan_object *object = rect;
  for (int i = 0; i < CS_SCENE_DEPTH; i++)
    object = studio_pair(s, CELSPAN_OPERATOR_UNION, object, rect);
  CHECK(celspan_object_extend_boolean(s->context, pair, &object, 1, &out) == CELSPAN_LIMIT);
  CHECK(out == NULL && pair->data->boolean->operand_count == 2);
}

/* ---------------------------------------------------------------- sharing */

/* Two that share a beginning, and a third made after one of them was released. */
static void test_branches(studio *s) {
  celspan_object *a = studio_rect(s, 0, 0, 1, 1, NULL), *b = studio_rect(s, 2, 0, 1, 1, NULL);
  celspan_object *base = chain_of(s->context, CELSPAN_OPERATOR_UNION, a, 3);
  celspan_object *with_a = extend(s->context, base, a), *with_b = extend(s->context, base, b);
  CHECK(with_a->data->boolean->operands == base->data->boolean->operands); /* shared */
  CHECK(with_b->data->boolean->operands != base->data->boolean->operands);
  CHECK(with_a->data->boolean->operands[3] == a && with_b->data->boolean->operands[3] == b);
  celspan_object_unref(with_a);
  celspan_object *again = extend(s->context, base, b);
  CHECK(again->data->boolean->operands == base->data->boolean->operands &&
        again->data->boolean->operands[3] == b);
  CHECK(is_same(again, with_b) && base->data->boolean->operand_count == 3);
  celspan_object_unref(base);
  CHECK(again->data->boolean->operands[0] == a);
  celspan_object_unref(again);
  celspan_object_unref(with_b);
}

/* An added operand is released with the object that added it, though the beginning lives on. */
static void test_nothing_is_held(void) {
  memory_watch watch = {0};
  studio s = {.context = memory_watch_context(&watch)};
  celspan_object *base =
      chain_of(s.context, CELSPAN_OPERATOR_UNION, studio_rect(&s, 0, 0, 1, 1, NULL), 3);
  size_t blocks = watch.blocks;
  celspan_object *added = NULL;
  celspan_rect_desc desc = {sizeof desc, 0, 0, 3, 3, 0, NULL};
  CHECK(celspan_object_create_rect(s.context, &desc, &added) == CELSPAN_OK);
  celspan_object *longer = extend(s.context, base, added);
  celspan_object_unref(added);
  CHECK(watch.blocks > blocks);
  celspan_object_unref(longer);
  CHECK(watch.blocks == blocks);
  celspan_object_unref(base);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
}

/* A chain that has itself as an operand, moved or unchanged: whatever is released first, nothing is
 * kept. */
static void test_own_beginning(void) {
  static const int orders[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < 12; i++) {
    memory_watch watch = {0};
    studio s = {.context = memory_watch_context(&watch)};
    celspan_object *rect = studio_rect(&s, 0, 0, 1, 1, NULL);
    celspan_object *chain = chain_of(s.context, CELSPAN_OPERATOR_UNION, rect, 5), *moved = NULL;
    celspan_matrix right = celspan_matrix_translation(i < 6 ? 5 : 0, 0);
    CHECK(celspan_object_transform(s.context, chain, &right, &moved) == CELSPAN_OK);
    celspan_object *twice = extend(s.context, chain, moved), *more = extend(s.context, twice, rect);
    celspan_object_unref(moved);
    CHECK(more->data->boolean->operands == chain->data->boolean->operands);
    celspan_object *made[] = {chain, twice, more};
    for (int k = 0; k < 3; k++)
      celspan_object_unref(made[orders[i % 6][k]]);
    studio_finish(&s);
    celspan_context_destroy(s.context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
  }
}

/* ---------------------------------------------------------------- cost */

/* The total number of bytes that one chain allocates while it is made. */
typedef struct meter {
  size_t asked;
} meter;

static void *metered_resize(void *user, void *block, size_t old_size, size_t new_size) {
  meter *m = user;
  m->asked += new_size > old_size ? new_size - old_size : 0;
  if (new_size > 0)
    return realloc(block, new_size);
  free(block);
  return NULL;
}

static size_t bytes_asked(celspan_operator op, size_t count) {
  meter m = {0};
  celspan_context_desc desc = CELSPAN_CONTEXT_DESC;
  desc.resize = metered_resize;
  desc.resize_user = &m;
  celspan_context *context = NULL;
  CHECK(celspan_context_create(&desc, &context) == CELSPAN_OK);
  studio s = {.context = context};
  celspan_object *rect = studio_rect(&s, 0, 0, 1, 1, NULL);
  size_t before = m.asked;
  celspan_object_unref(chain_of(context, op, rect, count));
  size_t asked = m.asked - before;
  studio_finish(&s);
  celspan_context_destroy(context);
  return asked;
}

static void test_cost_grows_with_the_length(void) {
  const celspan_operator ops[] = {CELSPAN_OPERATOR_UNION, CELSPAN_OPERATOR_INTERSECTION,
                                  CELSPAN_OPERATOR_DIFFERENCE, CELSPAN_OPERATOR_XOR};
  for (int i = 0; i < 4; i++) {
    size_t some = bytes_asked(ops[i], LONG / 8), many = bytes_asked(ops[i], LONG);
    CHECK(many < 9 * some); /* copying all operands at each step would allocate 50 times as much */
  }
}

/* All steps of a chain at once hold as much memory as the same number of objects. */
static void test_held_steps(void) {
  memory_watch watch = {0};
  celspan_context *context = memory_watch_context(&watch);
  studio s = {.context = context};
  celspan_object *rect = studio_rect(&s, 0, 0, 1, 1, NULL);
  static celspan_object *steps[LONG];
  steps[0] = chain_of(context, CELSPAN_OPERATOR_UNION, rect, 1);
  size_t before = watch.bytes;
  for (size_t i = 1; i < LONG; i++)
    steps[i] = extend(context, steps[i - 1], rect);
  CHECK((watch.bytes - before) / LONG <
        sizeof(celspan_object) + sizeof(cs_primitive_data) + sizeof(cs_boolean) + 100);
  CHECK(steps[LONG - 1]->data->boolean->operand_count == LONG &&
        steps[99]->data->boolean->operand_count == 100);
  for (size_t i = 0; i < LONG; i++)
    celspan_object_unref(steps[i]);
  studio_finish(&s);
  celspan_context_destroy(context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
}

/* ---------------------------------------------------------------- failures and threads */

static void test_every_allocation_can_fail(void) {
  for (size_t n = 1;; n++) {
    memory_watch watch = {0};
    studio s = {.context = memory_watch_context(&watch)};
    celspan_object *rect = studio_rect(&s, 0, 0, 1, 1, NULL), *longer = NULL;
    celspan_object *chain = chain_of(s.context, CELSPAN_OPERATOR_UNION, rect, 3);
    watch.fail_at = watch.allocations + n;
    celspan_status status = celspan_object_extend_boolean(s.context, chain, &rect, 1, &longer);
    CHECK(status == CELSPAN_OK || (status == CELSPAN_NO_MEMORY && !longer));
    watch.fail_at = 0;
    celspan_object *after = extend(s.context, chain, rect); /* the failed one used no place */
    CHECK(status == CELSPAN_OK || after->data->boolean->operands == chain->data->boolean->operands);
    celspan_object_unref(after);
    celspan_object_unref(longer);
    celspan_object_unref(chain);
    studio_finish(&s);
    celspan_context_destroy(s.context);
    CHECK(watch.blocks == 0 && watch.size_errors == 0);
    if (status == CELSPAN_OK)
      return;
  }
}

typedef struct extender {
  celspan_object *base, *operand;
  bool is_good;
} extender;

/* Each thread has a context of its own; the base and its operands, some of them the base itself,
 * are shared. */
static void *extend_often(void *user) {
  extender *e = user;
  celspan_context *context = NULL;
  e->is_good = celspan_context_create(NULL, &context) == CELSPAN_OK;
  for (int i = 0; e->is_good && i < 2000; i++) {
    celspan_object *one = NULL, *two = NULL;
    e->is_good = celspan_object_extend_boolean(context, e->base, &e->operand, 1, &one) == 0 &&
                 celspan_object_extend_boolean(context, one, &e->operand, 1, &two) == 0 &&
                 two->data->boolean->operands[3] == e->operand &&
                 two->data->boolean->operands[4] == e->operand &&
                 two->data->boolean->operands[2] == e->base->data->boolean->operands[2];
    celspan_object_unref(i % 2 ? one : two);
    celspan_object_unref(i % 2 ? two : one);
  }
  celspan_context_destroy(context);
  return NULL;
}

static void test_threads(studio *s) {
  celspan_object *rect = studio_rect(s, 0, 0, 1, 1, NULL);
  celspan_object *base = chain_of(s->context, CELSPAN_OPERATOR_UNION, rect, 3);
  extender extenders[4];
  pthread_t threads[4];
  for (int i = 0; i < 4; i++) {
    celspan_object *operand = i < 2 ? studio_rect(s, i, 0, 1, 1, NULL)
                                    : studio_transform(s, base, celspan_matrix_translation(i, 0));
    extenders[i] = (extender){base, operand, false};
    CHECK(pthread_create(&threads[i], NULL, extend_often, &extenders[i]) == 0);
  }
  for (int i = 0; i < 4; i++) {
    CHECK(pthread_join(threads[i], NULL) == 0);
    CHECK(extenders[i].is_good);
  }
  celspan_object_unref(base);
}

int main(void) {
  memory_watch watch = {0};
  studio s = {.context = memory_watch_context(&watch)};
  test_equals_the_list(&s);
  test_hash_goes_on(&s);
  test_lengths_differ(&s);
  test_refusals(&s);
  test_branches(&s);
  studio_finish(&s);
  celspan_context_destroy(s.context);
  CHECK(watch.blocks == 0 && watch.size_errors == 0);
  s = (studio){0};
  CHECK(celspan_context_create(NULL, &s.context) == CELSPAN_OK);
  test_threads(&s); /* the watch counts for one thread */
  studio_finish(&s);
  celspan_context_destroy(s.context);
  test_nothing_is_held();
  test_own_beginning();
  test_cost_grows_with_the_length();
  test_held_steps();
  test_every_allocation_can_fail();
  return check_done();
}
