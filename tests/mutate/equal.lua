-- Mutants that change no picture, and why: they are not run. Each entry of a file's list is { the
-- line of the source, the change as ./run mutate prints it, the reason, and which one, from 1, if
-- the line has several changes that are printed alike }.
return {
  ["src/core/engine/area/area.c"] = {
    { "events += cs_active_chain(active, i)->y1 < y + 1.0;", "`<` to `<=`",
      "counts ends at the foot of the row too: the number of slabs affects only the time" },
  },
  ["src/core/engine/area/local_sweep.c"] = {
    { "while (member->points[at].y <= y && at + 1 < member->point_count)", "`1` to `0`",
      "the members compared end below y, which ends the walk" },
  },
  ["src/core/engine/area/window.c"] = {
    { "while (end > first && weight_in(cell, end - 1) == 0)", "`>` to `>=`",
      "a cell without area is painted in no column, or in one less than that" },
  },
  ["src/core/engine/compose/composer.c"] = {
    { "if (composer->item_count <= ITEM_LIMIT)", "`<=` to `<`",
      "programs are discarded one item sooner, and found again" },
    { "if (composer->stack->tree_count == 0 || composer->stack->layer_count == 0)", "`||` to `&&`",
      "copies the set where no tree changes it" },
  },
  ["src/core/engine/compose/over_table.c"] = {
    { "uint64_t changed = known->word ^ word;", "`^` to `|`",
      "quarters that did not change are joined again, with the same result" },
  },
  ["src/core/engine/compose/procedures.c"] = {
    { "return a->x < b->x;", "`<` to `<=`", "the two differ, as the line above says" },
  },
  ["src/core/engine/compose/set.h"] = {
    { "static inline size_t cs_set_filled_count(size_t words) { return (words + 7) / 8 * 8; }",
      "`/` to `*`", "makes more room than a set needs" },
  },
  ["src/core/engine/defocus/edges.c"] = {
    { "*edges = (cs_defocus_edges){0};", "drop `*edges = (cs_defocus_edges){0};`",
      "is freed together with the object that contains it" },
  },
  ["src/core/engine/defocus/sample_sums.c"] = {
    { "for (int32_t k = 0; k <= extent; k++)", "`0` to `1`",
      "the weight of the middle is not read: it is 1 minus those of the pairs" },
  },
  ["src/core/engine/kernel/convolve_parts.h"] = {
    { "static inline size_t cs_convolve_words(int32_t width) { return (size_t)width / 64 + 1; }",
      "`1` to `2`", "makes room for one more word, of which no bit is ever set" },
  },
  ["src/core/engine/paint/gradient_table.c"] = {
    { "cs_set_hash name = {0};", "`0` to `1`", "every name changes by the same amount" },
  },
  ["src/core/engine/paint/gradient_lines.c"] = {
    { "if (last->column - first->column > 1)", "`-` to `+`",
      "computes colours between two neighbouring columns, where nothing is compared" },
    { "if (last->column - first->column > 1)", "`>` to `>=`",
      "computes colours between two neighbouring columns, where nothing is compared" },
    { "if (last->column - first->column > 1)", "`1` to `0`",
      "computes colours between two neighbouring columns, where nothing is compared" },
  },
  ["src/core/engine/paint/over_row_wide.c"] = {
    { "const cs_wide_int rgb = CS_WIDE_PIXEL(-1, -1, -1, 0);", "`0` to `1`",
      "leaves a bit of alpha in the fourth lane, which is multiplied by 0 or not read" },
  },
  ["src/core/engine/paint/shown.c"] = {
    { "if (layer->kind == CS_LAYER_DEFOCUSED && columns > STRIDE &&",
      "`layer->kind == CS_LAYER_DEFOCUSED && columns > STRIDE && (i + 1 < dear || "
        .. "cs_shown_is_pixels(painter->stack, layer))` to `!(layer->kind == CS_LAYER_DEFOCUSED && "
        .. "columns > STRIDE && (i + 1 < dear || cs_shown_is_pixels(painter->stack, layer)))`",
      "asks about a stride at a time what is hidden, where more columns would do" },
    { "if (layer->kind == CS_LAYER_DEFOCUSED && columns > STRIDE &&", "`&&` to `||`",
      "asks about a stride at a time what is hidden, where more columns would do", 1 },
    { "if (layer->kind == CS_LAYER_DEFOCUSED && columns > STRIDE &&", "`&&` to `||`",
      "asks about a stride at a time what is hidden, where more columns would do", 2 },
    { "(i + 1 < dear || cs_shown_is_pixels(painter->stack, layer)))", "`<` to `<=`",
      "asks about fewer columns at a time what is hidden, where one cel is defocused" },
    { "(i + 1 < dear || cs_shown_is_pixels(painter->stack, layer)))", "`1` to `0`",
      "asks about fewer columns at a time what is hidden, where one cel is defocused" },
  },
  ["src/core/frames/render/objects.c"] = {
    { "size_t depth = 0, most = 0;", "`0` to `1`", "makes room for one more than needed", 1 },
  },
  ["src/core/engine/row/centre.c"] = {
    { "(w->boundary < active->count && active->x[w->boundary] <= w->edges.edges[w->edge].x)) {",
      "`<=` to `<`", "no column lies between two crossings at one place" },
  },
  ["src/core/engine/row/centre_wide.c"] = {
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 2 },
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 4 },
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 5 },
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 6 },
  },
  ["src/core/engine/row/row.c"] = {
    { "if (active->y_next > active->y)", "`>` to `<`",
      "the boundaries are brought to the same height by the next step" },
    { "if (active->y_next > active->y)", "`>` to `>=`",
      "settles a second time, which changes nothing" },
    { "if (maker->row != CS_ROW_NONE && maker->row < y && y - maker->row < FAR_ROWS)",
      "`<` to `<=`", "continuing gives the same as starting again: it only takes longer", 2 },
  },
  ["src/core/model/stroke/curve.c"] = {
    { "for (int k = 1; k <= line->degree; k++) {", "`1` to `2`",
      "is used where a line stops: its second point is the first one" },
  },
  ["src/core/model/stroke/follow.c"] = {
    { "if (fabs(angle) > 3)", "`>` to `>=`", "an angle is never exactly 3; half a turn is meant" },
  },
  ["src/kit/readers/layered/krita.c"] = {
    { "place < zip->count && strncmp(zip->members[place].name, start, strlen(start)) == 0;",
      "`zip->members[place].name, start` to `start, zip->members[place].name`",
      "are equal in either order" },
  },
  ["src/kit/readers/svg/draw/gradients.c"] = {
    { "if (stop.at < 0 && i + 1 < g->stops.count) {", "`0` to `1`",
      "mixing takes a share below 0 for 0" },
    { "if (stop.at < 0 && i + 1 < g->stops.count) {", "`1` to `0`",
      "the last stop is right of the centre" },
  },
  ["src/core/model/stroke/dashes.c"] = {
    { "cs_curve_load_line(ruler->line, piece, 0, 1, &line);", "`1` to `2`",
      "a part that ends at 1 or beyond is not cut there" },
  },
  ["src/core/model/stroke/side.c"] = {
    { "bool goes_on = has_fold(side) && are_same(last_tip(side), tips[0]);",
      "`last_tip(side), tips[0]` to `tips[0], last_tip(side)`",
      "are the same in either order" },
    { "return draw_arc(a, from, to, end, 0);", "`0` to `1`",
      "halves an arc one time less, beyond the precision of the result" },
  },
  ["src/core/model/stroke/taper.c"] = {
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`<` to `<=`", "a piece is cut where a taper ends: its middle is not there" },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`>` to `>=`", "a piece is cut where a taper begins: its middle is not there" },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`-` to `nothing`", "multiplies the radius between the tapers by 1" },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`1` to `0`", "multiplies the radius between the tapers by 1", 3 },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`1` to `2`", "only its sign is used", 3 },
  },
  ["src/core/engine/sweep/active.c"] = {
    { "if (tile_row > active->tile_row + 1)", "`+` to `-`",
      "starts again at every height, where continuing gives the same: it only takes longer" },
  },
  ["src/core/engine/sweep/cull_columns.c"] = {
    { "double stride = piece->sag > 0 ? sqrt(fmax(grid->slack / piece->sag - near, 1)) : 1;",
      "`1` to `2`", "a stride is cut to a whole number, which is 1 up to the root of 4", 1 },
    { "double stride = piece->sag > 0 ? sqrt(fmax(grid->slack / piece->sag - near, 1)) : 1;",
      "`1` to `2`", "chords of a piece without sag, which is straight, may have any length", 2 },
  },
  ["src/kit/lua/bind/caller.c"] = {
    { "return info->currentline > 0 && info->source[0] == '@' && !is_own(info);", "`>` to `>=`",
      "lines count from 1, and a function without lines has line -1" },
  },
  ["src/kit/tools/track/grey.c"] = {
    { "return a->y != b->y ? a->y < b->y : a->x < b->x;", "`<` to `<=`",
      "the two differ, as the question before it says", 1 },
    { "return a->y != b->y ? a->y < b->y : a->x < b->x;", "`<` to `<=`",
      "no two candidates are at one place", 2 },
  },
}
