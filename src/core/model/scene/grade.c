#include "model/scene/grade.h"

#include "base/description.h"
#include "model/scene/check.h"
#include "model/scene/value.h"

#define NEAREST 1e-9 /* the least distance of points of a curve, along x */

/* ---------------------------------------------------------------- checks */

static celspan_status check_curve(celspan_context *context, const celspan_point *points,
                                  size_t count) {
  if (count == 0)
    return CELSPAN_OK;
  CS_TRY(cs_check_list(context, "grade", "curve", points, count, CS_GRADE_POINTS));
  if (count < 2)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "grade: curve has one point; it must have two or more");
  for (size_t i = 0; i < count; i++) {
    CS_TRY(cs_check_point(context, "grade", "curve", i + 1, points[i]));
    if (i > 0 && !(points[i].x - points[i - 1].x >= NEAREST))
      return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                     "grade: curve[%zu] goes in at %s, after %s; what goes in must ascend", i + 1,
                     cs_check_number_text(points[i].x).text,
                     cs_check_number_text(points[i - 1].x).text);
  }
  return CELSPAN_OK;
}

static celspan_status check_matrix(celspan_context *context, const celspan_grade_desc *desc) {
  for (int i = 0; i < 12 && desc->has_matrix; i++)
    CS_TRY(cs_check_number(context, "grade", "matrix", desc->matrix[i / 4][i % 4]));
  return CELSPAN_OK;
}

static celspan_status check_cdl(celspan_context *context, const celspan_grade_desc *desc) {
  for (int c = 0; c < 3; c++) {
    CS_TRY(cs_check_number(context, "grade", "slope", desc->slope[c]));
    CS_TRY(cs_check_number(context, "grade", "offset", desc->offset[c]));
    CS_TRY(cs_check_range(context, "grade", "power", desc->power[c], 1.0 / CELSPAN_GRADE_GAMMA,
                          CELSPAN_GRADE_GAMMA));
  }
  return CELSPAN_OK;
}

static celspan_status check(celspan_context *context, const celspan_grade_desc *desc) {
  CS_TRY(cs_check_range(context, "grade", "exposure", desc->exposure, -CELSPAN_GRADE_STOPS,
                        CELSPAN_GRADE_STOPS));
  CS_TRY(cs_check_size(context, "grade", "contrast", desc->contrast));
  CS_TRY(cs_check_number(context, "grade", "pivot", desc->pivot));
  CS_TRY(cs_check_size(context, "grade", "saturation", desc->saturation));
  CS_TRY(cs_check_number(context, "grade", "hue", desc->hue_radians));
  CS_TRY(cs_check_range(context, "grade", "temperature", desc->temperature, -1, 1));
  CS_TRY(cs_check_range(context, "grade", "tint", desc->tint, -1, 1));
  CS_TRY(cs_check_range(context, "grade", "gamma", desc->gamma, 1.0 / CELSPAN_GRADE_GAMMA,
                        CELSPAN_GRADE_GAMMA));
  CS_TRY(check_cdl(context, desc));
  CS_TRY(check_matrix(context, desc));
  CS_TRY(cs_check_choice(context, "grade", "lut_space",
                         (unsigned)desc->lut_space - CELSPAN_SPACE_LINEAR,
                         CS_SPACES - CELSPAN_SPACE_LINEAR));
  if (desc->steps != 0)
    CS_TRY(cs_check_range(context, "grade", "steps", desc->steps, 2, CS_GRADE_STEPS));
  for (int c = 0; c < 3; c++)
    CS_TRY(check_curve(context, desc->curve[c], desc->curve_count[c]));
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- values */

static void hash_map(cs_hash *hash, const cs_grade_map *map) {
  for (int i = 0; i < 12; i++)
    cs_hash_number(hash, map->rows[i / 4][i % 4]);
}

static cs_hash hash_grade(const cs_grade *steps) {
  cs_hash hash = cs_hash_begin(CS_VALUE_GRADE);
  for (int space = CELSPAN_SPACE_LINEAR; space < CS_SPACES; space++)
    hash_map(&hash, &steps->balance[space]);
  hash_map(&hash, &steps->cdl);
  for (int c = 0; c < 3; c++)
    cs_hash_number(&hash, steps->power[c]);
  cs_hash_number(&hash, steps->exponent);
  hash_map(&hash, &steps->matrix);
  for (int c = 0; c < 3; c++) {
    cs_hash_word(&hash, steps->curves[c].count);
    for (size_t i = 0; i < steps->curves[c].count; i++)
      cs_value_hash_point(&hash, steps->curves[c].points[i]);
  }
  cs_hash_word(&hash, (uint64_t)steps->steps);
  if (steps->cube) {
    cs_hash_word(&hash, steps->cube_space);
    cs_hash_hash(&hash, steps->cube->hash);
  }
  return cs_hash_end(hash);
}

celspan_status celspan_grade_create(celspan_context *context, const celspan_grade_desc *desc,
                                    celspan_grade **out) {
  CS_READ(context, "grade", celspan_grade_desc, desc);
  CS_TRY(check(context, desc));
  celspan_grade *grade;
  CS_TRY(CS_COUNTED_MAKE(context, grade));
  celspan_status status = cs_grade_make(context, desc, &grade->steps);
  if (status == CELSPAN_OK && desc->lut)
    status = cs_cube_read(context, desc->lut, &grade->steps.cube);
  if (status != CELSPAN_OK) {
    celspan_grade_unref(grade);
    return status;
  }
  grade->desc = *desc;
  grade->desc.lut = NULL;
  for (int c = 0; c < 3; c++)
    grade->desc.curve[c] = grade->steps.curves[c].points;
  grade->hash = hash_grade(&grade->steps);
  *out = grade;
  return CELSPAN_OK;
}

static void destroy(celspan_grade *grade) {
  cs_memory *memory = grade->memory;
  cs_grade_finish(&grade->steps, memory);
  cs_counted_free(memory, grade, sizeof *grade);
}

CS_COUNTED(celspan_grade)
