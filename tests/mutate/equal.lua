-- Mutants that change no picture, and why: they are not run. Each is the file's list of
-- { the line as it stands, the change as ./run mutate tells it, the reason }.
return {
  ["src/compose/over_tree.c"] = {
    { "uint64_t changed = tree->words[i] ^ word;", "`^` to `|`",
      "quads that did not change are looked up again, which gives what they had" },
  },
  ["src/sweep/active.c"] = {
    { "if (tile_row > active->tile_row + 1)", "`+` to `-`",
      "begins anew at every height, where walking on gives the same: it only takes longer" },
  },
}
