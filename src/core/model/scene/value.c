#include "model/scene/value.h"

void cs_value_hash_point(cs_hash *hash, celspan_point point) {
  cs_hash_number(hash, point.x);
  cs_hash_number(hash, point.y);
}

void cs_value_hash_box(cs_hash *hash, const celspan_box *box) {
  cs_value_hash_point(hash, (celspan_point){box->x, box->y});
  cs_hash_number(hash, box->width);
  cs_hash_number(hash, box->height);
}

void cs_value_hash_matrix(cs_hash *hash, const celspan_matrix *matrix) {
  cs_hash_numbers(hash, matrix->m, 9);
}

void cs_value_hash_paint(cs_hash *hash, const cs_paint *paint) {
  for (int c = 0; c < 3; c++) {
    cs_hash_number(hash, (double)paint->s[c]);
    cs_hash_number(hash, (double)paint->t[c]);
  }
  cs_hash_number(hash, (double)paint->beta);
}

void cs_value_hash_light(cs_hash *hash, const celspan_light *light) {
  cs_hash_number(hash, (double)light->r);
  cs_hash_number(hash, (double)light->g);
  cs_hash_number(hash, (double)light->b);
  cs_hash_number(hash, (double)light->a);
}

void cs_value_hash_give(cs_hash hash, uint64_t out[2]) {
  out[0] = hash.a;
  out[1] = hash.b;
}
