#include "stroke/stroke.h"

#include <math.h>

void cs_stroke_contour(const cs_outline *line, size_t contour, size_t *begin, size_t *end) {
  *begin = line->contours[contour];
  *end = contour + 1 < line->contour_count ? line->contours[contour + 1] : line->piece_count;
}

size_t cs_stroke_piece(const cs_stroke *stroke, const cs_stroke_part *part, size_t i) {
  size_t begin, end, piece = part->first + i;
  cs_stroke_contour(&stroke->line, part->contour, &begin, &end);
  return piece < end ? piece : begin + (piece - end);
}

double cs_stroke_extent(const cs_stroke *stroke) {
  double extent = stroke->cap == CELSPAN_CAP_SQUARE ? sqrt(2) : 1;
  return stroke->join == CELSPAN_JOIN_MITER ? fmax(extent, stroke->miter) : extent;
}

void cs_stroke_finish(cs_stroke *stroke, cs_memory *memory) {
  cs_outline_finish(&stroke->line, memory);
  cs_mem_free(memory, stroke->radii, stroke->radius_capacity * sizeof *stroke->radii);
  cs_mem_free(memory, stroke->radius_starts,
              stroke->radius_start_capacity * sizeof *stroke->radius_starts);
  cs_mem_free(memory, stroke->radius_degrees,
              stroke->radius_degree_capacity * sizeof *stroke->radius_degrees);
  cs_mem_free(memory, stroke->parts, stroke->part_capacity * sizeof *stroke->parts);
}

void cs_stroke_hash(cs_hash *hash, const cs_stroke *stroke) {
  cs_hash_word(hash, stroke->cap);
  cs_hash_word(hash, stroke->join);
  cs_hash_number(hash, stroke->miter);
  for (size_t i = 0; i < stroke->line.piece_count; i++)
    cs_hash_word(hash, stroke->radius_degrees[i]);
  for (size_t i = 0; i < stroke->radius_count; i++)
    cs_hash_number(hash, stroke->radii[i]);
  cs_hash_word(hash, stroke->part_count);
  for (size_t i = 0; i < stroke->part_count; i++) {
    const cs_stroke_part *part = &stroke->parts[i];
    cs_hash_word(hash, part->first);
    cs_hash_word(hash, part->count);
    cs_hash_number(hash, part->begin);
    cs_hash_number(hash, part->end);
    cs_hash_word(hash, part->is_closed);
  }
}
