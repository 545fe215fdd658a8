-- Mutants that change no picture, and why: they are not run. Each is the file's list of
-- { the line as it stands, the change as ./run mutate tells it, the reason, and which of them where
-- the line has several that are told alike, from 1 }.
return {
  ["src/area/area.c"] = {
    { "return interval->high - i == 2 && interval->events.low > interval->events.high &&",
      "`>` to `>=`", "what a layer begins and ends in one column of no width has no area" },
    { "events += cs_active_chain(active, i)->y1 < y + 1.0;", "`<` to `<=`",
      "counts ends at the foot of the row too: into how many slabs it is cut decides the time" },
  },
  ["src/area/local_sweep.c"] = {
    { "while (member->points[at].y <= y && at + 1 < member->point_count)", "`1` to `0`",
      "members that are compared end below y, which ends the walk" },
  },
  ["src/area/window.c"] = {
    { "while (end > first && weight_in(cell, end - 1) == 0)", "`>` to `>=`",
      "a cell that has area nowhere is painted in no column, or in one less than that" },
  },
  ["src/compose/composer.c"] = {
    { "if (composer->item_count <= ITEM_LIMIT)", "`<=` to `<`",
      "programs are forgotten one item sooner, and found again" },
    { "if (composer->stack->tree_count == 0 || composer->stack->layer_count == 0)", "`||` to `&&`",
      "copies the set where no tree changes it" },
  },
  ["src/compose/over_tree.c"] = {
    { "uint64_t changed = tree->words[i] ^ word;", "`^` to `|`",
      "quads that did not change are looked up again, which gives what they had" },
  },
  ["src/compose/procedures.c"] = {
    { "return a->x < b->x;", "`<` to `<=`", "the two differ, as the line above says" },
  },
  ["src/compose/set.h"] = {
    { "static inline size_t cs_set_filled_count(size_t words) { return (words + 7) / 8 * 8; }",
      "`/` to `*`", "makes more room than a set needs" },
  },
  ["src/defocus/edges.c"] = {
    { "*edges = (cs_defocus_edges){0};", "drop `*edges = (cs_defocus_edges){0};`",
      "is freed at once with what it is a part of" },
  },
  ["src/defocus/sums.c"] = {
    { "for (size_t k = 0; k < count; k++)", "`0` to `1`",
      "the weight of the middle is not read: it has what those of the pairs leave" },
  },
  ["src/kernel/convolve_parts.h"] = {
    { "static inline size_t cs_convolve_words(int32_t width) { return (size_t)width / 64 + 1; }",
      "`1` to `2`", "makes room for one word more, of which no bit is ever set" },
  },
  ["src/paint/gradient_table.c"] = {
    { "cs_set_hash name = {0};", "`0` to `1`", "every name differs by the same from what it was" },
  },
  ["src/paint/lines.c"] = {
    { "if (last->column - first->column > 1)", "`-` to `+`",
      "computes colours between two neighbouring columns, where nothing is compared" },
    { "if (last->column - first->column > 1)", "`>` to `>=`",
      "computes colours between two neighbouring columns, where nothing is compared" },
    { "if (last->column - first->column > 1)", "`1` to `0`",
      "computes colours between two neighbouring columns, where nothing is compared" },
  },
  ["src/paint/over_row_wide.c"] = {
    { "const cs_wide_int rgb = CS_WIDE_PIXEL(-1, -1, -1, 0);", "`0` to `1`",
      "leaves a bit of alpha in the fourth lane, which is multiplied by 0 or not read" },
  },
  ["src/paint/shown.c"] = {
    { "if (layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE)",
      "`layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE` to "
        .. "`!(layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE)`",
      "asks about a stride at a time what is hidden, where more columns would do" },
    { "if (layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE)", "`&&` to `||`",
      "asks about a stride at a time what is hidden, where more columns would do", 1 },
    { "if (layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE)", "`&&` to `||`",
      "asks about a stride at a time what is hidden, where more columns would do", 2 },
    { "if (layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE)", "`<` to `<=`",
      "asks about fewer columns at a time what is hidden, where one cel is defocused" },
    { "if (layer->kind == CS_LAYER_DEFOCUSED && i + 1 < dear && columns > STRIDE)", "`1` to `0`",
      "asks about fewer columns at a time what is hidden, where one cel is defocused" },
  },
  ["src/render/objects.c"] = {
    { "size_t depth = 0, most = 0;", "`0` to `1`", "makes room for one more than are kept", 1 },
  },
  ["src/row/centre.c"] = {
    { "(w->boundary < active->count && active->x[w->boundary] <= w->edges.edges[w->edge].x)) {",
      "`<=` to `<`", "no column lies between two crossings at one place" },
  },
  ["src/row/centre_wide.c"] = {
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 2 },
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 4 },
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 5 },
    { "__m512i order = _mm512_setr_epi32(0, 16, 0, 0, 1, 17, 0, 1, 2, 18, 0, 2, 3, 19, 0, 3);",
      "`0` to `1`", "in a lane that the mask clears", 6 },
  },
  ["src/row/row.c"] = {
    { "if (active->y_next > active->y)", "`>` to `<`",
      "the boundaries are brought to the same height by the next step" },
    { "if (active->y_next > active->y)", "`>` to `>=`",
      "settles once more what is settled, which changes nothing" },
    { "if (maker->row != CS_ROW_NONE && maker->row < y && y - maker->row < FAR_ROWS)",
      "`<` to `<=`", "walking on gives the same as beginning anew: it only takes longer", 2 },
  },
  ["src/stroke/curve.c"] = {
    { "for (int k = 1; k <= line->degree; k++) {", "`1` to `2`",
      "is asked where a line rests: its second point is the first one" },
  },
  ["src/stroke/follow.c"] = {
    { "if (fabs(angle) > 3)", "`>` to `>=`", "an angle is not 3 to the bit; half a turn is meant" },
  },
  ["src/stroke/parts.c"] = {
    { "cs_curve_load_line(&r->stroke->line, piece, 0, 1, &line);", "`1` to `2`",
      "what ends at 1 or beyond is not cut there" },
  },
  ["src/stroke/side.c"] = {
    { "bool goes_on = has_fold(side) && are_same(last_tip(side), tips[0]);",
      "`last_tip(side), tips[0]` to `tips[0], last_tip(side)`",
      "are the same whichever of them is named first" },
    { "return draw_arc(a, from, to, end, 0);", "`0` to `1`",
      "halves an arc once less where that has long made no difference" },
  },
  ["src/stroke/taper.c"] = {
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`<` to `<=`", "a piece is cut where a taper ends: its middle is not there" },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`>` to `>=`", "a piece is cut where a taper begins: its middle is not there" },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`-` to `nothing`", "multiplies the radius between the tapers by 1" },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`1` to `0`", "multiplies the radius between the tapers by 1", 3 },
    { "int side = middle < t->taper[0] ? 0 : middle > t->length - t->taper[1] ? 1 : -1;",
      "`1` to `2`", "is asked only whether it is less than 0", 3 },
  },
  ["src/sweep/active.c"] = {
    { "if (tile_row > active->tile_row + 1)", "`+` to `-`",
      "begins anew at every height, where walking on gives the same: it only takes longer" },
  },
  ["src/sweep/cull_columns.c"] = {
    { "double stride = piece->sag > 0 ? sqrt(fmax(grid->slack / piece->sag - near, 1)) : 1;",
      "`1` to `2`", "a stride is cut to a whole number, which is 1 up to the root of 4", 1 },
    { "double stride = piece->sag > 0 ? sqrt(fmax(grid->slack / piece->sag - near, 1)) : 1;",
      "`1` to `2`", "chords of a piece without sag, which is straight, may be of any length", 2 },
  },
}
